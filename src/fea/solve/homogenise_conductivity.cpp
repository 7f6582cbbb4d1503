#include "fea/solve/homogenise_conductivity.h"

#include "base/system/assert.h"
#include "fea/solve/conjugate_gradients.h"

namespace ombre::fea {
namespace {

using BrickValues = std::array<double, 8>;

// Returns values at a brick's nodes that rise by 1 for each mm along an axis, about its middle.
BrickValues rising(size_t axis, Vec3 size_mm) {
  BrickValues values{};
  for (size_t c = 0; c < 8; ++c) values[c] = (brick_corners[c][axis] - 0.5) * size_mm[static_cast<int>(axis)];
  return values;
}

class ConductingCell {
 public:
  ConductingCell(const Model& model, const SolveOptions& options, const StopFlag* stop)
      : model_(model), operator_(operator_of(model, options.threads)), gradients_(operator_, options, nullptr, stop) {
    for (size_t axis = 0; axis < 3; ++axis) rising_[axis] = rising(axis, model.bricks.size_mm);
  }

  // Solves for one gradient, and adds its column.
  void add_column(size_t axis, HomogenisedConductivity& result) {
    Vector x(operator_.size());
    result.iterations += gradients_.run(flows_lacking(axis), x).iterations;
    // Mean fluxes are the work of uniform gradients on the flows.
    for (size_t n = 0; n < model_.bricks.count(); ++n) {
      BrickValues values = rising_[axis];
      for (size_t c = 0; c < 8; ++c) values[c] += x[model_.bricks.nodes[n][c]];
      const BrickValues flows = flows_of(n, values);
      for (size_t row = 0; row < 3; ++row)
        for (size_t c = 0; c < 8; ++c)
          result.conductivity[row][axis] += rising_[row][c] * flows[c] / (cells() * model_.bricks.volume_mm3());
    }
  }

  void add_means(HomogenisedConductivity& result) const {
    double sum = 0, inverses = 0;
    for (size_t n = 0; n < model_.bricks.count(); ++n) {
      sum += operator_.moduli()[n].shear;
      inverses += model_.bricks.share(n) / model_.sections[model_.section_of[n]].conductivity;
    }
    const double count = model_.bricks.filled_count();
    result.solid_share = count / cells();
    result.arithmetic_mean = sum / cells();
    if (count == cells()) result.harmonic_mean = count / inverses;
  }

 private:
  double cells() const {
    const Cell& period = model_.bricks.period;
    return 1.0 * period[0] * period[1] * period[2];
  }

  // One node is held, since a uniform value changes nothing.
  static BrickOperator operator_of(const Model& model, int threads) {
    std::vector<Moduli> conductivities;
    for (size_t n = 0; n < model.bricks.count(); ++n)
      conductivities.push_back({model.bricks.share(n) * model.sections[model.section_of[n]].conductivity, 0});
    std::vector<uint8_t> free(model.bricks.node_count(), 1);
    free[0] = 0;
    return {model.bricks,
            std::move(conductivities),
            std::move(free),
            threads,
            {},
            own_conductance(model.bricks, model.sections, model.section_of, 1)};
  }

  BrickValues flows_of(size_t brick, const BrickValues& values) const {
    BrickValues flows{};
    operator_.brick_forces(brick, values.data(), flows.data());
    return flows;
  }

  // Returns the flows that are missing for balance under a uniform gradient.
  Vector flows_lacking(size_t axis) const {
    Vector lacking(operator_.size());
    for (size_t n = 0; n < model_.bricks.count(); ++n) {
      const BrickValues flows = flows_of(n, rising_[axis]);
      for (size_t c = 0; c < 8; ++c) lacking[model_.bricks.nodes[n][c]] -= flows[c];
    }
    lacking[0] = 0;
    return lacking;
  }

  const Model& model_;
  BrickOperator operator_;
  Gradients gradients_;
  std::array<BrickValues, 3> rising_{};
};

}  // namespace

HomogenisedConductivity homogenise_conductivity(const Model& model, const SolveOptions& options, Progress* progress,
                                                const StopFlag* stop) {
  for (const int32_t along : model.bricks.period) ASSERT(along > 0);
  ConductingCell cell(model, options, stop);
  HomogenisedConductivity result;
  cell.add_means(result);
  for (size_t axis = 0; axis < 3; ++axis) {
    cell.add_column(axis, result);
    if (progress) progress->update({axis + 1, 3});
  }
  // The two halves of the matrix differ by the error that iterations leave, so their mean is taken.
  for (size_t a = 0; a < 3; ++a)
    for (size_t b = 0; b < a; ++b)
      result.conductivity[a][b] = result.conductivity[b][a] =
          0.5 * (result.conductivity[a][b] + result.conductivity[b][a]);
  return result;
}

}  // namespace ombre::fea
