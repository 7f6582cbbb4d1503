#include "solids/files.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "formats/drawings/plane_files.h"
#include "formats/images/uncoloured.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_objects.h"
#include "formats/packages/read_mesh.h"
#include "import/surfaces/mesh_report.h"
#include "solids/fragments.h"
#include "solids/mended_solid.h"
#include "solids/regions.h"
#include "solids/strokes.h"

namespace ombre::solids {
namespace {

std::optional<std::string> bytes_of(const std::string& path, const SourceRange& where, Diagnostics& messages) {
  try {
    return formats::read_file(path);
  } catch (const Error&) {
    messages.warning(where, "Can't open import file '" + path + "'");
    return std::nullopt;
  }
}

TriangleMesh mesh_of(const formats::Mesh& mesh, double scale) {
  TriangleMesh result{mesh.vertices, {mesh.triangles.begin(), mesh.triangles.end()}};
  if (scale != 1)
    for (Vec3& p : result.points) p = scale * p;
  return tidied(result);
}

// Returns true if the reader made the name up because something had to have one: "object 3", the material's name, or
// the name of an object with several volumes.
bool is_made_up(const std::string& name, const formats::MeshGroup& group, const formats::Mesh& mesh) {
  constexpr std::string_view numbered = "object ";
  if (name == group.material) return true;
  if (name.starts_with(numbered) && name.find_first_not_of("0123456789", numbered.size()) == std::string::npos)
    return true;
  return name == group.object && std::count_if(mesh.groups.begin(), mesh.groups.end(),
                                               [&](const auto& other) { return other.object == group.object; }) > 1;
}

Attributes attributes_of(const formats::MeshGroup& group, const formats::Mesh& mesh) {
  Attributes attributes;
  attributes.material = group.material;
  if (!is_made_up(group.name, group, mesh)) attributes.part = group.name;
  if (!group.colour || *group.colour == formats::uncoloured) return attributes;
  Colour colour{};
  for (size_t n = 0; n < colour.size(); ++n) colour[n] = (*group.colour)[n] / 255.0;
  attributes.colour = colour;
  return attributes;
}

// Groups of triangles that are one solid; `groups` has a flag for each of all_groups().
struct Body {
  Attributes attributes;
  std::vector<bool> groups;
};

// Returns the name of the object that holds a group, or an empty text if the file has none.
const std::string& object_of(const formats::MeshGroup& group) {
  static const std::string none;
  if (!group.object.empty()) return group.object;
  return group.name == group.material ? none : group.name;
}

// Returns the groups of one object by their attributes.
std::vector<Body> bodies_of_object(const formats::Mesh& mesh, const std::string& object) {
  const size_t all = formats::all_groups(mesh).size();
  std::vector<Body> bodies;
  for (size_t n = 0; n < mesh.groups.size(); ++n) {
    if (object_of(mesh.groups[n]) != object) continue;
    Attributes attributes = attributes_of(mesh.groups[n], mesh);
    auto body = std::ranges::find(bodies, attributes, &Body::attributes);
    if (body == bodies.end()) body = bodies.insert(body, {std::move(attributes), std::vector<bool>(all)});
    body->groups[n] = true;
  }
  return bodies;
}

bool is_closed(const formats::Mesh& mesh, const Body& body) {
  return importing::inspect(formats::groups_of(mesh, body.groups)).is_closed();
}

// Joins bodies of an object that are no solids by themselves, since its triangles have materials or colours of their
// own. Where they differ, the solid has none.
Body joined(const std::vector<Body>& bodies) {
  Body whole = bodies.front();
  for (const Body& body : bodies) {
    if (body.attributes.material != whole.attributes.material) whole.attributes.material.clear();
    if (body.attributes.colour != whole.attributes.colour) whole.attributes.colour.reset();
    if (body.attributes.part != whole.attributes.part) whole.attributes.part.clear();
    for (size_t n = 0; n < whole.groups.size(); ++n) whole.groups[n] = whole.groups[n] || body.groups[n];
  }
  return whole;
}

// Returns the solids of a mesh. `colours` is set to the number of materials and colours of surfaces that are not used.
std::vector<Body> bodies_of(const formats::Mesh& mesh, size_t& colours) {
  std::vector<Body> all;
  std::set<std::string> done;
  for (const formats::MeshGroup& group : mesh.groups) {
    if (!done.insert(object_of(group)).second) continue;
    std::vector<Body> bodies = bodies_of_object(mesh, object_of(group));
    if (bodies.size() > 1 && !std::ranges::all_of(bodies, [&](const Body& body) { return is_closed(mesh, body); })) {
      colours += bodies.size();
      bodies = {joined(bodies)};
    }
    for (Body& body : bodies) {
      const auto same = std::ranges::find(all, body.attributes, &Body::attributes);
      if (same == all.end())
        all.push_back(std::move(body));
      else
        *same = joined({*same, body});
    }
  }
  return all;
}

bool names_attributes(const std::string& ending) { return ending == ".3mf" || ending == ".amf" || ending == ".obj"; }

Pieces mesh_pieces(const Import& import, const std::string& bytes, const SourceRange& where, Diagnostics& messages) {
  const auto mesh = formats::read_mesh(import.path, bytes, messages);
  if (!mesh) {
    messages.note(where, "the file is imported here");
    return {};
  }
  Pieces pieces;
  const auto add = [&](const formats::Mesh& part, Attributes attributes) {
    if (const auto solid = mended_solid(mesh_of(part, import.scale), "\"" + import.path + '"', where, messages))
      pieces.push_back({std::move(attributes), *solid});
  };
  if (!names_attributes(ending_of(import.path)) || mesh->groups.size() < 2) {
    const bool is_named = names_attributes(ending_of(import.path)) && !mesh->groups.empty();
    add(*mesh, is_named ? attributes_of(mesh->groups[0], *mesh) : Attributes{});
    return pieces;
  }
  size_t colours = 0;
  for (const Body& body : bodies_of(*mesh, colours)) add(formats::groups_of(*mesh, body.groups), body.attributes);
  if (colours > 0)
    messages.warning(where, "the surface of a solid in \"" + import.path + "\" has " + format_count(colours) +
                                " materials or colours, which are not used: the solid has none");
  return pieces;
}

Region region_of_shape(const formats::PlaneShape& shape, const Fragments& fragments);

Region region_of_shapes(const std::vector<formats::PlaneShape>& shapes, const Fragments& fragments) {
  std::vector<Region> regions;
  for (const formats::PlaneShape& shape : shapes) regions.push_back(region_of_shape(shape, fragments));
  return unite(std::span(std::as_const(regions)));
}

Region region_of_shape(const formats::PlaneShape& shape, const Fragments& fragments) {
  Region region = shape.stroke       ? stroked(*shape.stroke, fragments)
                  : shape.is_nonzero ? wound_region_of(shape.rings)
                                     : region_of(shape.rings);
  for (const formats::PlaneClip& clip : shape.clips) {
    if (region.is_empty()) break;
    region = intersect(region, region_of_shapes(*clip, fragments));
  }
  return region;
}

Pieces region_pieces(const Import& import, const std::string& bytes, const SourceRange& where, Diagnostics& messages) {
  formats::PlaneOptions options{import.layer, import.id, import.dots_per_inch};
  options.is_painted = import.is_painted;
  options.chords_of_radius = [&](double radius) { return edges_of_circle(radius * import.scale, import.fragments); };
  const bool is_svg = ending_of(import.path) == ".svg";
  auto shapes = is_svg ? formats::read_svg(import.path, bytes, options, messages)
                       : formats::read_dxf(import.path, bytes, options, messages);
  if (!shapes) {
    messages.note(where, "the file is imported here");
    return {};
  }
  const Region region = region_of_shapes(shapes->shapes, import.fragments);
  if (region.is_empty()) {
    const std::string others = formats::text_of_left_out(shapes->left_out);
    messages.warning(
        where, "the drawing \"" + import.path + "\" encloses no area" + (others.empty() ? "" : "; it holds " + others));
    return {};
  }
  Affine map = Affine::scaling({import.scale, import.scale, 1});
  if (!is_svg) map = map * Affine::translation({-import.origin.x, -import.origin.y, 0});
  if (import.centred) {
    const Vec3 middle = bounds_of(region).center();
    map = Affine::scaling({import.scale, import.scale, 1}) * Affine::translation({-middle.x, -middle.y, 0});
  }
  return {{{}, moved(region, map)}};
}

}  // namespace

Pieces import_pieces(const Import& import, const SourceRange& where, Diagnostics& messages) {
  const auto bytes = bytes_of(import.path, where, messages);
  if (!bytes) return {};
  const std::string ending = ending_of(import.path);
  if (ending == ".svg" || ending == ".dxf") return region_pieces(import, *bytes, where, messages);
  return mesh_pieces(import, *bytes, where, messages);
}

}  // namespace ombre::solids
