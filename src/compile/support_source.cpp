#include "compile/support_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "base/error.h"
#include "base/tasks.h"
#include "base/text.h"
#include "compile/build.h"
#include "compile/sampler.h"
#include "compile/support_columns.h"
#include "voxel/layers.h"

namespace ombre::compile {
namespace {

// Without a job: cells of a two-hundredth of the longest side.
constexpr double cells_of_longest_side = 200;
constexpr int64_t most_along_axis = 1'000'000, most_in_layer = int64_t{1} << 26;
constexpr int64_t slab_layers = 8;
// Angles so close to the limit are at it.
constexpr double angle_slack_deg = 0.01;
constexpr int halvings = 12;            // on the way to a surface between two layers
constexpr double gradient_step = 1e-3;  // of a cell

// Which surfaces over a gap support themselves.
class Overhangs {
 public:
  Overhangs(const design::Design& design, double angle_deg, Vec3 cell)
      : steepest_(std::sin((angle_deg + angle_slack_deg) * std::numbers::pi / 180)),
        cell_(cell),
        step_(gradient_step * std::min({cell.x, cell.y, cell.z})) {
    Diagnostics diagnostics;
    SampleWishes wishes;
    wishes.distance = true;
    sampler_ = Sampler::build(design, wishes, diagnostics);
    if (!sampler_) throw Error("support: " + to_text(diagnostics));
  }

  // True for those of the cells, given by their centres, whose lower face hangs over too far. They are inside, and the
  // next below are not.
  std::vector<bool> find(const std::vector<Vec3>& cells) const {
    const std::vector<Vec3> surface = surface_below(cells);
    std::array<std::vector<double>, 3> gradient;
    for (int axis = 0; axis < 3; ++axis) gradient[static_cast<size_t>(axis)] = slope(surface, axis);
    std::vector<bool> hangs;
    for (size_t n = 0; n < cells.size(); ++n) {
      const Vec3 normal{gradient[0][n], gradient[1][n], gradient[2][n]};
      const double size = length(normal);
      // Where there is no slope, nobody knows.
      hangs.push_back(!(size > 0) || !std::isfinite(size) || -normal.z > steepest_ * size);
    }
    return hangs;
  }

 private:
  std::vector<double> distances(const std::vector<Vec3>& points) const {
    std::vector<double> values(points.size());
    double* const column = values.data();
    sampler_->sample(points, std::span(&column, 1));
    return values;
  }

  std::vector<Vec3> surface_below(const std::vector<Vec3>& cells) const {
    std::vector<Vec3> middle = cells;
    std::vector<double> low(cells.size()), high(cells.size());
    for (size_t n = 0; n < cells.size(); ++n) {
      high[n] = cells[n].z;
      low[n] = cells[n].z - cell_.z;
    }
    for (int round = 0; round < halvings; ++round) {
      for (size_t n = 0; n < cells.size(); ++n) middle[n].z = 0.5 * (low[n] + high[n]);
      const std::vector<double> values = distances(middle);
      for (size_t n = 0; n < cells.size(); ++n) (values[n] <= 0 ? high : low)[n] = middle[n].z;
    }
    for (size_t n = 0; n < cells.size(); ++n) middle[n].z = high[n];
    return middle;
  }

  std::vector<double> slope(std::vector<Vec3> points, int axis) const {
    for (Vec3& p : points) p[axis] += step_;
    std::vector<double> change = distances(points);
    for (Vec3& p : points) p[axis] -= 2 * step_;
    const std::vector<double> before = distances(points);
    for (size_t n = 0; n < change.size(); ++n) change[n] -= before[n];
    return change;
  }

  double steepest_;
  Vec3 cell_;
  double step_;
  std::optional<Sampler> sampler_;
};

// Takes a solid's layers from the top down, and lets columns fall from what hangs over.
class Sweep {
 public:
  Sweep(const voxel::Lattice& lattice, const Overhangs* overhangs)
      : lattice_(lattice),
        overhangs_(overhangs),
        above_(static_cast<size_t>(lattice.count[0] * lattice.count[1]), 0),
        here_(above_.size(), 0),
        top_(above_.size(), none) {}

  void take(const RunLayer& layer, int64_t k) {
    std::swap(above_, here_);
    unpack(layer);
    if (is_empty_ && std::ranges::find(here_, 1) == here_.end()) return;
    is_empty_ = false;
    const std::vector<uint32_t> hanging = overhanging(k);
    // The cells that hang are a column's top: the surface runs somewhere through them.
    for (const uint32_t c : hanging) top_[c] = static_cast<int32_t>(k + 2);
    for (size_t c = 0; c < here_.size(); ++c) {
      if (!here_[c]) continue;
      lowest_ = static_cast<int32_t>(k);
      // So is, in the same way, the cell on which it stands.
      if (top_[c] != none) stacks_.push_back({static_cast<uint32_t>(c), static_cast<int32_t>(k), top_[c]});
      top_[c] = none;
    }
  }

  // With what stands on the build plate.
  std::vector<Stack> finish() {
    for (size_t c = 0; c < top_.size(); ++c)
      if (top_[c] != none && top_[c] > lowest_ + 1) stacks_.push_back({static_cast<uint32_t>(c), lowest_, top_[c]});
    return std::move(stacks_);
  }

 private:
  static constexpr int32_t none = -1;

  void unpack(const RunLayer& layer) {
    for (uint32_t j = 0; j < layer.height(); ++j) layer.row(j).unpack(here_.data() + size_t{j} * layer.width());
    for (uint8_t& cell : here_) cell = cell != 0 ? 1 : 0;
  }

  // Columns in which the part begins above layer k, and does not support itself there.
  std::vector<uint32_t> overhanging(int64_t k) const {
    std::vector<uint32_t> columns;
    for (size_t c = 0; c < here_.size(); ++c)
      if (above_[c] && !here_[c]) columns.push_back(static_cast<uint32_t>(c));
    if (!overhangs_ || columns.empty()) return columns;
    std::vector<Vec3> cells;
    for (const uint32_t c : columns)
      cells.push_back(lattice_.center(c % lattice_.count[0], c / lattice_.count[0], k + 1));
    const std::vector<bool> hangs = overhangs_->find(cells);
    std::vector<uint32_t> kept;
    for (size_t n = 0; n < columns.size(); ++n)
      if (hangs[n]) kept.push_back(columns[n]);
    return kept;
  }

  const voxel::Lattice& lattice_;
  const Overhangs* overhangs_;
  std::vector<uint8_t> above_, here_;  // 1 in the part
  std::vector<int32_t> top_;           // of the open stack in each column
  std::vector<Stack> stacks_;
  int32_t lowest_ = 0;  // layer with a part
  bool is_empty_ = true;
};

// A ratio of a tidy number, which those of dots per inch and of pixels are not.
std::optional<Pitch> pitch_of(double mm) {
  if (const auto exact = Pitch::from_mm(mm)) return exact;
  return Pitch::from_mm(parse_number(format_rounded(mm, 9)).value_or(mm));
}

// From the corner of the box, as most jobs have their voxels. Nothing when there would be too many cells.
std::optional<voxel::Lattice> lattice_of(const Box& box, Vec3 cell) {
  voxel::Lattice lattice;
  lattice.origin = box.lo;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const std::optional<Pitch> pitch = pitch_of(cell[axis]);
    if (!pitch || box.size()[axis] / cell[axis] > static_cast<double>(most_along_axis)) return std::nullopt;
    lattice.pitch[a] = *pitch;
    lattice.count[a] = voxel::voxels_along(box.size()[axis], *pitch);
  }
  if (lattice.count[0] > most_in_layer / lattice.count[1]) return std::nullopt;
  return lattice;
}

std::string too_many(Vec3 cell) {
  return "the part has too many cells of " + format_rounded(cell.x) + " x " + format_rounded(cell.y) + " x " +
         format_rounded(cell.z) + " mm";
}

class SupportSource final : public design::PendingSource {
 public:
  SupportSource(const design::NodePtr& solid, const design::SupportUse& use, const design::MaterialTable& materials,
                const Box& bounds)
      : use_(use), bounds_(bounds) {
    design_.materials = materials;
    design_.parts.push_back({"part", solid});
  }

  Hash content() const override { return design::hash(design_); }
  Box bounds() const override { return bounds_; }

  program::SourceField make(const std::optional<design::JobScale>& scale) const override {
    const std::lock_guard lock(mutex_);
    const Vec3 cell = cell_for(scale);
    program::SourceField& made = made_[{cell.x, cell.y, cell.z}];
    if (made) return made;
    const auto lattice = lattice_of(bounds_, cell);
    if (!lattice) throw Error("support: " + too_many(cell) + "; give support a larger pitch");
    made = sweep(*lattice);
    return made;
  }

 private:
  Vec3 cell_for(const std::optional<design::JobScale>& scale) const {
    if (use_.pitch_mm) return *use_.pitch_mm;
    if (scale) return scale->voxel_mm;
    const Vec3 size = bounds_.size();
    const double side = std::max({size.x, size.y, size.z}) / cells_of_longest_side;
    return {side, side, side};
  }

  program::SourceField sweep(const voxel::Lattice& lattice) const {
    const design::Design design = design::for_job(design_, lattice.voxel_mm());
    Diagnostics diagnostics;
    auto built = build_inside_program(design, diagnostics);
    if (!built) throw Error("support: " + to_text(diagnostics));
    voxel::EvaluatorOptions how;
    how.evaluator = voxel::best_evaluator(lattice);
    const voxel::LayerEvaluator evaluator(*built, lattice, voxel::Dither::threshold, 0, how);
    std::optional<Overhangs> overhangs;
    if (use_.angle_deg > 0) overhangs.emplace(design, use_.angle_deg, lattice.voxel_mm());
    Sweep sweep(lattice, overhangs ? &*overhangs : nullptr);

    using Slab = std::vector<voxel::LayerResult>;
    const int64_t layers = lattice.count[2], slabs = (layers + slab_layers - 1) / slab_layers;
    const auto begin_of = [&](size_t n) { return (slabs - 1 - static_cast<int64_t>(n)) * slab_layers; };
    const auto produce = [&](size_t n) {
      return evaluator.layers(begin_of(n), std::min(begin_of(n) + slab_layers, layers));
    };
    const auto consume = [&](size_t n, Slab& slab) {
      for (size_t l = slab.size(); l-- > 0;) sweep.take(slab[l].runs, begin_of(n) + static_cast<int64_t>(l));
    };
    run_ordered<Slab>(static_cast<size_t>(slabs), 0, 2 * static_cast<size_t>(core_count()), produce, consume);
    return make_columns(lattice, bounds_, sweep.finish(), content());
  }

  design::Design design_;
  design::SupportUse use_;
  Box bounds_;
  mutable std::mutex mutex_;
  mutable std::map<std::array<double, 3>, program::SourceField> made_;
};

}  // namespace

design::PendingSourcePtr make_support_source(const design::NodePtr& solid, const design::SupportUse& use,
                                             const design::Reader& reader) {
  design::Design design;
  design.materials = reader.materials;
  design.parts.push_back({"part", solid});
  const auto box = design_box(design, reader.diagnostics);
  if (!box) return nullptr;
  if (use.pitch_mm && !lattice_of(*box, *use.pitch_mm)) {
    reader.diagnostics.error(reader.where, too_many(*use.pitch_mm), "choose a larger pitch");
    return nullptr;
  }
  return std::make_shared<SupportSource>(solid, use, reader.materials, *box);
}

}  // namespace ombre::compile
