// Work at scattered points, cut into parts of space where less of a program matters.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/math/box.h"
#include "base/math/vec.h"
#include "base/system/progress.h"
#include "program/program.h"

namespace ombre::surface {

// A program that holds at least in a box.
using ProgramAround = std::function<const program::Program&(const Box&)>;

// The program as it is around these points; their numbers.
using PointWork = std::function<void(const program::Program& program, std::span<const uint32_t> numbers)>;

// Does the work for all points, each once, in parallel; the program may be queried as far as the margin from them.
// Throws Cancelled.
void work_at(const ProgramAround& program, const std::vector<Vec3>& points, double margin_mm, int threads,
             const StopFlag* stop, const PointWork& work);

}  // namespace ombre::surface
