// Work at scattered points, divided into parts of space for which the program can be shortened.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/math/box.h"
#include "base/math/vec.h"
#include "base/system/progress.h"
#include "program/program.h"

namespace ombre::surface {

// Returns a program that is valid at least in the box.
using ProgramAround = std::function<const program::Program&(const Box&)>;

// Handles the points with the given numbers; `program` is valid around them.
using PointWork = std::function<void(const program::Program& program, std::span<const uint32_t> numbers)>;

// Calls `work` in parallel so that each point is handled once. Programs are valid up to the margin around the points.
// Throws Cancelled.
void work_at(const ProgramAround& program, const std::vector<Vec3>& points, double margin_mm, int threads,
             const StopFlag* stop, const PointWork& work);

}  // namespace ombre::surface
