#include "jobs/mesh/exact_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "design/values.h"
#include "jobs/mesh/beam_parts.h"
#include "nodes/common/node_polyhedra.h"
#include "solids/booleans.h"
#include "solids/kernel.h"

namespace ombre::compile {
namespace {

using design::Material;
using design::Node;
using design::NodePtr;

// A solid of the design, with the name of its part, which may be empty, and the node that has it.
struct NamedSolid {
  solids::Solid solid;
  std::string part;
  const Material* material = nullptr;
  const Node* node = nullptr;
};

// Collects the solids of a design in its order.
class SolidFinder {
 public:
  // Returns false if something in the node is no polyhedron. The outermost name of a part counts.
  bool find(const Node& node, const std::string& part) {
    if (node.type().name == "part") return find(*node.inputs()[0], part.empty() ? name_of(node) : part);
    if (node.type().name == "union" && is_sharp(node))
      return std::ranges::all_of(node.inputs(), [&](const NodePtr& input) { return find(*input, part); });
    const auto polyhedra = nodes::polyhedra_of(node);
    if (!polyhedra) return false;
    for (size_t n = 0; n < polyhedra->pieces->size(); ++n) {
      const solids::Solid* solid = (*polyhedra->pieces)[n].solid();
      const Material* material = polyhedra->materials[n];
      if (!solid || solid->flaw() != solids::Flaw::none || !material || material->id == 0) return false;
      found_.push_back({*solid, part.empty() ? polyhedra->names[n] : part, material, &node});
    }
    return true;
  }

  std::vector<NamedSolid> found() && { return std::move(found_); }

 private:
  static std::string name_of(const Node& part) { return *part.type().get(part, 0, false).string(); }

  std::vector<NamedSolid> found_;
};

std::vector<NamedSolid> solids_of(const design::Design& design) {
  SolidFinder finder;
  for (const design::Part& part : design.parts)
    if (!finder.find(*part.solid, part.name == design::nameless_part ? "" : part.name)) return {};
  return std::move(finder).found();
}

enum class Division : uint8_t { whole, materials, parts };

// A region in the making: its solids without those of earlier regions.
struct ExactRegion {
  Region region;
  std::vector<solids::Solid> solids = {};
  std::map<const Material*, double> volumes = {};
};

class ExactBodies {
 public:
  ExactBodies(const design::Design& design, std::vector<NamedSolid> all, Division division, const solids::Work& work)
      : design_(design), all_(std::move(all)), division_(division), work_(work) {}

  // Returns false if solids of different nodes mix where they overlap.
  bool cut() {
    for (size_t n = 0; n < all_.size(); ++n)
      if (!add(n)) return false;
    return true;
  }

  std::vector<RegionBody> bodies() {
    if (division_ == Division::materials)
      std::stable_sort(regions_.begin(), regions_.end(), [](const ExactRegion& a, const ExactRegion& b) {
        return *a.region.material < *b.region.material;
      });
    if (division_ == Division::parts)
      std::stable_partition(regions_.begin(), regions_.end(),
                            [](const ExactRegion& region) { return region.region.name == rest; });
    std::vector<RegionBody> bodies;
    for (size_t n = 0; n < regions_.size(); ++n) {
      const double share = regions_.size() > 1 ? static_cast<double>(n) / static_cast<double>(regions_.size() - 1) : 0;
      add_body(regions_[n], share, bodies);
    }
    return bodies;
  }

 private:
  static constexpr const char* rest = "rest";

  bool add(size_t n) {
    const NamedSolid& own = all_[n];
    ExactRegion& region = region_of(own);
    std::vector<solids::Solid> before;
    for (size_t other = 0; other < n; ++other) {
      if (&region_of(all_[other]) == &region) continue;
      if (solids::intersect({all_[other].solid, own.solid}, work_).is_empty()) continue;
      if (division_ == Division::materials && all_[other].node != own.node) return false;
      before.push_back(all_[other].solid);
    }
    solids::Solid left = before.empty() ? own.solid : solids::subtract(own.solid, std::move(before), work_);
    region.volumes[own.material] += solids::volume_of(left.mesh());
    region.solids.push_back(std::move(left));
    return true;
  }

  // Returns the region of a solid, which is added at its first one.
  ExactRegion& region_of(const NamedSolid& solid) {
    const Region wanted = region_for(solid);
    auto found = std::ranges::find_if(regions_, [&](const ExactRegion& known) {
      return known.region.name == wanted.name && known.region.material == wanted.material;
    });
    if (found == regions_.end()) found = regions_.insert(found, {wanted});
    return *found;
  }

  Region region_for(const NamedSolid& solid) const {
    switch (division_) {
      case Division::materials:
        return {solid.material->name, solid.material->id, {}, {}};
      case Division::parts:
        return {solid.part.empty() ? rest : solid.part, {}, {}, {}};
      case Division::whole:
        break;
    }
    return {design_.parts.size() == 1 ? design_.parts[0].name : "", {}, {}, {}};
  }

  void add_body(const ExactRegion& region, double share, std::vector<RegionBody>& bodies) const {
    const solids::Solid united = solids::unite(region.solids, work_);
    if (united.is_empty()) return;
    const solids::TriangleMesh& mesh = united.mesh();
    RegionBody body{region.region, share, colour_of(region), {mesh.points, mesh.triangles}};
    body.volume_mm3 = surface::volume_mm3(body.body);
    body.area_mm2 = surface::area_mm2(body.body);
    bodies.push_back(std::move(body));
  }

  // Returns the mean of the materials' colours by their volumes.
  static design::Rgba colour_of(const ExactRegion& region) {
    std::array<double, 4> sum{};
    double volume = 0;
    for (const auto& [material, own] : region.volumes) {
      for (size_t n = 0; n < sum.size(); ++n) sum[n] += own * material->colour[n];
      volume += own;
    }
    design::Rgba colour{};
    for (size_t n = 0; n < sum.size(); ++n) colour[n] = static_cast<uint8_t>(std::lround(sum[n] / volume));
    return colour;
  }

  const design::Design& design_;
  std::vector<NamedSolid> all_;
  Division division_;
  const solids::Work& work_;
  std::vector<ExactRegion> regions_;
};

// Returns the names of materials, each once, in the order of the design's materials.
std::vector<std::string> material_names(const std::vector<NamedSolid>& all) {
  std::map<MaterialId, std::string> names;
  for (const NamedSolid& solid : all) names.try_emplace(solid.material->id, solid.material->name);
  std::vector<std::string> list;
  for (const auto& [id, name] : names) list.push_back(name);
  return list;
}

Division division_of(const MeshRequest& request, const MaterialsInside& materials) {
  if (request.usual == UsualRegions::separate && materials.names.size() > 1) return Division::materials;
  if (request.by_material) return Division::materials;
  return request.by_part ? Division::parts : Division::whole;
}

}  // namespace

std::optional<MeshedDesign> exact_bodies(const design::Design& design, const MeshRequest& request,
                                         const StopFlag* stop) {
  if (request.bands || request.beams || design.sampling || !solids::has_kernel()) return std::nullopt;
  std::vector<NamedSolid> all = solids_of(design);
  if (all.empty()) return std::nullopt;
  MeshedDesign made;
  made.is_exact = true;
  const std::vector<std::string> names = material_names(all);
  const Division division = division_of(request, {names});
  const bool has_parts = std::ranges::any_of(all, [](const NamedSolid& solid) { return !solid.part.empty(); });
  if (division == Division::parts && !has_parts) return std::nullopt;
  if (request.usual != UsualRegions::as_requested) made.materials.names = names;
  const solids::Work work{request.threads, stop};
  ExactBodies bodies(design, std::move(all), division, work);
  if (!bodies.cut()) return std::nullopt;
  made.bodies = bodies.bodies();
  return made.bodies.empty() ? std::nullopt : std::optional(std::move(made));
}

}  // namespace ombre::compile
