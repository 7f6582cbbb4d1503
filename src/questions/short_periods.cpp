#include "questions/short_periods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "eval/rows.h"
#include "program/passes/replay.h"
#include "voxel/spread_voxel.h"

namespace ombre::compile {
namespace {

using program::Op;
using program::ValueId;

constexpr uint64_t most_places = 1000;
constexpr size_t places_at_once = 64;
constexpr double full_turn = 2 * std::numbers::pi;

// Something that repeats when `argument` advances by `period`, or by the value of `divisor` if there is one.
struct Repeating {
  size_t argument = 0, divisor = 0;  // outputs; 0: none
  double period = 0;
};

// The outputs are inside, and then those that the others name.
struct RepeatingProgram {
  program::Program program;
  std::vector<Repeating> all;
  bool knows_inside = false;
};

// Returns whether the values depend on files, stages or parts, for each instruction.
std::vector<bool> find_loaded(const program::Program& program) {
  std::vector<bool> loaded(program.code.size());
  for (size_t i = 0; i < loaded.size(); ++i) {
    const program::Instruction& in = program.code[i];
    bool is_loaded = in.op == Op::source || in.op == Op::parts || in.op == Op::call;
    program::each_operand(in, [&](ValueId operand) { is_loaded = is_loaded || loaded[operand]; });
    loaded[i] = is_loaded;
  }
  return loaded;
}

double period_of(Op op) { return op == Op::sin || op == Op::cos ? full_turn : op == Op::tan ? full_turn / 2 : 0; }

RepeatingProgram repeating_program(const program::Program& from) {
  const std::vector<bool> loaded = find_loaded(from);
  RepeatingProgram result;
  program::Program wanted = from;
  result.knows_inside = !loaded[from.outputs.front()];
  wanted.outputs = {result.knows_inside ? from.outputs.front() : ValueId{0}};
  const auto output = [&](ValueId id) {
    wanted.outputs.push_back(id);
    return wanted.outputs.size() - 1;
  };
  for (size_t i = 0; i < from.code.size(); ++i) {
    const program::Instruction& in = from.code[i];
    if (loaded[i]) continue;
    if (const double period = period_of(in.op); period > 0) result.all.push_back({output(in.a), 0, period});
    if (in.op == Op::mod) {
      const size_t argument = output(in.a);
      result.all.push_back({argument, output(in.b), 0});
    }
  }
  wanted.output_names.assign(wanted.outputs.size(), "");
  program::Workspace workspace;
  program::rewrite(wanted, workspace, nullptr, result.program);
  return result;
}

// The values of the outputs at some places, and on the way to the next voxels along the axes.
class PlaceValues {
 public:
  PlaceValues(const RepeatingProgram& repeating, const voxel::Lattice& lattice)
      : repeating_(repeating), lattice_(lattice), evaluator_(places_at_once * points_of_place) {}

  void evaluate(uint64_t begin, uint64_t end) {
    places_.clear();
    for (std::vector<double>& column : columns_) column.clear();
    for (uint64_t n = begin; n < end; ++n) {
      const auto [i, j, k] = voxel::spread_voxel(n, lattice_.count);
      places_.push_back(lattice_.center(i, j, k));
      for (size_t point = 0; point < points_of_place; ++point) {
        Vec3 p = places_.back();
        if (point > 0) {
          const auto step = static_cast<double>((point - 1) % steps + 1) / static_cast<double>(steps);
          const auto along = static_cast<int>((point - 1) / steps);
          p[along] += step * lattice_.voxel_mm()[along];
        }
        for (int axis = 0; axis < 3; ++axis) columns_[static_cast<size_t>(axis)].push_back(p[axis]);
      }
    }
    evaluator_.set_points(columns_[0], columns_[1], columns_[2]);
    evaluator_.run(repeating_.program, 0, repeating_.program.code.size(), nullptr);
  }

  size_t count() const { return places_.size(); }
  Vec3 place(size_t n) const { return places_[n]; }
  bool is_inside(size_t n) const { return !repeating_.knows_inside || value(0, n, 0) != 0; }
  // Returns how many periods pass from the place to the next voxel along the axis, at most. Angles jump by a turn
  // somewhere, and cells by one: the step of the way in which the least passes counts for all of them.
  double periods(size_t n, int axis) const {
    double most = 0;
    for (const Repeating& one : repeating_.all) {
      const double period = one.divisor == 0 ? one.period : std::abs(value(one.divisor, n, 0));
      double before = value(one.argument, n, 0), least = std::numeric_limits<double>::infinity();
      for (size_t step = 0; step < steps; ++step) {
        const double after = value(one.argument, n, 1 + static_cast<size_t>(axis) * steps + step);
        least = std::min(least, std::abs(after - before));
        before = after;
      }
      const double advance = static_cast<double>(steps) * least / period;
      if (std::isfinite(advance)) most = std::max(most, advance);
    }
    return most;
  }

 private:
  // The place itself, and points beside it along each axis, up to the next voxel.
  static constexpr size_t steps = 4, points_of_place = 1 + 3 * steps;

  double value(size_t output, size_t n, size_t point) const {
    return evaluator_.values(repeating_.program.outputs[output])[n * points_of_place + point];
  }

  const RepeatingProgram& repeating_;
  const voxel::Lattice& lattice_;
  eval::RowEvaluator evaluator_;
  std::vector<Vec3> places_;
  std::array<std::vector<double>, 3> columns_;
};

// Notes a place if a period is too short there. A little more than half a period is rounding.
void note(const PlaceValues& values, size_t n, Vec3 voxel_mm, ShortPeriods& found) {
  constexpr double half = 0.5 * (1 + 1e-6);
  int axis = 0;
  std::array<double, 3> periods{};
  for (int a = 0; a < 3; ++a) {
    periods[static_cast<size_t>(a)] = values.periods(n, a);
    if (periods[static_cast<size_t>(a)] > periods[static_cast<size_t>(axis)]) axis = a;
  }
  const double most = periods[static_cast<size_t>(axis)];
  if (most <= half) return;
  if (found.found++ > 0) return;
  found.first_mm = values.place(n), found.axis = axis, found.period_mm = voxel_mm[axis] / most;
}

}  // namespace

ShortPeriods find_short_periods(const program::Program& program, const voxel::Lattice& lattice) {
  ShortPeriods found;
  const RepeatingProgram repeating = repeating_program(program);
  if (repeating.all.empty()) return found;
  const uint64_t places = std::clamp<uint64_t>(lattice.voxels() / 1000, 1, most_places);
  PlaceValues values(repeating, lattice);
  for (uint64_t begin = 0; begin < places; begin += places_at_once) {
    values.evaluate(begin, std::min(places, begin + places_at_once));
    for (size_t n = 0; n < values.count(); ++n) {
      if (!values.is_inside(n)) continue;
      ++found.places;
      note(values, n, lattice.voxel_mm(), found);
    }
  }
  return found;
}

}  // namespace ombre::compile
