#include "load/support_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/text/error.h"
#include "base/text/text.h"
#include "questions/build.h"
#include "questions/design_stages.h"
#include "questions/sampler.h"
#include "stages/job_stages.h"

namespace ombre::compile {
namespace {

// Tolerance in degrees within which an angle counts as the limit.
constexpr double angle_slack_deg = 0.01;
constexpr int halvings = 12;            // steps of the bisection for a surface between two layers
constexpr double gradient_step = 1e-3;  // step of numeric gradients, as a share of a cell

// Decides which surfaces over a gap support themselves.
class Overhangs {
 public:
  Overhangs(const design::Design& design, double angle_deg, Vec3 cell, const design::StageWork& work)
      : work_(work),
        steepest_(std::sin((angle_deg + angle_slack_deg) * std::numbers::pi / 180)),
        cell_(cell),
        step_(gradient_step * std::min({cell.x, cell.y, cell.z})) {
    Diagnostics diagnostics;
    SampleQuery query;
    query.distance = true;
    sampler_ = Sampler::build(design, query, diagnostics);
    if (!sampler_) throw error_of(diagnostics);
  }

  // Returns true for the cells, given by their centres, whose lower face hangs over too far. The cells are inside, and
  // those below them are not.
  std::vector<bool> find(const std::vector<Vec3>& cells) const {
    const std::vector<Vec3> surface = surface_below(cells);
    std::array<std::vector<double>, 3> gradient;
    for (int axis = 0; axis < 3; ++axis) gradient[static_cast<size_t>(axis)] = slope(surface, axis);
    std::vector<bool> hangs;
    for (size_t n = 0; n < cells.size(); ++n) {
      const Vec3 normal{gradient[0][n], gradient[1][n], gradient[2][n]};
      const double size = length(normal);
      // A surface without a slope counts as hanging over.
      hangs.push_back(!(size > 0) || !std::isfinite(size) || -normal.z > steepest_ * size);
    }
    return hangs;
  }

 private:
  std::vector<double> distances(const std::vector<Vec3>& points) const {
    std::vector<double> values(points.size());
    double* const column = values.data();
    sampler_->sample(points, std::span(&column, 1), work_.threads, work_.stop);
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

  design::StageWork work_;
  double steepest_;
  Vec3 cell_;
  double step_;
  std::optional<Sampler> sampler_;
};

// A sweep that takes a solid's layers from the top down, and lets columns fall from overhanging cells.
class SupportSweep final : public design::SweepStage::Sweep {
 public:
  SupportSweep(const voxel::Lattice& lattice, const IndexBox& cells, std::optional<Overhangs> overhangs)
      : lattice_(lattice),
        cells_(cells),
        overhangs_(std::move(overhangs)),
        above_(static_cast<size_t>(cells.size(0) * cells.size(1)), 0),
        here_(above_.size(), 0),
        top_(above_.size(), none) {}

  void take(const design::StageValues& layer, design::ColumnRuns& made) override {
    std::swap(above_, here_);
    std::ranges::transform(layer.channel(0), here_.begin(), [](float inside) { return inside != 0 ? 1 : 0; });
    if (is_empty_ && std::ranges::find(here_, 1) == here_.end()) return;
    is_empty_ = false;
    const int64_t k = layer.box().lo[2];
    // The column begins with the overhanging cell itself, since the surface runs somewhere through it.
    for (const size_t c : overhanging(k)) top_[c] = static_cast<int32_t>(k + 2);
    for (size_t c = 0; c < here_.size(); ++c) {
      if (!here_[c]) continue;
      lowest_ = static_cast<int32_t>(k);
      // The column ends with the cell on which it stands, for the same reason.
      if (top_[c] != none) add(c, static_cast<int32_t>(k), made);
      top_[c] = none;
    }
  }

  // Adds the columns that stand on the build plate.
  void finish(design::ColumnRuns& made) override {
    for (size_t c = 0; c < top_.size(); ++c)
      if (top_[c] != none && top_[c] > lowest_ + 1) add(c, lowest_, made);
  }

 private:
  static constexpr int32_t none = -1;

  int64_t column_i(size_t c) const { return cells_.lo[0] + static_cast<int64_t>(c) % cells_.size(0); }
  int64_t column_j(size_t c) const { return cells_.lo[1] + static_cast<int64_t>(c) / cells_.size(0); }
  void add(size_t c, int32_t bottom, design::ColumnRuns& made) const {
    made.add(0, column_i(c), column_j(c), bottom, top_[c], 1);
  }

  // Returns the columns in which the part begins above layer k, and does not support itself there.
  std::vector<size_t> overhanging(int64_t k) const {
    std::vector<size_t> columns;
    for (size_t c = 0; c < here_.size(); ++c)
      if (above_[c] && !here_[c]) columns.push_back(c);
    if (!overhangs_ || columns.empty()) return columns;
    std::vector<Vec3> centres;
    for (const size_t c : columns) centres.push_back(lattice_.center(column_i(c), column_j(c), k + 1));
    const std::vector<bool> hangs = overhangs_->find(centres);
    std::vector<size_t> kept;
    for (size_t n = 0; n < columns.size(); ++n)
      if (hangs[n]) kept.push_back(columns[n]);
    return kept;
  }

  voxel::Lattice lattice_;
  IndexBox cells_;
  std::optional<Overhangs> overhangs_;
  std::vector<uint8_t> above_, here_;  // 1 where a cell is inside
  std::vector<int32_t> top_;           // top of the open support in each column
  int32_t lowest_ = 0;                 // lowest layer with a cell inside
  bool is_empty_ = true;
};

class SupportStage final : public design::SweepStage {
 public:
  SupportStage(const design::NodePtr& solid, const design::SupportUse& use, const design::MaterialTable& materials,
               const Box& bounds)
      : use_(use), bounds_(bounds) {
    design_.materials = materials;
    design_.parts.push_back({design::nameless_part, solid});
  }

  std::string name() const override { return "supports"; }
  Hash content() const override { return design::hash(design_); }
  Box bounds() const override { return bounds_; }
  design::LatticeChoice lattice() const override { return {use_.pitch_mm, true}; }
  std::vector<design::StageRead> reads() const override {
    design::StageRead shape;
    shape.solid = design_.parts[0].solid;
    shape.inside = true;
    return {shape};
  }
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>&) const override {
    return {{"inside", {}, 0, true, {0, 1}}};
  }

  double bytes_of_column() const override { return 2 * sizeof(uint8_t) + sizeof(int32_t); }

  std::unique_ptr<Sweep> begin(const design::StageLattice& where, const IndexBox& cells,
                               const design::StageWork& work) const override {
    const voxel::Lattice lattice{where.origin, where.pitch, cells.hi};
    std::optional<Overhangs> overhangs;
    const Vec3 cell = lattice.voxel_mm();
    if (use_.angle_deg > 0) overhangs.emplace(design::for_lattice(design_, where), use_.angle_deg, cell, work);
    return std::make_unique<SupportSweep>(lattice, cells, std::move(overhangs));
  }

 private:
  design::Design design_;
  design::SupportUse use_;
  Box bounds_;
};

}  // namespace

design::StagePtr make_support_stage(const design::NodePtr& solid, const design::SupportUse& use,
                                    const design::Reader& reader) {
  design::Design design;
  design.materials = reader.materials;
  design.parts.push_back({design::nameless_part, solid});
  const auto box = design_box(design, reader.diagnostics);
  if (!box) return nullptr;
  if (use.pitch_mm && !is_sensible_sweep(*box, *use.pitch_mm)) {
    reader.diagnostics.error(reader.where, too_many_cells(*use.pitch_mm), "choose a larger pitch");
    return nullptr;
  }
  return std::make_shared<SupportStage>(solid, use, reader.materials, *box);
}

}  // namespace ombre::compile
