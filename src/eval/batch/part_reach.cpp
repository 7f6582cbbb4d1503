#include "eval/batch/part_reach.h"

#include <algorithm>

namespace ombre::eval {

using program::Instruction;
using program::Op;
using program::PartTable;
using program::Program;
using program::ValueId;

namespace {

constexpr size_t most_lanes = 64;

// Returns the program of slot 0 for any part of a body. Parameters that differ between parts are read as sources, by
// their number.
Program reach_of(const PartTable& table, uint32_t body) {
  const PartTable::Excerpt excerpt = table.reach(body);
  Program made;
  if (excerpt.slots[0] == PartTable::none) return made;
  for (size_t axis = 0; axis < 3; ++axis) {
    Instruction in;
    in.op = Op::input;
    in.value = static_cast<double>(axis);
    made.code.push_back(in);
  }
  for (const auto& [line, parameter] : excerpt.lines) {
    Instruction in = line;
    if (in.op == Op::constant) {
      if (const auto value = table.common_parameter(body, parameter)) {
        in.value = *value;
      } else {
        in.op = Op::source;
        in.aux = static_cast<uint32_t>(made.reads.size());
        made.reads.push_back({nullptr, 0, static_cast<uint32_t>(parameter)});
      }
    }
    made.code.push_back(in);
  }
  made.outputs.push_back(excerpt.slots[0]);
  return made;
}

}  // namespace

const Program& PartReach::question(const PartTable& table, uint32_t body) {
  const auto [it, is_new] = questions_.try_emplace({&table, body});
  if (is_new) it->second = reach_of(table, body);
  return it->second;
}

void PartReach::keep_reaching(const PartTable& table, const Box& where, std::vector<uint32_t>& parts) {
  bodies_.clear();
  for (const uint32_t part : parts) bodies_.push_back(table.body_of(part));
  std::sort(bodies_.begin(), bodies_.end());
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  reaching_.clear();
  for (const uint32_t body : bodies_) {
    together_.clear();
    const auto take = [&] {
      if (!together_.empty()) ask(table, body, program::grown_for_rounding(where));
      together_.clear();
    };
    for (const uint32_t part : parts) {
      if (table.body_of(part) != body) continue;
      together_.push_back(part);
      if (together_.size() == most_lanes) take();
    }
    take();
  }
  std::sort(reaching_.begin(), reaching_.end());
  parts = reaching_;
}

void PartReach::ask(const PartTable& table, uint32_t body, const Box& where) {
  const Program& program = question(table, body);
  if (program.outputs.empty()) {
    reaching_.insert(reaching_.end(), together_.begin(), together_.end());
    return;
  }
  boxes_.assign(together_.size(), where);
  intervals_.evaluate(program, boxes_, [&](const program::Read& read, const BoxIntervals::Place&, IntervalRow to) {
    table.parameters(together_, read.tag, to.lo);
    std::copy_n(to.lo, together_.size(), to.hi);
  });
  for (size_t lane = 0; lane < together_.size(); ++lane)
    if (intervals_.output(0, lane) != Interval(0)) reaching_.push_back(together_[lane]);
}

}  // namespace ombre::eval
