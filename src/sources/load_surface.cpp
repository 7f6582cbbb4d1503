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

// Takes a part of a surface, and lays it out.
class PatchMaker {
 public:
  PatchMaker(const SurfacePart& part, sources::Loading& loading, const Reader& reader)
      : part_(part), loading_(loading), reader_(reader) {}

  // Returns false after a message.
  bool make(SurfacePatch& patch) {
    return cad::is_cad_file(part_.file.path) ? take_faces(patch) : take_triangles(patch);
  }
  Vec2 lengths() const { return lengths_; }  // greatest u and v of that patch

  std::optional<Surface> surface_of(const FilePath& file) const {
    if (cad::is_cad_file(file.path)) {
      const auto read = sources::read_cad(file, loading_);
      if (!read) return std::nullopt;
      Surface all;
      for (const cad::SolidPtr& solid : read->solids) append(solid->triangulate(part_.tolerance_mm), all);
      return all;
    }
    const auto bytes = loading_.bytes(file);
    auto mesh = formats::read_mesh(file.path, *bytes, reader_.diagnostics);
    if (!mesh) {
      reader_.diagnostics.note(reader_.where, "the file is used here");
      return std::nullopt;
    }
    return Surface{std::move(mesh->vertices), std::move(mesh->triangles)};
  }
  void refuse(const std::string& problem, const Phrase& hint) const {
    reader_.diagnostics.error(reader_.where, of_file() + ": " + problem, hint);
  }
  void warn_of(double aspect) const {
    constexpr double most_aspect = 8;
    if (aspect > most_aspect)
      reader_.diagnostics.warning(reader_.where,
                                  of_file() + " stretches lengths up to " + format_rounded(aspect) +
                                      " times as much in one direction as in the other",
                                  "choose a flatter part, without tips and poles, or another method");
  }

 private:
  static void append(const cad::Triangles& mesh, Surface& all) {
    const auto first = static_cast<uint32_t>(all.points.size());
    all.points.insert(all.points.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }

  bool take_triangles(SurfacePatch& patch) {
    const auto surface = surface_of(part_.file);
    if (!surface) return false;
    const importing::PatchChoice choice{part_.at, part_.angle_deg, part_.box, part_.normal, part_.within_deg};
    return take(importing::choose_patch(surface->points, surface->triangles, choice), patch) && lay_out(patch);
  }
  bool take(importing::ChosenPatch chosen, SurfacePatch& patch) const {
    if (!chosen.problem.empty()) refuse(chosen.problem, chosen.hint);
    patch = std::move(chosen.patch);
    return chosen.problem.empty();
  }

  // A face of a solid, with its number there.
  struct Face {
    const cad::Solid* solid = nullptr;
    uint32_t number = 0;
    cad::FaceMesh mesh;
  };

  bool take_faces(SurfacePatch& patch) {
    if (!part_.kind.empty() && std::ranges::find(cad::face_kinds, part_.kind) == cad::face_kinds.end()) {
      refuse("there is no kind of faces called \"" + part_.kind + '"',
             sources::hint_of_names(part_.kind, {cad::face_kinds.begin(), cad::face_kinds.end()}, ""));
      return false;
    }
    const auto read = sources::read_cad(part_.file, loading_);
    if (!read) return false;
    std::vector<Face> chosen;
    std::string all;
    for (const cad::SolidPtr& solid : read->solids) {
      std::vector<cad::FaceMesh> faces = solid->face_meshes(part_.tolerance_mm);
      for (uint32_t n = 0; n < faces.size(); ++n) {
        all += (all.empty() ? "" : "; ") + described(faces[n]);
        if (fits(faces[n])) chosen.push_back({solid.get(), n, std::move(faces[n])});
      }
    }
    if (chosen.empty()) {
      refuse("no face of the CAD file is chosen", "its faces are: " + shortened(all));
      return false;
    }
    if (part_.at) keep_nearest(chosen);
    if (chosen.size() > 1) return join(chosen, patch);
    cad::FaceMesh& face = chosen.front().mesh;
    patch = {std::move(face.points), std::move(face.triangles), std::move(face.normals), std::move(face.places)};
    fill_normals(patch);
    if (const auto turned = importing::turned_over(patch)) {
      refuse("u and v of the face have no area at " + place_text(patch.points[patch.triangles[*turned][0]]),
             "choose a face without such a point, or several faces, which are laid out by " +
                 std::string(part_.method.text()));
      return false;
    }
    lengths_ = importing::moved_to_zero(patch);
    return true;
  }
  static std::string described(const cad::FaceMesh& face) {
    return face.kind + " of " + format_rounded(face.area_mm2) + " mm^2 around " + place_text(face.center);
  }
  static std::string shortened(std::string text) {
    constexpr size_t most = 600;
    return text.size() > most ? text.substr(0, text.rfind(';', most)) + "; ..." : text;
  }
  bool fits(const cad::FaceMesh& face) const {
    if (face.triangles.empty() || (!part_.kind.empty() && face.kind != part_.kind)) return false;
    if (!part_.area_mm2.contains(face.area_mm2)) return false;
    if (part_.box && !part_.box->contains(face.center)) return false;
    if (!part_.normal) return true;
    const double cosine = math::cos(part_.within_deg * math::degree);
    return length(face.normal) > 0 && dot(face.normal, *part_.normal) >= cosine * length(*part_.normal);
  }
  void keep_nearest(std::vector<Face>& faces) const {
    size_t nearest = 0;
    double least = Box::inf;
    for (size_t n = 0; n < faces.size(); ++n) {
      const double here = importing::SurfaceRays(faces[n].mesh.points, faces[n].mesh.triangles).distance(*part_.at);
      if (here >= least) continue;
      least = here;
      nearest = n;
    }
    faces = {std::move(faces[nearest])};
  }
  // Joins faces along their common edges.
  bool join(const std::vector<Face>& faces, SurfacePatch& patch) {
    Surface all;
    std::map<const cad::Solid*, std::set<uint32_t>> numbers;
    for (const Face& face : faces) numbers[face.solid].insert(face.number);
    for (const Face& face : faces) {
      const auto own = numbers.extract(face.solid);
      if (own.empty()) continue;
      cad::Triangles mesh = face.solid->triangulate(part_.tolerance_mm);
      std::vector<importing::Corners> kept;
      for (size_t n = 0; n < mesh.triangles.size(); ++n)
        if (own.mapped().contains(mesh.faces[n])) kept.push_back(mesh.triangles[n]);
      mesh.triangles = std::move(kept);
      append(mesh, all);
    }
    importing::PatchChoice choice;
    choice.angle_deg = part_.angle_deg;
    return take(importing::choose_patch(all.points, all.triangles, choice), patch) && lay_out(patch);
  }
  // Gives points without a normal, such as a tip, the mean normal of their triangles.
  static void fill_normals(SurfacePatch& patch) {
    const std::vector<Vec3> normals = patch.normals;
    importing::make_normals(patch);
    for (size_t n = 0; n < normals.size(); ++n)
      if (length(normals[n]) > 0) patch.normals[n] = normals[n];
  }

  bool lay_out(SurfacePatch& patch) {
    patch.places = importing::flatten(patch.points, patch.triangles, method_called(part_.method));
    if (const auto turned = importing::turned_over(patch)) {
      refuse("the surface folds at " + place_text(patch.points[patch.triangles[*turned][0]]) +
                 " where it is laid out by " + std::string(part_.method.text()),
             "choose a smaller or flatter part of it, or another method: lscm, arap or authalic");
      return false;
    }
    lengths_ = importing::align_places(patch, part_.toward);
    return true;
  }

  std::string of_file() const { return std::string(reader_.node) + " of \"" + part_.file.path + '"'; }

  const SurfacePart& part_;
  sources::Loading& loading_;
  const Reader& reader_;
  Vec2 lengths_;
};

class SpaceMaker {
 public:
  SpaceMaker(const SurfaceRequest& request, sources::Loading& loading, const Reader& reader, const Hash& key)
      : request_(request), reader_(reader), key_(key), patches_(request, loading, reader) {}

  sources::Loading::Made<SurfaceSpace> run() {
    Shell shell;
    if (!patches_.make(shell.patch)) return {};
    if (request_.is_inward)
      for (auto& [a, b, c] : shell.patch.triangles) std::swap(b, c);
    if (!add_ways(shell)) return {};
    return is_sound(shell) ? made(std::move(shell)) : sources::Loading::Made<SurfaceSpace>();
  }

 private:
  bool add_ways(Shell& shell) {
    const double sign = request_.is_inward ? -1 : 1;
    if (request_.to.path.empty()) {
      for (const Vec3& normal : shell.patch.normals) shell.ways.push_back(sign * normal);
      shell.heights = {request_.standoff_mm, request_.standoff_mm + request_.height_mm};
      return true;
    }
    const auto other = patches_.surface_of(request_.to);
    if (!other) return false;
    shell.heights = {0, 1};
    reach_to(importing::SurfaceRays(other->points, other->triangles), sign, shell);
    return true;
  }

  // Divides triangles until the upper side is near enough to the other surface.
  void reach_to(const importing::SurfaceRays& other, double sign, Shell& shell) {
    constexpr size_t most_triangles = 300000;
    for (;;) {
      shell.ways.clear();
      for (size_t n = 0; n < shell.patch.points.size(); ++n)
        shell.ways.push_back(other.way_from(shell.patch.points[n], sign * shell.patch.normals[n]));
      double farthest = 0;
      for (const auto& [a, b, c] : shell.patch.triangles)
        farthest = std::max(farthest, other.distance((1.0 / 3) * (shell.at(a, 1) + shell.at(b, 1) + shell.at(c, 1))));
      if (farthest <= request_.tolerance_mm) return;
      if (4 * shell.patch.triangles.size() > most_triangles) {
        reader_.diagnostics.warning(reader_.where,
                                    "cells of surface_cells end up to " + format_rounded(farthest) +
                                        " mm away from \"" + request_.to.path + "\"",
                                    "smooth the surface, or set a greater tolerance");
        return;
      }
      shell.patch = importing::divided(shell.patch);
    }
  }

  bool is_sound(const Shell& shell) {
    if (const auto fold = importing::find_fold(shell)) {
      const bool is_between = !request_.to.path.empty();
      const double most = std::abs(fold->height);
      std::string hint = is_between ? "choose a smaller part, or smooth the surface"
                                    : "the surface bends there so that cells may be at most " + format_rounded(most) +
                                          " mm high; make standoff and height smaller, or smooth the surface";
      patches_.refuse("cells are folded at " + place_text(fold->at), hint);
      return false;
    }
    const auto overlap = importing::find_overlap(shell);
    if (overlap)
      patches_.refuse("cells overlap at " + place_text(*overlap),
                      "two parts of the surface face each other there; make height "
                      "smaller, or choose one of the parts");
    return !overlap;
  }

  sources::Loading::Made<SurfaceSpace> made(Shell shell) const {
    constexpr size_t bytes_per_triangle = 900;
    const importing::ShellReport report = importing::report_of(shell);
    patches_.warn_of(report.aspect);
    double way = 0;
    for (const Vec3& v : shell.ways) way += length(v) / static_cast<double>(shell.ways.size());
    auto space = std::make_shared<SurfaceSpace>();
    *space = {nullptr,        patches_.lengths(), shell.heights, way * (shell.heights.hi - shell.heights.lo),
              report.volumes, report.stretches,   report.aspect, {}};
    for (const auto& [a, b] : importing::border_of(shell.patch.triangles))
      space->border.push_back({shell.patch.places[a], shell.patch.places[b]});
    const size_t bytes = bytes_per_triangle * shell.patch.triangles.size();
    space->source = importing::make_shell_source(request_.file.path, std::move(shell), key_);
    return {std::move(space), bytes};
  }

  const SurfaceRequest& request_;
  const Reader& reader_;
  Hash key_;
  PatchMaker patches_;
};

sources::Loading::Made<SurfacePlaces> make_places(const SurfacePlacesRequest& request, sources::Loading& loading,
                                                  const Reader& reader, const Hash& key) {
  constexpr size_t bytes_per_triangle = 500;
  PatchMaker patches(request, loading, reader);
  SurfacePatch patch;
  if (!patches.make(patch)) return {};
  const importing::ShellReport report = importing::report_of({patch, patch.normals, {0, 0}});
  patches.warn_of(report.aspect);
  const size_t bytes = bytes_per_triangle * patch.triangles.size();
  auto places = std::make_shared<SurfacePlaces>();
  *places = {importing::make_place_source(request.file.path, std::move(patch), key), patches.lengths(),
             report.stretches};
  return {std::move(places), bytes};
}

void add(sources::Key& key, const std::optional<Vec3>& point) {
  key.add(point ? 1.0 : 0.0);
  if (point) key.add(point->x).add(point->y).add(point->z);
}

void add(sources::Key& key, const SurfacePart& part) {
  key.add(part.file.content).add(ending_of(part.file.path));
  add(key, part.at);
  add(key, part.box ? std::optional(part.box->lo) : std::nullopt);
  add(key, part.box ? std::optional(part.box->hi) : std::nullopt);
  add(key, part.normal);
  add(key, part.toward);
  key.add(part.kind).add(part.area_mm2.lo).add(part.area_mm2.hi).add(part.tolerance_mm);
  key.add(part.angle_deg).add(part.within_deg).add(part.method.text());
}

}  // namespace

std::shared_ptr<const program::FieldSource> GeodesicRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  sources::Key key("shortest ways");
  key.add(file.content).add(ending_of(file.path));
  for (const Vec3& p : from) key.add(p.x).add(p.y).add(p.z);
  const Hash hash = key.hash();
  return loading.cached<Result>(hash, file.path, [&](const Reader& reader) {
    using Made = sources::Loading::Made<Result>;
    auto mesh = formats::read_mesh(file.path, *loading.bytes(file), reader.diagnostics);
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
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  if (!to.path.empty() && (!loading.find(to) || !loading.read_content(to))) return nullptr;
  sources::Key key("surface");
  add(key, *this);
  key.add(to.path.empty() ? 0.0 : 1.0);
  if (!to.path.empty()) key.add(to.content).add(ending_of(to.path));
  key.add(standoff_mm).add(height_mm).add(is_inward ? 1.0 : 0.0);
  const Hash hash = key.hash();
  return loading.cached<Result>(hash, file.path,
                                [&](const Reader& reader) { return SpaceMaker(*this, loading, reader, hash).run(); });
}

std::shared_ptr<const SurfacePlaces> SurfacePlacesRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  sources::Key key("places on a surface");
  add(key, *this);
  const Hash hash = key.hash();
  return loading.cached<Result>(hash, file.path,
                                [&](const Reader& reader) { return make_places(*this, loading, reader, hash); });
}

}  // namespace ombre::design
