#include "compile/possible_outputs.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "program/passes/passes.h"

namespace ombre::compile {
namespace {

using program::Precision;

constexpr size_t most_boxes = 1024, most_instructions = 1'000'000;  // some 50 ms

enum class Answer : uint8_t { no, yes, undecided };

// Looks at ever smaller boxes, and at their middles.
class Search {
 public:
  // `first_counts`: where the first output is 0 the others do not count.
  Search(const program::Program& program, bool first_counts)
      : program_(program), batch_(program::fuse(program)), first_counts_(first_counts) {
    for (size_t n = first_counts ? 1 : 0; n < program.outputs.size(); ++n) open_.push_back(n);
  }

  std::vector<Answer> run(const Box& box) {
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
    std::vector<Answer> answers(program_.outputs.size(), Answer::yes);
    for (const size_t n : open_) answers[n] = waiting.empty() ? Answer::no : Answer::undecided;
    return answers;
  }

 private:
  // Any of the open outputs, whoever evaluates it.
  bool may_be_anywhere(const Box& box) {
    return may_be_anywhere(program_, box, Precision::reference) || may_be_anywhere(batch_, box, Precision::batch);
  }

  bool may_be_anywhere(const program::Program& program, const Box& box, Precision precision) {
    program::evaluate_intervals(program, box, values_, nullptr, precision);
    const auto is_zero = [&](size_t output) { return values_[program.outputs[output]] == Interval(0); };
    if (first_counts_ && is_zero(0)) return false;
    return !std::all_of(open_.begin(), open_.end(), is_zero);
  }

  void look_at(const Box& point) {
    program::evaluate_intervals(program_, point, values_);
    const auto is_there = [&](size_t output) { return values_[program_.outputs[output]].lo > 0; };
    if (!first_counts_ || is_there(0)) std::erase_if(open_, is_there);
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
  const bool first_counts_;
  std::vector<size_t> open_;  // outputs for which no point was found
  std::vector<Interval> values_;
};

// Without the first output, which may take far more code, there is time for smaller boxes.
bool is_zero_everywhere(const program::Program& program, size_t output, const Box& box) {
  program::Program alone = program;
  alone.outputs = {program.outputs[output]};
  alone.output_names = {program.output_names[output]};
  std::vector<Interval> values;
  program::evaluate_intervals(alone, box, values);
  return Search(program::shorten(alone, values), false).run(box)[0] == Answer::no;
}

}  // namespace

std::vector<bool> possible_outputs(const program::Program& program, const Box& box) {
  const std::vector<Answer> answers = Search(program, true).run(box);
  std::vector<bool> possible(answers.size());
  for (size_t n = 0; n < answers.size(); ++n)
    possible[n] =
        answers[n] == Answer::yes || (answers[n] == Answer::undecided && !is_zero_everywhere(program, n, box));
  return possible;
}

}  // namespace ombre::compile
