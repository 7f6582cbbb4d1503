// Lays out parts of meshes; makes the space above them, and the places on them.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/math/math.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "formats/packages/read_mesh.h"
#include "import/charts/flat_surface.h"
#include "import/charts/paired_places.h"
#include "import/charts/place_source.h"
#include "import/charts/shell.h"
#include "import/charts/shortest_ways.h"
#include "import/charts/surface_rays.h"
#include "sources/cad_file.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

using importing::place_text, importing::Shell, importing::SurfacePatch;

importing::Flattening method_called(const Choice& name) {
  if (name == "arap") return importing::Flattening::arap;
  return name == "authalic" ? importing::Flattening::authalic : importing::Flattening::lscm;
}

// Triangles of a file, without their groups.
struct Surface {
  std::vector<Vec3> points;
  std::vector<importing::Corners> triangles;
};

// A part of a surface with places, and their extents.
struct Part {
  SurfacePatch patch;
  Vec2 lengths;
};

// Takes parts of surfaces, and lays them out. What is missing has a message.
class PartMaker {
 public:
  PartMaker(const SurfaceLayout& layout, sources::Loading& loading, const Reader& reader)
      : layout_(layout), loading_(loading), reader_(reader) {}

  std::optional<Part> part_of(const SurfaceChoice& choice) const {
    if (cad::is_cad_file(choice.file.path)) return faces_of(choice);
    return choice.is_rectangle ? no_rectangle(choice) : triangles_of(choice);
  }

  std::optional<Surface> surface_of(const FilePath& file) const {
    if (cad::is_cad_file(file.path)) {
      const auto read = sources::read_cad(file, loading_);
      if (!read) return std::nullopt;
      Surface all;
      for (const cad::SolidPtr& solid : read->solids) append(solid->triangulate(layout_.tolerance_mm), all);
      return all;
    }
    const auto bytes = loading_.bytes(file);
    FilePath whole = file;  // it gets a content that the key has already
    const auto parts = loading_.read_beside(whole, "parts", formats::files_of_mesh(whole.path));
    if (!parts) return std::nullopt;
    auto mesh = formats::read_mesh(file.path, *bytes, reader_.diagnostics, *parts);
    if (!mesh) {
      reader_.diagnostics.note(reader_.where, "the file is used here");
      return std::nullopt;
    }
    return Surface{std::move(mesh->vertices), std::move(mesh->triangles)};
  }

  void refuse(const SurfaceChoice& choice, const std::string& problem, const Phrase& hint) const {
    reader_.diagnostics.error(reader_.where, named(choice) + ": " + problem, hint);
  }
  void warn_of(const SurfaceChoice& choice, double aspect) const {
    constexpr double most_aspect = 8;
    if (aspect > most_aspect)
      reader_.diagnostics.warning(reader_.where,
                                  named(choice) + " stretches lengths up to " + format_rounded(aspect) +
                                      " times as much in one direction as in the other",
                                  "choose a flatter part, without tips and poles, or another method");
  }

 private:
  std::string named(const SurfaceChoice& choice) const {
    return std::string(reader_.node) + " of \"" + choice.file.path + '"';
  }
  static void append(const cad::Triangles& mesh, Surface& all) {
    const auto first = static_cast<uint32_t>(all.points.size());
    all.points.insert(all.points.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }

  std::optional<Part> triangles_of(const SurfaceChoice& choice) const {
    const auto surface = surface_of(choice.file);
    if (!surface) return std::nullopt;
    const importing::PatchChoice conditions{choice.at, choice.angle_deg, choice.box, choice.normal, choice.within_deg};
    return laid_out(choice, importing::choose_patch(surface->points, surface->triangles, conditions));
  }

  // A face of a solid, with its number there.
  struct Face {
    const cad::Solid* solid = nullptr;
    uint32_t number = 0;
    cad::FaceMesh mesh;
  };

  std::optional<Part> faces_of(const SurfaceChoice& choice) const {
    if (!choice.kind.empty() && std::ranges::find(cad::face_kinds, choice.kind) == cad::face_kinds.end()) {
      refuse(choice, "there is no kind of faces called \"" + choice.kind + '"',
             sources::hint_of_names(choice.kind, {cad::face_kinds.begin(), cad::face_kinds.end()}, ""));
      return std::nullopt;
    }
    const auto read = sources::read_cad(choice.file, loading_);
    if (!read) return std::nullopt;
    std::vector<Face> chosen;
    std::string all;
    for (const cad::SolidPtr& solid : read->solids) {
      std::vector<cad::FaceMesh> faces = solid->face_meshes(layout_.tolerance_mm);
      for (uint32_t n = 0; n < faces.size(); ++n) {
        all += (all.empty() ? "" : "; ") + described(faces[n]);
        if (fits(choice, faces[n])) chosen.push_back({solid.get(), n, std::move(faces[n])});
      }
    }
    if (chosen.empty()) {
      refuse(choice, "no face of the CAD file is chosen", "its faces are: " + shortened(all));
      return std::nullopt;
    }
    if (choice.at) keep_nearest(chosen, *choice.at);
    if (chosen.size() == 1) return with_own_places(choice, mesh_of(choice, chosen.front()));
    return choice.is_rectangle ? no_rectangle(choice) : joined(choice, chosen);
  }
  cad::FaceMesh mesh_of(const SurfaceChoice& choice, Face& face) const {
    if (!choice.is_rectangle) return std::move(face.mesh);
    return std::move(face.solid->face_meshes(layout_.tolerance_mm, cad::FaceExtent::whole_rectangle)[face.number]);
  }
  std::optional<Part> no_rectangle(const SurfaceChoice& choice) const {
    refuse(choice, "only a single face of a CAD file goes on beyond its border",
           "write " + spelled::parameter("trim", "\"border\"") + ", or choose one face, for example by " +
               spelled::parameter("at", "(0, 0, 10)"));
    return std::nullopt;
  }
  std::optional<Part> with_own_places(const SurfaceChoice& choice, cad::FaceMesh face) const {
    Part part;
    part.patch = {std::move(face.points), std::move(face.triangles), std::move(face.normals), std::move(face.places)};
    fill_normals(part.patch);
    if (const auto turned = importing::turned_over(part.patch)) {
      refuse(choice, "u and v of the face have no area at " + place_of(part.patch, *turned),
             "choose a face without such a point, or several faces, which are laid out by " +
                 std::string(layout_.method.text()));
      return std::nullopt;
    }
    part.lengths = importing::moved_to_zero(part.patch);
    return part;
  }
  static std::string place_of(const SurfacePatch& patch, uint32_t triangle) {
    return place_text(patch.points[patch.triangles[triangle][0]]);
  }
  static std::string described(const cad::FaceMesh& face) {
    return face.kind + " of " + format_rounded(face.area_mm2) + " mm^2 around " + place_text(face.center);
  }
  static std::string shortened(std::string text) {
    constexpr size_t most = 600;
    return text.size() > most ? text.substr(0, text.rfind(';', most)) + "; ..." : text;
  }
  static bool fits(const SurfaceChoice& choice, const cad::FaceMesh& face) {
    if (face.triangles.empty() || (!choice.kind.empty() && face.kind != choice.kind)) return false;
    if (!choice.area_mm2.contains(face.area_mm2)) return false;
    if (choice.box && !choice.box->contains(face.center)) return false;
    if (!choice.normal) return true;
    const double cosine = math::cos(choice.within_deg * math::degree);
    return length(face.normal) > 0 && dot(face.normal, *choice.normal) >= cosine * length(*choice.normal);
  }
  static void keep_nearest(std::vector<Face>& faces, Vec3 at) {
    size_t nearest = 0;
    double least = Box::inf;
    for (size_t n = 0; n < faces.size(); ++n) {
      const double here = importing::SurfaceRays(faces[n].mesh.points, faces[n].mesh.triangles).distance(at);
      if (here >= least) continue;
      least = here;
      nearest = n;
    }
    faces = {std::move(faces[nearest])};
  }
  // Joins faces along their common edges.
  std::optional<Part> joined(const SurfaceChoice& choice, const std::vector<Face>& faces) const {
    Surface all;
    std::map<const cad::Solid*, std::set<uint32_t>> numbers;
    for (const Face& face : faces) numbers[face.solid].insert(face.number);
    for (const Face& face : faces) {
      const auto own = numbers.extract(face.solid);
      if (own.empty()) continue;
      cad::Triangles mesh = face.solid->triangulate(layout_.tolerance_mm);
      std::vector<importing::Corners> kept;
      for (size_t n = 0; n < mesh.triangles.size(); ++n)
        if (own.mapped().contains(mesh.faces[n])) kept.push_back(mesh.triangles[n]);
      mesh.triangles = std::move(kept);
      append(mesh, all);
    }
    importing::PatchChoice conditions;
    conditions.angle_deg = choice.angle_deg;
    return laid_out(choice, importing::choose_patch(all.points, all.triangles, conditions));
  }
  // Gives points without a normal, such as a tip, the mean normal of their triangles.
  static void fill_normals(SurfacePatch& patch) {
    const std::vector<Vec3> normals = patch.normals;
    importing::make_normals(patch);
    for (size_t n = 0; n < normals.size(); ++n)
      if (length(normals[n]) > 0) patch.normals[n] = normals[n];
  }

  std::optional<Part> laid_out(const SurfaceChoice& choice, importing::ChosenPatch chosen) const {
    if (!chosen.problem.empty()) {
      refuse(choice, chosen.problem, chosen.hint);
      return std::nullopt;
    }
    Part part{std::move(chosen.patch), {}};
    part.patch.places = importing::flatten(part.patch.points, part.patch.triangles, method_called(layout_.method));
    if (const auto turned = importing::turned_over(part.patch)) {
      refuse(choice,
             "the surface folds at " + place_of(part.patch, *turned) + " where it is laid out by " +
                 std::string(layout_.method.text()),
             "choose a smaller or flatter part of it, or another method: lscm, arap or authalic");
      return std::nullopt;
    }
    part.lengths = importing::align_places(part.patch, layout_.toward);
    return part;
  }

  const SurfaceLayout& layout_;
  sources::Loading& loading_;
  const Reader& reader_;
};

class SpaceMaker {
 public:
  SpaceMaker(const SurfaceRequest& request, sources::Loading& loading, const Reader& reader, const Hash& key)
      : request_(request), reader_(reader), key_(key), parts_(request, loading, reader) {}

  sources::Loading::Made<SurfaceSpace> run() {
    Shell shell;
    auto part = parts_.part_of(request_.part);
    if (!part) return {};
    shell.patch = std::move(part->patch);
    lengths_ = part->lengths;
    if (!add_ways(shell)) return {};
    return is_sound(shell) ? made(std::move(shell)) : sources::Loading::Made<SurfaceSpace>();
  }

 private:
  bool add_ways(Shell& shell) {
    if (is_between()) return request_.pairing == "normal" ? add_ways_along_normals(shell) : add_ways_of_pairs(shell);
    turn_inward(shell);
    for (const Vec3& normal : shell.patch.normals) shell.ways.push_back(sign() * normal);
    shell.heights = {request_.standoff_mm, request_.standoff_mm + request_.height_mm};
    return true;
  }
  bool is_between() const { return !request_.to.file.path.empty(); }
  double sign() const { return request_.is_inward ? -1 : 1; }
  void turn_inward(Shell& shell) const {
    if (request_.is_inward) turn(shell);
  }
  static void turn(Shell& shell) {
    for (auto& [a, b, c] : shell.patch.triangles) std::swap(b, c);
  }

  bool add_ways_along_normals(Shell& shell) {
    const auto other = request_.to.is_whole() ? parts_.surface_of(request_.to.file) : surface_of_part(request_.to);
    if (!other) return false;
    turn_inward(shell);
    const importing::SurfaceRays rays(other->points, other->triangles);
    reach_to(
        shell, [&](uint32_t n) { return rays.way_from(shell.patch.points[n], sign() * shell.patch.normals[n]); },
        [&](const importing::Corners& corners) { return rays.distance(middle(shell, corners)); });
    return true;
  }
  std::optional<Surface> surface_of_part(const SurfaceChoice& choice) const {
    auto part = parts_.part_of(choice);
    if (!part) return std::nullopt;
    return Surface{std::move(part->patch.points), std::move(part->patch.triangles)};
  }
  // The middle of a triangle on the upper side.
  static Vec3 middle(const Shell& shell, const importing::Corners& corners) {
    const auto& [a, b, c] = corners;
    return (1.0 / 3) * (shell.at(a, 1) + shell.at(b, 1) + shell.at(c, 1));
  }

  // Joins places of both surfaces at equal shares of u and v.
  bool add_ways_of_pairs(Shell& shell) {
    const auto other = parts_.part_of(request_.to);
    if (!other) return false;
    const importing::PairedPlaces pairs(other->patch, lengths_, other->lengths, request_.pairing.text(), shell.patch);
    if (const auto lonely = pairs.without_partner()) {
      parts_.refuse(request_.part, "no place of \"" + request_.to.file.path + "\" pairs with " + place_text(*lonely),
                    "choose parts of both surfaces that have the same outline");
      return false;
    }
    reach_to(
        shell, [&](uint32_t n) { return pairs.partner(shell.patch.places[n]) - shell.patch.points[n]; },
        [&](const importing::Corners& corners) {
          const auto& [a, b, c] = corners;
          const std::vector<Vec2>& places = shell.patch.places;
          return length(pairs.partner((1.0 / 3) * (places[a] + places[b] + places[c])) - middle(shell, corners));
        });
    if (pairs.farthest_off() > request_.tolerance_mm)
      reader_.diagnostics.warning(reader_.where,
                                  "the outlines of both surfaces of surface_cells differ by up to " +
                                      format_rounded(pairs.farthest_off()) + " mm; cells go on beyond that of \"" +
                                      request_.to.file.path + '"',
                                  "choose parts of both surfaces that have the same outline");
    double rise = 0;
    for (size_t n = 0; n < shell.ways.size(); ++n) rise += dot(shell.ways[n], shell.patch.normals[n]);
    if (rise < 0) turn(shell);
    return true;
  }

  // Divides triangles until the upper side is near enough to the other surface. `way` is that of a point of the patch,
  // `off` the distance of a triangle's middle from where it should be.
  template <class Way, class Off>
  void reach_to(Shell& shell, const Way& way, const Off& off) {
    constexpr size_t most_triangles = 300000;
    shell.heights = {0, 1};
    for (;;) {
      shell.ways.clear();
      for (uint32_t n = 0; n < shell.patch.points.size(); ++n) shell.ways.push_back(way(n));
      double farthest = 0;
      for (const importing::Corners& corners : shell.patch.triangles) farthest = std::max(farthest, off(corners));
      if (farthest <= request_.tolerance_mm) return;
      if (4 * shell.patch.triangles.size() > most_triangles) {
        reader_.diagnostics.warning(reader_.where,
                                    "cells of surface_cells end up to " + format_rounded(farthest) +
                                        " mm away from \"" + request_.to.file.path + "\"",
                                    "smooth the surface, or set a greater tolerance");
        return;
      }
      shell.patch = importing::divided(shell.patch);
    }
  }

  bool is_sound(const Shell& shell) {
    if (const auto fold = importing::find_fold(shell)) {
      const double most = std::abs(fold->height);
      std::string hint = is_between() ? "choose a smaller part, smooth the surface, or choose another pairing"
                                      : "the surface bends there so that cells may be at most " + format_rounded(most) +
                                            " mm high; make standoff and height smaller, or smooth the surface";
      parts_.refuse(request_.part, "cells are folded at " + place_text(fold->at), hint);
      return false;
    }
    const auto overlap = importing::find_overlap(shell);
    if (overlap)
      parts_.refuse(request_.part, "cells overlap at " + place_text(*overlap),
                    "two parts of the surface face each other there; make height "
                    "smaller, or choose one of the parts");
    return !overlap;
  }

  sources::Loading::Made<SurfaceSpace> made(Shell shell) const {
    constexpr size_t bytes_per_triangle = 900;
    const importing::ShellReport report = importing::report_of(shell);
    parts_.warn_of(request_.part, report.aspect);
    double way = 0;
    for (const Vec3& v : shell.ways) way += length(v) / static_cast<double>(shell.ways.size());
    auto space = std::make_shared<SurfaceSpace>();
    *space = {nullptr,        lengths_,         shell.heights, way * (shell.heights.hi - shell.heights.lo),
              report.volumes, report.stretches, report.aspect, {}};
    for (const auto& [a, b] : importing::border_of(shell.patch.triangles))
      space->border.push_back({shell.patch.places[a], shell.patch.places[b]});
    const size_t bytes = bytes_per_triangle * shell.patch.triangles.size();
    space->source = importing::make_shell_source(request_.part.file.path, std::move(shell), key_);
    return {std::move(space), bytes};
  }

  const SurfaceRequest& request_;
  const Reader& reader_;
  Hash key_;
  PartMaker parts_;
  Vec2 lengths_;
};

sources::Loading::Made<SurfacePlaces> make_places(const SurfacePlacesRequest& request, sources::Loading& loading,
                                                  const Reader& reader, const Hash& key) {
  constexpr size_t bytes_per_triangle = 500;
  const PartMaker parts(request, loading, reader);
  auto part = parts.part_of(request.part);
  if (!part) return {};
  SurfacePatch& patch = part->patch;
  const importing::ShellReport report = importing::report_of({patch, patch.normals, {0, 0}});
  parts.warn_of(request.part, report.aspect);
  const size_t bytes = bytes_per_triangle * patch.triangles.size();
  auto places = std::make_shared<SurfacePlaces>();
  *places = {importing::make_place_source(request.part.file.path, std::move(patch), key), part->lengths,
             report.stretches};
  return {std::move(places), bytes};
}

void add(sources::Key& key, const std::optional<Vec3>& point) {
  key.add(point ? 1.0 : 0.0);
  if (point) key.add(point->x).add(point->y).add(point->z);
}
void add(sources::Key& key, const SurfaceChoice& choice) {
  key.add(choice.file.content).add(ending_of(choice.file.path));
  add(key, choice.at);
  add(key, choice.box ? std::optional(choice.box->lo) : std::nullopt);
  add(key, choice.box ? std::optional(choice.box->hi) : std::nullopt);
  add(key, choice.normal);
  key.add(choice.kind).add(choice.area_mm2.lo).add(choice.area_mm2.hi).add(choice.angle_deg).add(choice.within_deg);
  key.add(choice.is_rectangle ? 1.0 : 0.0);
}
void add(sources::Key& key, const SurfaceLayout& layout) {
  add(key, layout.toward);
  key.add(layout.tolerance_mm).add(layout.method.text());
}

}  // namespace

std::shared_ptr<const program::FieldSource> GeodesicRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  const auto parts = loading.read_beside(file, "parts", formats::files_of_mesh(file.path));
  if (!parts) return nullptr;
  sources::Key key("shortest ways");
  key.add(file.content).add(ending_of(file.path));
  for (const Vec3& p : from) key.add(p.x).add(p.y).add(p.z);
  const Hash hash = key.hash();
  return loading.cached<Result>(hash, file.path, [&](const Reader& reader) {
    using Made = sources::Loading::Made<Result>;
    auto mesh = formats::read_mesh(file.path, *loading.bytes(file), reader.diagnostics, *parts);
    if (!mesh) return Made{};
    std::erase_if(mesh->triangles, [&](const importing::Corners& t) {
      const Vec3 a = mesh->vertices[t[0]];
      return !(length(cross(mesh->vertices[t[1]] - a, mesh->vertices[t[2]] - a)) > 0);
    });
    if (mesh->triangles.empty()) {
      reader.diagnostics.error(reader.where, '"' + file.path + "\" has no triangle with an area",
                               "choose a mesh with a surface");
      return Made{};
    }
    constexpr size_t bytes_per_triangle = 2000;
    const size_t bytes = bytes_per_triangle * mesh->triangles.size();
    return Made{
        importing::make_geodesic_source(file.path, std::move(mesh->vertices), std::move(mesh->triangles), from, hash),
        bytes};
  });
}

std::shared_ptr<const SurfaceSpace> SurfaceRequest::load(sources::Loading& loading) {
  const auto finds = [&](FilePath& file) {
    return loading.find(file) && loading.read_content(file) &&
           loading.read_beside(file, "parts", formats::files_of_mesh(file.path));
  };
  const bool is_between = !to.file.path.empty();
  if (!finds(part.file) || (is_between && !finds(to.file))) return nullptr;
  sources::Key key("surface");
  add(key, part);
  key.add(is_between ? 1.0 : 0.0).add(pairing.text());
  if (is_between) add(key, to);
  add(key, static_cast<const SurfaceLayout&>(*this));
  key.add(standoff_mm).add(height_mm).add(is_inward ? 1.0 : 0.0);
  const Hash hash = key.hash();
  return loading.cached<Result>(hash, part.file.path,
                                [&](const Reader& reader) { return SpaceMaker(*this, loading, reader, hash).run(); });
}

std::shared_ptr<const SurfacePlaces> SurfacePlacesRequest::load(sources::Loading& loading) {
  if (!loading.find(part.file) || !loading.read_content(part.file)) return nullptr;
  sources::Key key("places on a surface");
  add(key, part);
  add(key, static_cast<const SurfaceLayout&>(*this));
  const Hash hash = key.hash();
  return loading.cached<Result>(hash, part.file.path,
                                [&](const Reader& reader) { return make_places(*this, loading, reader, hash); });
}

}  // namespace ombre::design
