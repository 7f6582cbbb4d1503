#include "questions/nearby_values.h"

#include <cmath>

#include "surface/cells/shortened.h"

namespace ombre::compile {
namespace {

constexpr size_t short_enough = 60;  // programs this short are not shortened: that would take as long as running them
constexpr size_t most_operations = 4'000'000;  // limit for the programs of all cells together; some 130 MB

}  // namespace

PointValues::PointValues(program::Program program, const Box& space, double cell_mm)
    : programs_(std::move(program), space), cell_mm_(cell_mm) {}

double PointValues::at(Vec3 p) {
  const program::Program& program = around(p);
  rows_.set_points({&p.x, 1}, {&p.y, 1}, {&p.z, 1});
  rows_.run(program, 0, program.code.size(), nullptr);
  return rows_.values(program.outputs[0])[0];
}

const program::Program& PointValues::around(Vec3 p) {
  const program::Program& whole = programs_.whole();
  if (!whole.has_parts() && whole.code.size() <= short_enough) return whole;
  std::array<int64_t, 3> place{};
  for (size_t axis = 0; axis < 3; ++axis)
    place[axis] = static_cast<int64_t>(std::floor(p[static_cast<int>(axis)] / cell_mm_));
  if (const auto known = cells_.find(place); known != cells_.end()) return known->second;
  if (operations_ > most_operations) {
    cells_.clear();
    operations_ = 0;
  }
  Vec3 low;
  for (int axis = 0; axis < 3; ++axis) low[axis] = static_cast<double>(place[static_cast<size_t>(axis)]) * cell_mm_;
  // The box is a little larger than the cell, since rounding may put a point of the cell just beside it.
  const Box box = Box{low, low + Vec3{cell_mm_, cell_mm_, cell_mm_}}.expanded(1e-6 * cell_mm_);
  program::Program local = surface::shortened_for(programs_.around(box), box);
  operations_ += local.code.size();
  return cells_.emplace(place, std::move(local)).first->second;
}

}  // namespace ombre::compile
