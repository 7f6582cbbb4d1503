#include "stages/job_stages.h"

#include <algorithm>
#include <cmath>

#include "base/system/assert.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "stages/halo_source.h"
#include "stages/stage_hash.h"
#include "stages/sweep_source.h"
#include "stages/whole_source.h"

namespace ombre::compile {
namespace {

using design::StageLattice;
using design::StagePlace;

// Number of cells along the longest side if nobody states their size.
constexpr double cells_of_longest_side = 200;
constexpr int64_t most_sweep_cells = 1'000'000, most_sweep_columns = int64_t{1} << 26;
constexpr double halo_share = 0.5;  // share of a job's memory that blocks may take

// Returns the pitch as an exact ratio. Lengths that are not short decimals, such as pixels of a picture, are rounded to
// nine digits.
std::optional<Pitch> pitch_of(double mm) {
  if (const auto exact = Pitch::from_mm(mm)) return exact;
  return Pitch::from_mm(parse_number(format_rounded(mm, 9)).value_or(mm));
}

Vec3 cell_for(const design::Stage& stage, const StagePlace& place) {
  const design::LatticeChoice choice = stage.lattice();
  if (choice.cell_mm) return *choice.cell_mm;
  if (choice.from_corner && place.scale) return place.scale->voxel_mm;
  if (!choice.from_corner && place.voxel_mm) return *place.voxel_mm;
  const Vec3 size = stage.bounds().size();
  const double side = std::max({size.x, size.y, size.z}) / cells_of_longest_side;
  return {side, side, side};
}

[[noreturn]] void fail(const design::Stage& stage, Vec3 cell) {
  throw Error(Code::too_large,
              stage.name() + ": " + too_many_cells(cell) + "; choose larger voxels, or give it a larger pitch");
}

StageLattice lattice_for(const design::Stage& stage, const StagePlace& place) {
  const design::LatticeChoice choice = stage.lattice();
  if (!choice.from_corner && !choice.cell_mm && place.lattice) return *place.lattice;
  StageLattice lattice;
  if (choice.from_corner) lattice.origin = stage.bounds().lo;
  const Vec3 cell = cell_for(stage, place);
  for (int axis = 0; axis < 3; ++axis) {
    const auto pitch = pitch_of(cell[axis]);
    if (!pitch) fail(stage, cell);
    lattice.pitch[static_cast<size_t>(axis)] = *pitch;
  }
  return lattice;
}

// Returns the cells that cover the stage's bounds.
IndexBox cells_for(const design::Stage& stage, const StageLattice& lattice) {
  constexpr double slack = 1e-6;
  const Box bounds = stage.bounds();
  const Vec3 cell{lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()};
  if (bounds.is_empty()) return {{0, 0, 0}, {1, 1, 1}};
  IndexBox cells;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    cells.lo[a] = static_cast<int64_t>(std::floor((bounds.lo[axis] - lattice.origin[axis]) / cell[axis] + slack));
    cells.hi[a] = static_cast<int64_t>(std::ceil((bounds.hi[axis] - lattice.origin[axis]) / cell[axis] - slack));
    if (stage.lattice().from_corner) cells.hi[a] = voxel::voxels_along(bounds.size()[axis], lattice.pitch[a]);
    cells.hi[a] = std::max(cells.hi[a], cells.lo[a] + 1);
  }
  return cells;
}

bool ends(const Box& box) {
  for (int axis = 0; axis < 3; ++axis)
    if (box.lo[axis] <= -design::design_limit_mm || box.hi[axis] >= design::design_limit_mm) return false;
  return true;
}

void grow(LatticeFrame& frame, const design::HaloStage::Reach& reach) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const double cell = frame.lattice.pitch[a].mm();
    // The frame grows down by what a cell reads above it: such a cell lies below the solid.
    frame.cells.lo[a] -= reach.above[a];
    frame.cells.hi[a] += reach.below[a];
    frame.box.lo[axis] -= static_cast<double>(reach.above[a]) * cell;
    frame.box.hi[axis] += static_cast<double>(reach.below[a]) * cell;
  }
}

// Makes an empty design for a stage's solids: in their space the stage's lattice is that of the job.
design::Design design_for(const StagePlace& place, const voxel::Lattice& lattice,
                          const std::shared_ptr<design::StageHost>& stages) {
  design::Design design;
  design.materials = place.materials;
  design.job_scale = lattice.voxel_mm();
  design.job_lattice = StageLattice{lattice.origin, lattice.pitch};
  design.stages = stages;
  return design;
}

// Returns a pointer that does not own the host, since sources would otherwise keep each other alive.
std::shared_ptr<design::StageHost> not_kept(design::StageHost& host) { return {std::shared_ptr<void>(), &host}; }

}  // namespace

std::string too_many_cells(Vec3 cell) {
  return "the part has too many cells of " + format_rounded(cell.x) + " x " + format_rounded(cell.y) + " x " +
         format_rounded(cell.z) + " mm";
}

bool is_sensible_sweep(const Box& bounds, Vec3 cell) {
  double columns = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::ceil(bounds.size()[axis] / cell[axis]);
    if (cells > static_cast<double>(most_sweep_cells)) return false;
    if (axis < 2) columns *= cells;
  }
  return columns <= static_cast<double>(most_sweep_columns);
}

JobStages::JobStages(MakeStageInput make_input)
    : make_input_(make_input), shared_(std::make_shared<SharedStageWork>()) {}

program::SourceField JobStages::source(const design::StagePtr& stage, const StagePlace& place) {
  const StageLattice lattice = lattice_for(*stage, place);
  const Vec3 o = lattice.origin;
  const auto& pitch = lattice.pitch;
  const Key key{stage.get(), {o.x, o.y, o.z}, {pitch[0].mm(), pitch[1].mm(), pitch[2].mm()}};
  const auto known = [&]() -> program::SourceField {
    const std::scoped_lock lock(mutex_);
    const auto found = sources_.find(key);
    return found == sources_.end() ? nullptr : found->second.source.lock();
  };
  if (auto source = known()) return source;
  // The mutex is free here, since solids that have stages themselves call this function again.
  const program::SourceField made = make(stage, place, lattice);
  const std::scoped_lock lock(mutex_);
  Made& entry = sources_[key];
  if (auto others = entry.source.lock()) return others;
  entry = {stage, made};
  if (auto prepared = std::dynamic_pointer_cast<const PreparedSource>(made))
    prepared_.push_back(prepared);
  else
    kept_.push_back(made);
  return made;
}

program::SourceField JobStages::make(const design::StagePtr& stage, const StagePlace& place, const StageLattice& own) {
  LatticeFrame frame;
  frame.stage = stage;
  frame.lattice.origin = own.origin;
  frame.lattice.pitch = own.pitch;
  frame.box = stage->bounds();
  frame.cells = cells_for(*stage, own);
  for (size_t a = 0; a < 3; ++a) frame.lattice.count[a] = ends(frame.box) ? std::max<int64_t>(frame.cells.hi[a], 1) : 1;
  const auto halo = std::dynamic_pointer_cast<const design::HaloStage>(stage);
  if (!halo && !is_sensible_sweep(frame.box, frame.lattice.voxel_mm())) fail(*stage, frame.lattice.voxel_mm());
  StageInput input = make_input_(design_for(place, frame.lattice, not_kept(*this)), stage->reads(), frame.lattice);
  frame.channels = stage->channels(input.channels());
  frame.materials = place.materials;
  if (shared_->memory) frame.made_from = hash_of_values(frame);
  if (halo) {
    const auto reach = halo->reach(frame.lattice.voxel_mm());
    grow(frame, reach);
    const std::scoped_lock lock(mutex_);
    has_halos_ = true;
    halo_bytes_ = std::max(halo_bytes_, bytes_of_halo_block(reach, input.channels().size(), frame.channels.size()));
    return std::make_shared<HaloSource>(std::move(frame), halo, std::move(input), shared_);
  }
  if (auto sweep = std::dynamic_pointer_cast<const design::SweepStage>(stage))
    return std::make_shared<SweepSource>(std::move(frame), std::move(sweep), std::move(input), shared_);
  auto whole = std::dynamic_pointer_cast<const design::WholeStage>(stage);
  ASSERT(whole && "a stage is of one of three kinds");
  return std::make_shared<WholeSource>(std::move(frame), std::move(whole), std::move(input), shared_);
}

void JobStages::lend(const StageLoan& loan) {
  shared_->stop = loan.stop;
  shared_->threads = loan.threads;
  shared_->memory_bytes = loan.memory_bytes;
  if (loan.memory) shared_->memory = loan.memory;
  if (loan.keeps_blocks) shared_->keeps_blocks = true;
  const std::scoped_lock lock(mutex_);
  shared_->blocks.set_limit(static_cast<size_t>(block_bytes(loan)));
}

// Bounds blocks from below so that each thread has a few; with fewer, blocks would be computed many times.
double JobStages::block_bytes(const StageLoan& loan) const {
  constexpr double least_blocks = 4;
  const double threads = loan.threads > 0 ? loan.threads : core_count();
  return std::max(halo_share * static_cast<double>(loan.memory_bytes), least_blocks * threads * halo_bytes_);
}

void JobStages::check_memory(const StageLoan& loan) const {
  for (const auto& source : prepared()) source->check_memory(loan);
}

void JobStages::prepare(const StageLoan& loan) {
  lend(loan);
  double kept = 0;
  for (const auto& source : prepared()) {
    StageLoan rest = loan;
    rest.memory_bytes -= std::min(rest.memory_bytes, static_cast<size_t>(kept));
    source->prepare(rest);
    kept += source->kept_bytes();
    keep(source);
  }
  shared_->is_under_way = true;
}

bool JobStages::is_prepared() const {
  return std::ranges::all_of(prepared(), [](const auto& source) { return source->is_prepared(); });
}

void JobStages::leave_out_unprepared() {
  for (const auto& source : prepared()) source->leave_out();
}

size_t JobStages::memory_bytes(const StageLoan& loan) const {
  const double kept = kept_bytes();
  const std::scoped_lock lock(mutex_);
  if (!has_halos_) return static_cast<size_t>(kept);
  const double threads = loan.threads > 0 ? loan.threads : core_count();
  return static_cast<size_t>(kept + block_bytes(loan) + threads * halo_bytes_);
}

std::vector<std::shared_ptr<const PreparedSource>> JobStages::prepared() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::shared_ptr<const PreparedSource>> found;
  for (const auto& source : prepared_)
    if (auto used = source.lock()) found.push_back(std::move(used));
  return found;
}

void JobStages::keep(const program::SourceField& source) {
  const std::scoped_lock lock(mutex_);
  if (std::ranges::find(kept_, source) == kept_.end()) kept_.push_back(source);
}

double JobStages::kept_bytes() const {
  double bytes = 0;
  for (const auto& source : prepared()) bytes += source->kept_bytes();
  return bytes;
}

}  // namespace ombre::compile
