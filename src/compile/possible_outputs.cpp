#include "compile/possible_outputs.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "program/passes/passes.h"

namespace ombre::compile {
namespace {

using program::Precision;

constexpr size_t most_boxes = 1024, most_instructions = 1'000'000;  // some 50 ms

class Search {
 public:
  explicit Search(const program::Program& program) : program_(program), batch_(program::fuse(program)) {
    for (size_t n = 1; n < program.outputs.size(); ++n) open_.push_back(n);
  }

  std::vector<bool> run(const Box& box) {
    const size_t boxes = std::clamp(most_instructions / (program_.code.size() + 1), size_t{1}, most_boxes);
    std::deque<Box> waiting{box};
    for (size_t n = 0; n < boxes && !waiting.empty() && !open_.empty(); ++n) {
      const Box part = waiting.front();
      waiting.pop_front();
      if (!may_be_anywhere(part)) continue;
      look_at({part.center(), part.center()});
      if (!may_be_anywhere(part)) continue;
      const auto [low, high] = halves(part);
      waiting.push_back(low);
      waiting.push_back(high);
    }
    std::vector<bool> possible(program_.outputs.size(), true);
    const bool all_seen = waiting.empty();
    for (const size_t n : open_) possible[n] = !all_seen;
    return possible;
  }

 private:
  // Any of the open outputs, whoever evaluates it.
  bool may_be_anywhere(const Box& box) {
    return may_be_anywhere(program_, box, Precision::reference) || may_be_anywhere(batch_, box, Precision::batch);
  }

  bool may_be_anywhere(const program::Program& program, const Box& box, Precision precision) {
    program::evaluate_intervals(program, box, values_, nullptr, precision);
    const auto is_zero = [&](size_t output) { return values_[program.outputs[output]] == Interval(0); };
    return !is_zero(0) && !std::all_of(open_.begin(), open_.end(), is_zero);
  }

  void look_at(const Box& point) {
    program::evaluate_intervals(program_, point, values_);
    const auto is_there = [&](size_t output) { return values_[program_.outputs[output]].lo > 0; };
    if (is_there(0)) std::erase_if(open_, is_there);
  }

  static std::pair<Box, Box> halves(const Box& box) {
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    Box low = box, high = box;
    low.hi[axis] = high.lo[axis] = box.center()[axis];
    return {low, high};
  }

  const program::Program& program_;
  const program::Program batch_;
  std::vector<size_t> open_;  // outputs for which no point was found
  std::vector<Interval> values_;
};

}  // namespace

std::vector<bool> possible_outputs(const program::Program& program, const Box& box) { return Search(program).run(box); }

}  // namespace ombre::compile
