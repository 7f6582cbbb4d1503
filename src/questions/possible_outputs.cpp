#include "questions/possible_outputs.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <utility>

#include "base/system/tasks.h"
#include "program/evaluate.h"
#include "program/passes/narrow.h"
#include "program/passes/prepare.h"

namespace ombre::compile {
namespace {

using program::Precision;

constexpr size_t most_boxes = 1024, most_box_instructions = 1'000'000;  // some 50 ms
constexpr size_t boxes_at_once = 64, boxes_in_task = 8;

enum class Answer : uint8_t { no, yes, undecided };

// Evaluates ever smaller boxes and their middles, several at a time, to find outputs that can be other than 0.
class Search {
 public:
  // With `first_counts`, other outputs are ignored where the first is 0.
  Search(const program::Program& program, bool first_counts, int threads)
      : program_(program),
        batch_(program::prepare(program, program::Purpose::ranges)),
        first_counts_(first_counts),
        threads_(threads) {
    for (size_t n = first_counts ? 1 : 0; n < program.outputs.size(); ++n) open_.push_back(n);
  }

  std::vector<Answer> run(const Box& box) {
    size_t left = std::clamp(most_box_instructions / (program_.code.size() + 1), size_t{1}, most_boxes);
    std::deque<Box> waiting{box};
    while (left > 0 && !waiting.empty() && !open_.empty()) {
      const std::vector<Box> boxes = take(waiting, std::min(left, boxes_at_once));
      left -= boxes.size();
      const std::vector<Found> found = evaluate(boxes);
      for (size_t n = 0; n < boxes.size(); ++n) {
        for (const size_t output : found[n].in_middle) std::erase(open_, output);
        if (!found[n].may_be_elsewhere) continue;
        const auto [low, high] = halves(boxes[n]);
        waiting.push_back(low);
        waiting.push_back(high);
      }
    }
    std::vector<Answer> answers(program_.outputs.size(), Answer::yes);
    for (const size_t n : open_) answers[n] = waiting.empty() ? Answer::no : Answer::undecided;
    return answers;
  }

 private:
  // Result for a box; output numbers are those in open_.
  struct Found {
    std::vector<size_t> in_middle;
    bool may_be_elsewhere = false;  // some open output may be other than 0 elsewhere in the box
  };

  static std::vector<Box> take(std::deque<Box>& waiting, size_t count) {
    const auto end = waiting.begin() + static_cast<ptrdiff_t>(std::min(count, waiting.size()));
    std::vector<Box> boxes(waiting.begin(), end);
    waiting.erase(waiting.begin(), end);
    return boxes;
  }

  std::vector<Found> evaluate(const std::vector<Box>& boxes) const {
    std::vector<Found> found(boxes.size());
    const size_t tasks = (boxes.size() + boxes_in_task - 1) / boxes_in_task;
    const auto visit = [&](size_t task) {
      std::vector<Interval> values;
      const size_t end = std::min(boxes.size(), (task + 1) * boxes_in_task);
      for (size_t n = task * boxes_in_task; n < end; ++n) found[n] = evaluate(boxes[n], values);
    };
    if (tasks == 1)
      visit(0);
    else
      run_parallel(tasks, threads_, visit);
    return found;
  }

  Found evaluate(const Box& box, std::vector<Interval>& values) const {
    Found found;
    if (!may_be_anywhere(box, open_, values)) return found;
    const Vec3 middle = box.center();
    program::evaluate_intervals(program_, {middle, middle}, values);
    const auto is_there = [&](size_t output) { return values[program_.outputs[output]].lo > 0; };
    std::vector<size_t> others = open_;
    if (!first_counts_ || is_there(0)) {
      std::ranges::copy_if(open_, std::back_inserter(found.in_middle), is_there);
      std::erase_if(others, is_there);
    }
    found.may_be_elsewhere = found.in_middle.empty() || may_be_anywhere(box, others, values);
    return found;
  }

  bool may_be_anywhere(const Box& box, const std::vector<size_t>& outputs, std::vector<Interval>& values) const {
    return may_be_anywhere(program_, box, Precision::reference, outputs, values) ||
           may_be_anywhere(batch_, box, Precision::batch, outputs, values);
  }

  bool may_be_anywhere(const program::Program& program, const Box& box, Precision precision,
                       const std::vector<size_t>& outputs, std::vector<Interval>& values) const {
    program::evaluate_intervals(program, box, values, nullptr, precision);
    const auto is_zero = [&](size_t output) { return values[program.outputs[output]] == Interval(0); };
    if (first_counts_ && is_zero(0)) return false;
    return !std::all_of(outputs.begin(), outputs.end(), is_zero);
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
  const int threads_;
  std::vector<size_t> open_;  // outputs for which no point was found
};

// Searches for one output alone. Without the first output, which may take far more code, there is time for smaller
// boxes.
bool is_zero_everywhere(const program::Program& program, size_t output, const Box& box, int threads) {
  program::Program alone = program;
  alone.outputs = {program.outputs[output]};
  alone.output_names = {program.output_names[output]};
  return Search(program::narrow(alone, box).program, false, threads).run(box)[0] == Answer::no;
}

}  // namespace

std::vector<bool> possible_outputs(const program::Program& program, const Box& box, int threads) {
  const std::vector<Answer> answers = Search(program, true, threads).run(box);
  std::vector<bool> possible(answers.size());
  for (size_t n = 0; n < answers.size(); ++n)
    possible[n] =
        answers[n] == Answer::yes || (answers[n] == Answer::undecided && !is_zero_everywhere(program, n, box, threads));
  return possible;
}

}  // namespace ombre::compile
