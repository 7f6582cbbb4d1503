#include "solids/files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "formats/containers/file.h"
#include "formats/drawings/plane_files.h"
#include "formats/images/uncoloured.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_objects.h"
#include "formats/packages/read_mesh.h"
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
  std::vector<bool> is_done(mesh->groups.size());
  for (size_t n = 0; n < is_done.size(); ++n) {
    const Attributes attributes = attributes_of(mesh->groups[n], *mesh);
    if (is_done[n]) continue;
    std::vector<bool> flags(formats::all_groups(*mesh).size());
    for (size_t other = n; other < is_done.size(); ++other)
      if (attributes_of(mesh->groups[other], *mesh) == attributes) flags[other] = is_done[other] = true;
    add(formats::groups_of(*mesh, flags), attributes);
  }
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
