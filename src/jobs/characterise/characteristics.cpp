#include "jobs/characterise/characteristics.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "jobs/characterise/surface_areas.h"
#include "jobs/mesh/mesh_job.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

constexpr double most_voxels_along = 4096;

// Returns the design, sampled in the box by about so many voxels of the size; nothing, and a diagnostic, if these are
// too many.
LoadedPtr sampled(const LoadedPtr& loaded, const Box& box, double voxel_mm, Diagnostics& diagnostics) {
  design::Sampling sampling;
  sampling.box = box;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = box.size()[axis], count = std::max(1.0, std::round(size / voxel_mm));
    if (!(size > 0) || count > most_voxels_along) {
      diagnostics.error(Code::option, {loaded->source, 0, 0},
                        "the box has " + format_rounded(count) + " voxels along " + std::string(1, "xyz"[axis]) +
                            "; at most " + format_rounded(most_voxels_along) + " are possible",
                        "choose another " + spelled::option("--voxel") + " or " + spelled::option("--box"));
      return nullptr;
    }
    const auto whole = Pitch::from_mm(size);
    const auto part =
        whole ? Pitch::from_ratio(whole->numerator, whole->denominator * static_cast<int64_t>(count)) : std::nullopt;
    sampling.pitch[static_cast<size_t>(axis)] = part ? *part : *Pitch::from_mm(size / count);
  }
  Loaded copy = *loaded;
  copy.design.sampling = sampling;
  return std::make_shared<const Loaded>(std::move(copy));
}

std::optional<SolidGrid> grid_of(const LoadedPtr& loaded, const CharacteriseRequest& request,
                                 const PlanOptions& options, Diagnostics& diagnostics) {
  const auto plan = plan_slice(loaded, options, diagnostics);
  if (!plan) return std::nullopt;
  plan->stages->prepare({request.threads, request.memory_bytes, request.progress, request.stop});
  return solid_grid(*plan, request.threads, request.memory_bytes, request.progress, request.stop);
}

std::optional<Surfaces> surfaces_at(const Loaded& loaded, const Box& box, const CharacteriseRequest& request,
                                    double cell_mm, Diagnostics& diagnostics) {
  MeshRequest mesh;
  mesh.cell_mm = cell_mm;
  mesh.tolerance_mm = cell_mm / cells_of_tolerance;
  mesh.by_material = true;
  mesh.join_flat = false;
  mesh.threads = request.threads;
  mesh.memory_bytes = request.memory_bytes;
  const auto meshed = mesh_design(loaded, mesh, diagnostics, request.progress, request.stop);
  if (!meshed) return std::nullopt;
  return surfaces_of(*meshed, box, request.periodic);
}

std::map<std::string, Measured> measured(const std::map<std::string, double>& fine,
                                         const std::map<std::string, double>& coarse) {
  std::map<std::string, Measured> all;
  for (const auto& [name, value] : fine) {
    const auto other = coarse.find(name);
    all[name] = Measured::from(value, other == coarse.end() ? 0 : other->second);
  }
  return all;
}

void add_sections(const SolidGrid& grid, Characteristics& found) {
  const Vec3 voxel = grid.lattice.voxel_mm(), size = found.box.size();
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<int>((axis + 1) % 3), b = static_cast<int>((axis + 2) % 3);
    for (const uint64_t count : grid.sections[axis])
      found.section_areas_mm2[axis].push_back(static_cast<double>(count) * voxel[a] * voxel[b]);
    found.sections[axis] = Spread::of(found.section_areas_mm2[axis]).over(size[a] * size[b]);
  }
}

Data list_of(const std::vector<double>& values) { return DataList(values.begin(), values.end()); }
Data point(Vec3 v) { return DataList{v.x, v.y, v.z}; }

Data thin_data(const ThinPlace& thin) {
  DataMembers members{{"mm", thin.least_mm}, {"is_found", thin.is_found}};
  if (thin.is_found) members.emplace_back("place", point(thin.place));
  return members;
}

Data measured_data(const std::map<std::string, Measured>& all) {
  DataMembers members;
  for (const auto& [name, one] : all)
    members.emplace_back(name, DataMembers{{"value", one.value}, {"error", one.error}});
  return members;
}

}  // namespace

Measured Measured::from(double fine, double coarse) {
  return {fine + (fine - coarse) / 3, std::abs(fine - coarse) / 3};
}

double Characteristics::box_mm3() const {
  const Vec3 size = box.size();
  return size.x * size.y * size.z;
}

double Characteristics::hydraulic_diameter_mm() const {
  return surface_mm2.value > 0 ? 4 * std::max(0.0, box_mm3() - volume_mm3.value) / surface_mm2.value : 0;
}

std::optional<int64_t> Characteristics::genus() const {
  if (is_periodic()) return std::nullopt;
  return static_cast<int64_t>(pieces.count) + static_cast<int64_t>(voids.enclosed) - euler;
}

std::vector<std::pair<std::string, double>> Characteristics::numbers() const {
  std::vector<std::pair<std::string, double>> rows{{"density", density()},
                                                   {"density_error", density_error()},
                                                   {"porosity", 1 - density()},
                                                   {"volume_mm3", volume_mm3.value},
                                                   {"volume_error_mm3", volume_mm3.error},
                                                   {"surface_mm2", surface_mm2.value},
                                                   {"surface_error_mm2", surface_mm2.error},
                                                   {"inner_surface_mm2", inner_mm2.value},
                                                   {"surface_per_box_per_mm", surface_mm2.value / box_mm3()},
                                                   {"hydraulic_diameter_mm", hydraulic_diameter_mm()},
                                                   {"pieces", static_cast<double>(pieces.count)},
                                                   {"euler_number", static_cast<double>(euler)}};
  if (genus()) rows.emplace_back("genus", static_cast<double>(*genus()));
  rows.emplace_back("least_wall_mm", wall.least_mm);
  rows.emplace_back("least_gap_mm", gap.least_mm);
  for (size_t axis = 0; axis < 3; ++axis)
    rows.emplace_back(std::string("least_section_") + "xyz"[axis], sections[axis].least);
  return rows;
}

DataMembers Characteristics::data() const {
  DataMembers members;
  for (const auto& [name, value] : numbers()) members.emplace_back(name, value);
  members.emplace_back("box", DataList{point(box.lo), point(box.hi)});
  members.emplace_back("voxel_mm", point(voxel_mm));
  members.emplace_back("centroid", point({centroid[0], centroid[1], centroid[2]}));
  members.emplace_back("void_pieces", static_cast<double>(voids.count));
  if (!is_periodic()) members.emplace_back("hollows", static_cast<double>(voids.enclosed));
  members.emplace_back("coarse_euler_number", static_cast<double>(coarse_euler));
  members.emplace_back("wall", thin_data(wall));
  members.emplace_back("gap", thin_data(gap));
  members.emplace_back("material_mm3", measured_data(material_mm3));
  members.emplace_back("interface_mm2", measured_data(interface_mm2));
  DataMembers across;
  for (size_t axis = 0; axis < 3; ++axis) {
    DataMembers own = sections[axis].data();
    own.emplace_back("areas_mm2", list_of(section_areas_mm2[axis]));
    across.emplace_back(std::string(1, "xyz"[axis]), own);
  }
  members.emplace_back("sections", across);
  DataList foams;
  for (const RandomCells& foam : random_cells) foams.emplace_back(foam.data());
  if (!foams.empty()) members.emplace_back("random_cells", foams);
  DataList graphs;
  for (const LatticeGraph& lattice : lattices) graphs.emplace_back(lattice.data());
  if (!graphs.empty()) members.emplace_back("lattices", graphs);
  return members;
}

std::optional<Characteristics> characteristics_of(const LoadedPtr& loaded, const CharacteriseRequest& request,
                                                  const PlanOptions& options, Diagnostics& diagnostics) {
  const std::optional<Box> box = request.box ? request.box : design_box(loaded->design, diagnostics);
  if (!box) return std::nullopt;
  const LoadedPtr fine = sampled(loaded, *box, request.voxel_mm, diagnostics);
  const LoadedPtr coarse = fine ? sampled(loaded, *box, 2 * request.voxel_mm, diagnostics) : nullptr;
  if (!coarse) return std::nullopt;
  const auto grid = grid_of(fine, request, options, diagnostics);
  const auto coarse_grid = grid ? grid_of(coarse, request, options, diagnostics) : std::nullopt;
  if (!coarse_grid) return std::nullopt;
  if (grid->solid() == 0) {
    diagnostics.error(
        Code::nothing_inside, {loaded->source, 0, 0}, "no voxel of the box is solid",
        "choose smaller voxels with " + spelled::option("--voxel") + ", or another " + spelled::option("--box"));
    return std::nullopt;
  }
  const auto surfaces = surfaces_at(*fine, *box, request, request.voxel_mm, diagnostics);
  const auto coarse_surfaces =
      surfaces ? surfaces_at(*coarse, *box, request, 2 * request.voxel_mm, diagnostics) : std::nullopt;
  if (!coarse_surfaces) return std::nullopt;
  Characteristics found;
  found.box = *box;
  found.voxel_mm = grid->lattice.voxel_mm();
  found.periodic = request.periodic;
  found.volume_mm3 = Measured::from(surfaces->volume_mm3, coarse_surfaces->volume_mm3);
  found.surface_mm2 = Measured::from(surfaces->surface_mm2, coarse_surfaces->surface_mm2);
  found.inner_mm2 = Measured::from(surfaces->inner_mm2, coarse_surfaces->inner_mm2);
  found.material_mm3 = measured(surfaces->material_mm3, coarse_surfaces->material_mm3);
  found.interface_mm2 = measured(surfaces->interface_mm2, coarse_surfaces->interface_mm2);
  found.centroid = grid->mean_place;
  add_sections(*grid, found);
  found.pieces = solid_pieces(*grid, request.periodic);
  found.voids = void_pieces(*grid, request.periodic);
  found.euler = euler_number(*grid, request.periodic);
  found.coarse_euler = euler_number(*coarse_grid, request.periodic);
  found.wall = thinnest_place(*grid, request.periodic, false, request.stop);
  found.gap = thinnest_place(*grid, request.periodic, true, request.stop);
  found.random_cells = random_cells_of(loaded->design);
  found.lattices = lattice_graphs_of(loaded->design);
  return found;
}

}  // namespace ombre::compile
