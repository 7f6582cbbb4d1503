#include "jobs/mesh/mesh_job.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "jobs/mesh/exact_bodies.h"
#include "questions/build.h"
#include "questions/design_stages.h"
#include "surface/cells/cell_grid.h"
#include "surface/mesh/contour.h"

namespace ombre::compile {
namespace {

void add_bodies(const design::Design& design, const RegionProgram& program, const Box& box,
                const surface::RegionSurface& surface, MeshedDesign& made, Diagnostics& diagnostics) {
  const std::vector<design::Rgba> colours = region_colours(design, program, box, diagnostics);
  const size_t count = program.regions.size();
  for (size_t n = 0; n < count; ++n) {
    const Region& region = program.regions[n];
    if (is_void(region)) continue;
    surface::Body body = surface::body_of(surface, static_cast<surface::Label>(n + 1));
    if (body.triangles.empty()) continue;
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0;
    const double volume = surface::volume_mm3(body), area = surface::area_mm2(body);
    made.bodies.push_back({region, share, colours[n], std::move(body), volume, area});
  }
}

// The number of cells at a surface grows with the square of their fineness.
MeshPlan estimate_mesh(const RegionProgram& program, const Box& box, const Fineness& fineness, int threads) {
  constexpr double coarse_cells = 48;
  const Vec3 size = box.size();
  const double fine = fineness.cell.mm(), longest = std::max({size.x, size.y, size.z});
  Pitch cell = fineness.cell;
  if (const auto coarse = Pitch::from_mm(longest / coarse_cells); coarse && coarse->mm() > fine) cell = *coarse;
  const auto mixed = surface::find_mixed_cells(program.partition.label, corners_over(box, cell), threads);
  const double finer = cell.mm() / fine;
  MeshPlan plan{fineness.tolerance_mm, fine, static_cast<double>(mixed.cells().size()) * finer * finer, 0};
  plan.memory_bytes = plan.cells * surface::bytes_per_mixed_cell;
  return plan;
}

// Returns false, and adds a diagnostic, if the mesh clearly takes too much memory. Close cases are decided when the
// cells are known.
bool fits(const MeshPlan& plan, const MeshRequest& request, const Loaded& loaded, Diagnostics& diagnostics) {
  constexpr double doubt = 1.5;
  const auto allowed = static_cast<double>(request.memory_bytes);
  if (request.memory_bytes == 0 || plan.memory_bytes <= doubt * allowed) return true;
  diagnostics.error(Code::memory, {loaded.source, 0, 0},
                    "cells of " + format_rounded(plan.cell_mm, 3) + " mm, about " +
                        format_count(static_cast<unsigned long long>(plan.cells)) + " at the surface, take about " +
                        format_bytes(plan.memory_bytes) + " of memory, more than the " + format_bytes(allowed) +
                        " allowed",
                    "choose a larger " + spelled::option("--cell") + " or " + spelled::option("--tolerance") +
                        ", or more " + spelled::option("--memory"));
  return false;
}

StageLoan loan(const MeshRequest& request, Progress* progress, const StopFlag* stop) {
  StageLoan loan{request.threads, StageLoan().memory_bytes, progress, stop};
  if (request.memory_bytes > 0) loan.memory_bytes = request.memory_bytes;
  return loan;
}

std::optional<MaterialsInside> materials_of(const design::Design& design, int threads, Diagnostics& diagnostics) {
  const std::optional<Box> box = design_box(design, diagnostics);
  return box ? find_materials(design, *box, threads, diagnostics) : std::nullopt;
}

// Requests bands of all materials but the last, whose fraction follows from the others.
void separate(const MaterialsInside& materials, MeshRequest& request) {
  constexpr size_t most_crossed = 4;  // 4^4 bodies are the most that are allowed
  if (materials.names.size() < 2) return;
  const size_t crossed = materials.names.size() - 1;
  if (!materials.are_mixed || request.beams || crossed > most_crossed) {
    request.by_material = true;
    return;
  }
  request.bands = BandRequest{};
  if (crossed == 1) return;
  request.bands->of = materials.names[0];
  for (size_t n = 1; n < crossed; ++n) request.crossed.push_back({.of = materials.names[n]});
}

// Limit of cells at the surface, which take some seconds, for meshes without a chosen tolerance. A design that would
// have more gets a tolerance of up to most_coarser times the usual one.
constexpr double usual_cells = 200'000;
constexpr double most_coarser = 5;

MeshedDesign make_surface(const PlannedSurface& planned, const surface::GridBorders* known, Diagnostics& diagnostics,
                          Progress* progress) {
  MeshedDesign made;
  made.tolerance_mm = planned.plan.tolerance_mm;
  made.cell_mm = planned.plan.cell_mm;
  made.is_coarser = planned.is_coarser;
  const surface::RegionSurface surface = surface::contour(planned.program.partition, planned.contour, progress, known);
  made.report = surface.report;
  add_bodies(planned.design, planned.program, planned.box, surface, made, diagnostics);
  return made;
}

// A run of the mesher, on a design or on its rest without struts.
class Mesher {
 public:
  Mesher(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics, Progress* progress,
         const StopFlag* stop)
      : loaded_(loaded), request_(request), diagnostics_(diagnostics), progress_(progress), stop_(stop) {}

  // `shape` is a part of the design; null: all of it.
  std::optional<PlannedSurface> plan(const design::Design& whole, const design::NodePtr& shape) {
    const std::optional<Box> box = design_box(shape ? alone(whole, shape) : whole, diagnostics_);
    if (!box) return std::nullopt;
    const auto fineness = usual_fineness(whole, *box, shape);
    if (!fineness) return std::nullopt;
    design::Design design = for_tolerance(whole, fineness->tolerance_mm);
    auto program = build_regions(design, *box, request_, diagnostics_, shape);
    if (!program) return std::nullopt;
    stages_of(design)->prepare(loan(request_, progress_, stop_));
    const MeshPlan estimate = estimate_mesh(*program, *box, *fineness, request_.threads);
    if (request_.announce) request_.announce(estimate);
    if (!fits(estimate, request_, loaded_, diagnostics_)) return std::nullopt;
    surface::ContourOptions contour;
    contour.corners = corners_over(*box, fineness->cell);
    contour.tolerance_mm = fineness->tolerance_mm;
    contour.join_flat = request_.join_flat;
    contour.workers = {request_.threads, stop_};
    contour.memory_bytes = request_.memory_bytes;
    return PlannedSurface{std::move(design), std::move(*program), *box, estimate, is_coarser_, contour};
  }

  std::optional<MeshedDesign> mesh(const design::Design& whole, const design::NodePtr& shape) {
    const auto planned = plan(whole, shape);
    return planned ? std::optional(make_surface(*planned, nullptr, diagnostics_, progress_)) : std::nullopt;
  }

  std::optional<MeshedDesign> mesh_beams() {
    if (!take_fineness()) return std::nullopt;
    const design::Design& design = loaded_.design;
    const auto parts = split_beams(design, request_.threads, diagnostics_);
    if (!parts) return std::nullopt;
    MeshedDesign made;
    if (parts->rest && !parts->rest->bounds(design::design_space()).is_empty()) {
      auto rest = mesh(design, parts->rest);
      if (!rest) return std::nullopt;
      made = std::move(*rest);
    }
    made.tolerance_mm = *request_.tolerance_mm;
    made.cell_mm = *request_.cell_mm;
    for (const BeamSet& set : parts->sets)
      if (!add_set(set, made)) return std::nullopt;
    report_graded();
    return made;
  }

 private:
  // Chooses a tolerance by the design's size, and a coarser one if that would make too many cells. Cells are counted in
  // a design that is as coarse as it may become, whose stages take little time.
  std::optional<Fineness> usual_fineness(const design::Design& whole, const Box& box, const design::NodePtr& shape) {
    const auto fine = choose_fineness(whole, box, request_, diagnostics_);
    if (!fine || request_.tolerance_mm || request_.cell_mm) return fine;
    Diagnostics reported_later;
    const design::Design coarse = for_tolerance(whole, most_coarser * fine->tolerance_mm);
    const auto program = build_regions(coarse, box, request_, reported_later, shape);
    if (!program) return fine;
    stages_of(coarse)->prepare(loan(request_, progress_, stop_));
    const double cells = estimate_mesh(*program, box, *fine, request_.threads).cells;
    const double coarser = std::clamp(std::ceil(std::sqrt(cells / usual_cells)), 1.0, most_coarser);
    if (coarser == 1) return fine;
    is_coarser_ = true;
    RegionRequest chosen = request_;
    chosen.tolerance_mm = coarser * fine->tolerance_mm;
    return choose_fineness(whole, box, chosen, diagnostics_);
  }

  static design::Design alone(const design::Design& design, const design::NodePtr& solid) {
    design::Design part = design;
    part.parts = {{"", solid}};
    return part;
  }

  // Gives every surface the fineness of the whole design.
  bool take_fineness() {
    const std::optional<Box> box = design_box(loaded_.design, diagnostics_);
    const auto fineness = box ? choose_fineness(loaded_.design, *box, request_, diagnostics_) : std::nullopt;
    if (!fineness) return false;
    request_.tolerance_mm = fineness->tolerance_mm;
    request_.cell_mm = fineness->cell.mm();
    return true;
  }

  bool add_set(const BeamSet& set, MeshedDesign& made) {
    BeamBody body = beams_of(set);
    const auto graded = add_materials(loaded_.design, request_.threads, body, diagnostics_, stop_);
    if (!graded) return false;
    graded_ += *graded;
    if (!request_.by_material) body.materials.clear();
    if (body.beams.empty()) return true;
    if (set.clip && !add_clip(set, body, made)) return false;
    made.beams.push_back(std::move(body));
    return true;
  }

  bool add_clip(const BeamSet& set, BeamBody& body, MeshedDesign& made) {
    const design::NodePtr clip = with_end(set);
    if (!clip) return false;
    MeshRequest whole = request_;
    whole.by_material = false;
    design::Design design = alone(loaded_.design, clip);
    design.sampling = std::nullopt;
    auto meshed = Mesher(loaded_, whole, diagnostics_, progress_, stop_).mesh(design, nullptr);
    if (!meshed) return false;
    add_report(meshed->report, made.report);
    if (meshed->bodies.empty()) {
      diagnostics_.error(Code::option, set.clip->where(), "the solid that cuts struts is smaller than the cells",
                         "choose a smaller " + spelled::option("--cell"));
      return false;
    }
    body.clip = made.clips.size();
    made.clips.push_back(std::move(meshed->bodies[0].body));
    return true;
  }

  // Returns a clip with its bounds; an unbounded one is cut off near the struts.
  design::NodePtr with_end(const BeamSet& set) {
    const Box space = design::design_space(), bounds = set.clip->bounds(space);
    const bool has_end = bounds.lo.x > space.lo.x && bounds.lo.y > space.lo.y && bounds.lo.z > space.lo.z &&
                         bounds.hi.x < space.hi.x && bounds.hi.y < space.hi.y && bounds.hi.z < space.hi.z;
    return has_end ? set.clip : clip_near_struts(loaded_.design, set, diagnostics_);
  }

  static void add_report(const surface::ContourReport& of, surface::ContourReport& all) {
    all.intersections += of.intersections;
    all.folded += of.folded;
    all.farthest_in_tolerances = std::max(all.farthest_in_tolerances, of.farthest_in_tolerances);
    if (all.lost.places == 0) all.lost.first = of.lost.first;
    all.lost.places += of.lost.places;
  }

  void report_graded() {
    if (graded_ == 0 || !request_.by_material) return;
    diagnostics_.warning({loaded_.source, 0, 0},
                         (graded_ == 1 ? "1 beam has" : format_count(graded_) + " beams have") +
                             " other materials at one end than at the other; each beam is of one, that in its middle");
  }

  const Loaded& loaded_;
  MeshRequest request_;
  Diagnostics& diagnostics_;
  Progress* progress_;
  const StopFlag* stop_;
  size_t graded_ = 0;
  bool is_coarser_ = false;
};

// A request with the regions that the design's materials take.
struct Chosen {
  MeshRequest request;
  MaterialsInside materials;
};

std::optional<Chosen> choose_regions(const design::Design& design, const MeshRequest& request,
                                     Diagnostics& diagnostics) {
  Chosen chosen{request, {}};
  if (request.usual == UsualRegions::as_requested) return chosen;
  auto found = materials_of(design, request.threads, diagnostics);
  if (!found) return std::nullopt;
  chosen.materials = std::move(*found);
  if (request.usual == UsualRegions::separate) separate(chosen.materials, chosen.request);
  return chosen;
}

Loaded staged(const Loaded& loaded, const MeshRequest& request, Progress* progress, const StopFlag* stop) {
  return {loaded.path, loaded.source, with_stages(loaded.design, loan(request, progress, stop))};
}

}  // namespace

std::optional<PlannedMesh> plan_mesh(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                     Progress* progress, const StopFlag* stop) {
  Loaded own = staged(loaded, request, progress, stop);
  auto chosen = choose_regions(own.design, request, diagnostics);
  if (!chosen) return std::nullopt;
  auto surface = Mesher(own, chosen->request, diagnostics, progress, stop).plan(own.design, nullptr);
  if (!surface) return std::nullopt;
  return PlannedMesh{std::move(own), std::move(chosen->materials), chosen->request.bands.has_value(),
                     std::move(*surface)};
}

MeshedDesign make_mesh(const PlannedMesh& planned, const surface::GridBorders* known, Diagnostics& diagnostics,
                       Progress* progress) {
  MeshedDesign made = make_surface(planned.surface, known, diagnostics, progress);
  made.materials = planned.materials;
  made.is_by_bands = planned.is_by_bands;
  return made;
}

std::optional<MeshedDesign> mesh_design(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                        Progress* progress, const StopFlag* stop) {
  if (request.keeps_polyhedra)
    if (auto exact = exact_bodies(loaded.design, request, stop)) return exact;
  if (!request.beams) {
    const auto planned = plan_mesh(loaded, request, diagnostics, progress, stop);
    return planned ? std::optional(make_mesh(*planned, nullptr, diagnostics, progress)) : std::nullopt;
  }
  const Loaded own = staged(loaded, request, progress, stop);
  auto chosen = choose_regions(own.design, request, diagnostics);
  if (!chosen) return std::nullopt;
  auto made = Mesher(own, chosen->request, diagnostics, progress, stop).mesh_beams();
  if (!made) return std::nullopt;
  made->materials = std::move(chosen->materials);
  made->is_by_bands = chosen->request.bands.has_value();
  return made;
}

}  // namespace ombre::compile
