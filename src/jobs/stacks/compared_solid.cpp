#include "jobs/stacks/compared_solid.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text/error.h"
#include "base/text/text.h"
#include "jobs/slice/stored_slices.h"
#include "questions/build.h"
#include "stores/open_store.h"

namespace ombre::compile {
namespace {

constexpr double slack = 1e-6;  // of a voxel

Pitch finer(const Pitch& a, const Pitch& b) { return b.mm() < a.mm() ? b : a; }

// Returns the voxel size that a design or a stack has itself.
std::optional<std::array<Pitch, 3>> own_pitch(const ComparedSource& source) {
  if (source.stack) return source.stack->request().lattice.pitch;
  if (source.design->design.sampling) return source.design->design.sampling->pitch;
  return std::nullopt;
}

std::array<Pitch, 3> common_pitch(const ComparedSource& a, const ComparedSource& b) {
  const bool has_stack = a.stack || b.stack;
  std::array<Pitch, 3> pitch{Pitch{1, 10}, Pitch{1, 10}, Pitch{1, 10}};
  bool is_known = false;
  for (const ComparedSource* source : {&a, &b}) {
    const auto own = has_stack && !source->stack ? std::nullopt : own_pitch(*source);
    if (!own) continue;
    for (size_t axis = 0; axis < 3; ++axis) pitch[axis] = is_known ? finer(pitch[axis], (*own)[axis]) : (*own)[axis];
    is_known = true;
  }
  return pitch;
}

// Returns for each voxel along an axis the voxel of a stack that holds its centre; -1 outside of the stack.
std::vector<int64_t> places(const voxel::Lattice& common, const voxel::Lattice& own, size_t axis) {
  std::vector<int64_t> list;
  for (int64_t n = 0; n < common.count[axis]; ++n) {
    const double voxels = (common.center(axis, n) - own.origin[static_cast<int>(axis)]) / own.pitch[axis].mm();
    const auto place = static_cast<int64_t>(std::floor(voxels + slack));
    list.push_back(place >= 0 && place < own.count[axis] ? place : -1);
  }
  return list;
}

using ChannelsOfLayer = std::function<std::vector<Shown>(int64_t layer)>;

ChannelsOfLayer stack_layers(const std::shared_ptr<const Stack>& stack, const voxel::Lattice& common) {
  const voxel::Lattice& own = stack->request().lattice;
  const auto reader = std::make_shared<const LayerReader>(stack->request());
  return [stack, reader, x = places(common, own, 0), y = places(common, own, 1), z = places(common, own, 2),
          width = own.count[0]](int64_t layer) {
    std::vector<Shown> shown(stack->request().channels.size(), Shown(x.size() * y.size()));
    const int64_t k = z[static_cast<size_t>(layer)];
    if (k < 0) return shown;
    const auto images = read_layer(*stack, *reader, k);
    if (!images)
      throw Error(Code::cannot_read,
                  "layer " + std::to_string(k) + " of " + stack->folder + " cannot be read; ombre verify " +
                      stack->folder + " says why",
                  {{"file", stack->folder}});
    for (size_t n = 0; n < shown.size(); ++n)
      for (size_t j = 0; j < y.size(); ++j)
        for (size_t i = 0; i < x.size(); ++i)
          if (x[i] >= 0 && y[j] >= 0)
            shown[n][j * x.size() + i] = (*images)[n][static_cast<size_t>(y[j] * width + x[i])];
    return shown;
  };
}

std::function<Shown(int64_t)> design_layers(const std::shared_ptr<const DesignVoxels>& design,
                                            const voxel::Lattice& common, voxel::Evaluator evaluator,
                                            const StopFlag* stop) {
  return [design, count = common.count, voxels = design->voxels(evaluator), stop](int64_t layer) {
    const auto made = voxels({{0, 0, layer}, {count[0], count[1], layer + 1}}, stop);
    const RunLayer& runs = made.front().materials();
    Shown shown;
    std::vector<MaterialId> row(runs.width());
    for (uint32_t j = 0; j < runs.height(); ++j) {
      runs.row(j).unpack(row.data());
      shown.insert(shown.end(), row.begin(), row.end());
    }
    return shown;
  };
}

}  // namespace

bool is_stack(const std::string& path) {
  if (stores::is_archive(path)) return true;
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::path(path) / job_file, ignored);
}

ComparedSource compared_stack(const std::string& path) {
  Findings ignored;  // ombre verify tells them
  const auto stack = std::make_shared<const Stack>(open_stack(path, ignored));
  return {path, nullptr, stack, stack->request().lattice.box()};
}

std::optional<ComparedSource> compared_design(const LoadedPtr& loaded, Diagnostics& diagnostics) {
  const auto box = design_box(loaded->design, diagnostics);
  return box ? std::optional(ComparedSource{loaded->path, loaded, nullptr, *box}) : std::nullopt;
}

CommonLattice common_lattice(const ComparedSource& a, const ComparedSource& b,
                             const std::array<std::optional<Pitch>, 3>& pitch) {
  CommonLattice common;
  const Stack* anchor = a.stack ? a.stack.get() : b.stack.get();
  voxel::Lattice& lattice = common.sampling.lattice;
  lattice.pitch = common_pitch(a, b);
  for (size_t axis = 0; axis < 3; ++axis)
    if (pitch[axis]) lattice.pitch[axis] = *pitch[axis];
  std::array<int64_t, 3> before{};
  for (int axis = 0; axis < 3; ++axis) {
    const Pitch size = lattice.pitch[static_cast<size_t>(axis)];
    const double lo = std::min(a.box.lo[axis], b.box.lo[axis]), hi = std::max(a.box.hi[axis], b.box.hi[axis]);
    const double begin = anchor ? anchor->request().lattice.origin[axis] : lo;
    const double voxels = std::max(0.0, std::ceil((begin - lo) / size.mm() - slack));
    before[static_cast<size_t>(axis)] = static_cast<int64_t>(voxels);
    lattice.origin[axis] = begin - size.times(voxels);
    lattice.count[static_cast<size_t>(axis)] = voxel::voxels_along(hi - lattice.origin[axis], size);
  }
  if (!anchor) return common;
  static_cast<SamplingRules&>(common.sampling) = anchor->request();
  common.keeps_draws = before == std::array<int64_t, 3>{} && lattice.pitch == anchor->request().lattice.pitch;
  common.sampling.part = common.keeps_draws ? anchor->request().part : std::nullopt;
  for (size_t axis = 0; axis < 3 && common.sampling.part; ++axis) {
    int64_t& whole = common.sampling.part->count[axis];
    whole = std::max(whole, common.sampling.part->first[axis] + lattice.count[axis]);
  }
  return common;
}

std::optional<ComparedSolid> compared_solid(const ComparedSource& source, const CommonLattice& common,
                                            const CheckWork& work, Diagnostics& diagnostics) {
  const voxel::Lattice& lattice = common.sampling.lattice;
  if (source.stack)
    return ComparedSolid{
        source.stack->request().materials,
        [layers = stack_layers(source.stack, lattice)](int64_t layer) { return std::move(layers(layer).front()); }};
  Sampling sampling = common.sampling;
  const StageLoan loan{work.threads, work.memory_bytes, work.progress, work.stop};
  const auto design = DesignVoxels::make(source.design, sampling, whole_lattice(sampling), loan, diagnostics);
  if (!design) return std::nullopt;
  return ComparedSolid{design->materials(), design_layers(design, lattice, sampling.evaluator, work.stop)};
}

ComparedValues compared_values(const std::shared_ptr<const Stack>& stack, const voxel::Lattice& common) {
  return {stack->request().channels, stack_layers(stack, common)};
}

}  // namespace ombre::compile
