// A program with its intervals over some tiles, and the program shortened for one or several of them.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "eval/batch/part_reach.h"
#include "program/passes/passes.h"
#include "render/ray_tiles.h"

namespace ombre::render {

struct QueriedTiles {
  explicit QueriedTiles(const RaySteps& steps) : intervals(steps) {}

  // Evaluates the intervals of `program`, which must outlive this, over tiles in fine steps.
  void ask(const program::Program& program, std::vector<TileBox> fine, const voxel::StripSources& sources) {
    intervals.evaluate(program, std::move(fine), sources);
    shortener.begin(program);
  }
  // Shortens the program to what one of the tiles needs, or several of them.
  template <class Tiles>
  void shorten(const Tiles& tiles) {
    intervals.values(tiles, values);
    shortener.shorten(values, left, kept);
  }
  // Unrolls the parts of the shortened program. Its intervals are unknown afterwards, until it is evaluated again.
  void write_out_parts() {
    const bool are_turned = has_turned_parts();
    left = program::expand_parts(left, kept, program::Precision::batch, &reach);
    if (are_turned) left = program::compose_affine(left);
    kept.assign(left.code.size(), Interval::everything());
  }
  // Returns true if some parts are not evaluated at the inputs themselves. The affine maps of the others are already
  // composed.
  bool has_turned_parts() const {
    return std::ranges::any_of(left.code, [&](const program::Instruction& in) {
      return in.op == program::Op::parts && left.code[in.a].op != program::Op::input;
    });
  }

  TileIntervals intervals;
  eval::PartReach reach{eval::kernel_sets().front()};
  program::Shortener shortener;
  std::vector<Interval> values, kept;
  program::Program left;
};

}  // namespace ombre::render
