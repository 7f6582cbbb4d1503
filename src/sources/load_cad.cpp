// Loads CAD files for designs.
#include "cad/solids.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "import/surfaces/cad_source.h"
#include "sources/cad_file.h"
#include "sources/cad_remarks.h"
#include "sources/loading.h"
#include "sources/mesh_materials.h"

namespace ombre::sources {

constexpr size_t bytes_of_file_byte = 20;  // estimate for shapes and triangles, per byte of the file

namespace {

// Returns "STEP (.step, .stp), IGES (.iges, .igs)" and so on.
std::string formats_text() {
  std::vector<std::string> formats;
  for (const FileFormat& format : cad::file_formats()) {
    const std::vector<std::string> endings(format.endings.begin(), format.endings.end());
    formats.push_back(std::string(format.name) + " (" + join(endings, ", ") + ')');
  }
  return join(formats, ", ");
}

}  // namespace

std::shared_ptr<const CadFile> read_cad(const design::FilePath& file, Loading& loading) {
  if (!cad::is_cad_file(file.path)) {
    loading.reader().diagnostics.error(Code::file_kind, loading.reader().where,
                                       "\"" + file.path + "\" is no CAD file that can be read here",
                                       "cad reads " + formats_text() + "; write mesh for triangles");
    return nullptr;
  }
  using Made = Loading::Made<CadFile>;
  const Hash key = Key("cad file").add(file.content).add(ending_of(file.path)).hash();
  return loading.cached<CadFile>(key, file.path, [&](const design::Reader&) {
    const size_t bytes = bytes_of_file_byte * loading.bytes(file)->size();
    return Made{std::make_shared<CadFile>(CadFile{cad::read_solids(file.path, loading.stop()), bytes}), bytes};
  });
}

}  // namespace ombre::sources

namespace ombre::design {
namespace {

using sources::CadFile, sources::read_cad;

// Duration from which a job gets a remark, and the tolerance in voxels of the triangles that it recommends.
constexpr double least_reported_seconds = 20, fast_voxels = 0.02;
// Tolerances as shares of the solid's diagonal: without a job, of triangles for the first pass of exact surfaces, and
// the least allowed. Closer triangles leave fewer exact queries.
constexpr double diagonals_of_tolerance = 1e-3, diagonals_of_first_look = 1e-4, least_diagonals = 1e-6;

class SolidsOfMaterial final : public PendingSource {
 public:
  SolidsOfMaterial(std::string name, Hash content, std::vector<cad::SolidPtr> solids, const CadRequest& use)
      : name_(std::move(name)),
        content_(content),
        solids_(std::move(solids)),
        is_exact_(use.is_exact),
        tolerance_(use.tolerance_mm) {
    for (const cad::SolidPtr& solid : solids_) bounds_ = hull(bounds_, solid->bounds);
  }

  Hash content() const override { return content_; }
  Box bounds() const override { return bounds_; }

  program::SourceField make(const std::optional<JobScale>& scale) const override {
    const std::lock_guard lock(mutex_);
    return made_for(tolerance_for(scale)).source;
  }

  std::vector<Remark> remarks(const std::optional<JobScale>& scale) const override {
    const std::lock_guard lock(mutex_);
    const double tolerance = tolerance_for(scale);
    std::vector<Remark> remarks;
    if (const auto& open = made_for(tolerance).open; !open.empty())
      remarks.push_back(sources::remark_on_gaps(name_, open, tolerance, is_exact_));
    if (const auto remark = is_exact_ && scale ? remark_for(made_for(tolerance), scale->voxel_mm) : std::nullopt)
      remarks.push_back(*remark);
    return remarks;
  }

 private:
  // Returns a remark on the time that an exact source takes, if it is long.
  std::optional<Remark> remark_for(const importing::CadSource& exact, Vec3 voxel_mm) const {
    if (!doubtful_seconds_) doubtful_seconds_ = importing::measure_doubtful_seconds(exact);
    const double voxels = exact.doubtful_mm3 / (voxel_mm.x * voxel_mm.y * voxel_mm.z);
    const double seconds = *doubtful_seconds_ * voxels / core_count();
    if (seconds < least_reported_seconds) return std::nullopt;
    return sources::remark_on_time(name_, voxels, seconds,
                                   fast_voxels * std::min({voxel_mm.x, voxel_mm.y, voxel_mm.z}));
  }

  const importing::CadSource& made_for(double tolerance) const {
    importing::CadSource& made = made_[tolerance];
    if (made.source) return made;
    const Hash own = hash_bytes(content_.hex() + format_number(tolerance));
    made = is_exact_ ? importing::make_exact_source(name_, solids_, own, tolerance)
                     : importing::make_triangle_source(name_, solids_, own, tolerance);
    return made;
  }

  double tolerance_for(const std::optional<JobScale>& scale) const {
    const double diagonal = length(bounds_.size());
    double tolerance = (is_exact_ ? diagonals_of_first_look : diagonals_of_tolerance) * diagonal;
    if (tolerance_ > 0)
      tolerance = tolerance_;
    else if (scale && !is_exact_)
      tolerance = scale->triangles_mm;
    return std::max(tolerance, least_diagonals * diagonal);
  }

  std::string name_;
  Hash content_;
  std::vector<cad::SolidPtr> solids_;
  bool is_exact_;
  double tolerance_;
  Box bounds_;
  mutable std::mutex mutex_;
  mutable std::optional<double> doubtful_seconds_;  // measured once, so that a job always reports the same time
  mutable std::map<double, importing::CadSource> made_;
};

std::vector<std::string> names_of_solids(const std::vector<cad::SolidPtr>& solids) {
  std::vector<std::string> names;
  for (const cad::SolidPtr& solid : solids)
    if (!solid->name.empty() && std::find(names.begin(), names.end(), solid->name) == names.end())
      names.push_back(solid->name);
  return names;
}

// Returns the solids of a name, or all. Empty, with a diagnostic, if no solid has the name.
std::vector<cad::SolidPtr> choose_solids(const std::string& path, const std::vector<cad::SolidPtr>& solids,
                                         const std::string& object, const Reader& reader) {
  if (object.empty()) return solids;
  std::vector<cad::SolidPtr> chosen;
  for (const cad::SolidPtr& solid : solids)
    if (solid->name == object) chosen.push_back(solid);
  if (!chosen.empty()) return chosen;
  reader.diagnostics.error(
      Code::unknown_object, reader.where, "the CAD file \"" + path + "\" has no solid \"" + object + '"',
      sources::hint_of_names(object, names_of_solids(solids), "its solids have no names: leave object out"),
      {{"file", path}, {"name", object}});
  return {};
}

// Returns one group per solid; a solid's name is also the name of its material.
std::vector<formats::MeshGroup> groups_of(const std::vector<cad::SolidPtr>& solids) {
  std::vector<formats::MeshGroup> groups;
  for (const cad::SolidPtr& solid : solids) {
    formats::MeshGroup group{solid->name, 0, 0};
    group.material = solid->name;
    group.colour = solid->colour;
    groups.push_back(std::move(group));
  }
  return groups;
}

struct MaterialSolids {
  MaterialName material;
  std::vector<cad::SolidPtr> solids = {};
};

// Returns the solids by material, in the order in which materials first occur in the file.
std::optional<std::vector<MaterialSolids>> solids_by_material(const std::string& path,
                                                              const std::vector<cad::SolidPtr>& solids,
                                                              const MeshUse& use, const Reader& reader) {
  std::vector<MaterialSolids> parts;
  if (use.materials == "one") {
    parts.push_back({use.material, solids});
    return parts;
  }
  const auto materials = sources::find_materials({"the CAD file", "cad", path, "give its solids names or colours"},
                                                 groups_of(solids), use, reader);
  if (!materials) return std::nullopt;
  for (size_t n = 0; n < solids.size(); ++n) {
    const Material* material = (*materials)[n];
    const auto same = [&](const MaterialSolids& part) { return part.material.material == material; };
    auto part = std::find_if(parts.begin(), parts.end(), same);
    if (part == parts.end()) part = parts.insert(part, MaterialSolids{{material}, {}});
    part->solids.push_back(solids[n]);
  }
  return parts;
}

std::vector<CadPart> parts_of(const CadFile& file, const CadRequest& request, const Reader& reader) {
  const std::vector<cad::SolidPtr> solids = choose_solids(request.file.path, file.solids, request.use.object, reader);
  if (solids.empty()) return {};
  const auto materials = solids_by_material(request.file.path, solids, request.use, reader);
  if (!materials) return {};
  std::vector<CadPart> parts;
  for (const MaterialSolids& part : *materials) {
    std::string own = request.file.content.hex() + request.use.object, name;
    if (request.use.materials != "one") own += name = part.material.material->name;
    parts.push_back({name, std::make_shared<SolidsOfMaterial>(request.file.path, hash_bytes(own), part.solids, request),
                     part.solids.size() == 1});
  }
  return parts;
}

}  // namespace

std::shared_ptr<const std::vector<CadPart>> CadRequest::load(sources::Loading& loading) {
  if (!loading.find(file)) return nullptr;
  if (!loading.read_content(file)) return nullptr;
  sources::Key key("cad");
  key.add(file.content).add(ending_of(file.path)).add(is_exact ? "exact" : "fast").add(tolerance_mm);
  sources::add_use(key, use, loading.reader());
  using Made = sources::Loading::Made<Result>;
  return loading.cached<Result>(key.hash(), file.path, [&](const Reader& reader) -> Made {
    const auto read = read_cad(file, loading);
    if (!read) return {};
    auto parts = std::make_shared<Result>(parts_of(*read, *this, reader));
    return {parts->empty() ? nullptr : parts, read->bytes};
  });
}

}  // namespace ombre::design
