#include "program/parts.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"

namespace ombre::program {
namespace {

constexpr size_t most_in_leaf = 4;

// Of a tree that halves until few are left.
size_t leaves_of(size_t entries) {
  return entries <= most_in_leaf ? 1 : leaves_of(entries / 2) + leaves_of(entries - entries / 2);
}

// Everything of a program but the values of its constants.
void write_structure(const Program& program, const std::vector<int>& slots, std::string& key) {
  key.clear();
  const auto append = [&](uint32_t value) { key.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const Instruction& in : program.code) {
    const int arity = info(in.op).arity;
    key.push_back(static_cast<char>(in.op));
    if (in.op == Op::input) append(static_cast<uint32_t>(in.value));
    if (arity > 0) append(in.a);
    if (arity > 1) append(in.b);
    if (arity > 2) append(in.c);
  }
  for (const int slot : slots) append(slot < 0 ? PartTable::none : program.outputs[static_cast<size_t>(slot)]);
}

}  // namespace

void PartTable::add(const Program& program, const std::vector<int>& slots, bool may_be_unknown) {
  ASSERT(program.calls.empty() && program.reads.empty());
  write_structure(program, slots, key_);
  const auto [it, is_new] = known_.try_emplace(key_, static_cast<uint32_t>(bodies_.size()));
  if (is_new) {
    const auto& code = program.code;
    const auto is_input = [](const Instruction& in) { return in.op == Op::input; };
    const auto inputs = static_cast<size_t>(std::find_if_not(code.begin(), code.end(), is_input) - code.begin());
    ASSERT(std::none_of(code.begin() + static_cast<ptrdiff_t>(inputs), code.end(), is_input));
    bodies_.push_back({program, slots, inputs});
  }
  rows_.push_back({it->second, may_be_unknown, parameters_.size()});
  for (const Instruction& in : program.code) {
    if (in.op == Op::constant) parameters_.push_back(in.value);
    if (in.op == Op::affine)
      parameters_.insert(parameters_.end(), program.maps[in.aux].begin(), program.maps[in.aux].end());
  }
  if (rows_.size() > 1) return;
  rows_.reserve(expected_);
  parameters_.reserve(expected_ * parameters_.size());
}

void PartTable::append(uint32_t part, Program& to, const std::array<ValueId, 3>& inputs,
                       std::vector<ValueId>& slots) const {
  const Body& body = bodies_[body_of(part)];
  const double* parameter = parameters(part);
  // A body begins with its inputs; whatever follows keeps its distance from there.
  const size_t input_count = body.input_count;
  const auto shift = static_cast<ValueId>(to.code.size() - input_count);
  const auto renamed = [&](ValueId id) {
    return id < input_count ? inputs[static_cast<size_t>(body.code.code[id].value)] : id + shift;
  };
  for (size_t n = input_count; n < body.code.code.size(); ++n) {
    Instruction in = body.code.code[n];
    const int arity = info(in.op).arity;
    if (arity > 0) in.a = renamed(in.a);
    if (arity > 1) in.b = renamed(in.b);
    if (arity > 2) in.c = renamed(in.c);
    if (in.op == Op::constant) in.value = *parameter++;
    if (in.op == Op::affine) {
      in.aux = static_cast<uint32_t>(to.maps.size());
      to.maps.push_back({parameter[0], parameter[1], parameter[2], parameter[3]});
      parameter += 4;
    }
    to.code.push_back(in);
  }
  slots.clear();
  for (const int slot : body.slots)
    slots.push_back(slot < 0 ? none : renamed(body.code.outputs[static_cast<size_t>(slot)]));
}

bool PartIndex::Bounds::meets(const Box& box) const {
  for (int axis = 0; axis < 3; ++axis)
    if (static_cast<double>(lo[axis]) > box.hi[axis] || static_cast<double>(hi[axis]) < box.lo[axis]) return false;
  return true;
}

void PartIndex::add(const Box& box, uint32_t part) {
  // Rounded to nearest, so that boxes of one part go on sharing their faces.
  RoundedEntry entry{{}, part};
  for (int axis = 0; axis < 3; ++axis) {
    entry.bounds.lo[axis] = static_cast<float>(box.lo[axis]);
    entry.bounds.hi[axis] = static_cast<float>(box.hi[axis]);
  }
  entries_.push_back(entry);
}

void PartIndex::build() {
  knots_.clear();
  if (entries_.empty()) return;
  knots_.reserve(2 * leaves_of(entries_.size()) - 1);
  build(0, static_cast<uint32_t>(entries_.size()));
}

// Halves at the median of the middles along the longest side.
uint32_t PartIndex::build(uint32_t begin, uint32_t end) {
  const auto number = static_cast<uint32_t>(knots_.size());
  Bounds bounds = entries_[begin].bounds;
  for (uint32_t n = begin; n < end; ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = std::min(bounds.lo[axis], entries_[n].bounds.lo[axis]);
      bounds.hi[axis] = std::max(bounds.hi[axis], entries_[n].bounds.hi[axis]);
    }
  }
  knots_.push_back({bounds, begin, end, 0});
  if (end - begin <= most_in_leaf) return number;
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (bounds.hi[axis] - bounds.lo[axis] > bounds.hi[longest] - bounds.lo[longest]) longest = axis;
  const auto middle = [longest](const RoundedEntry& entry) {
    return entry.bounds.lo[longest] + entry.bounds.hi[longest];
  };
  const uint32_t half = begin + (end - begin) / 2;
  std::nth_element(entries_.begin() + begin, entries_.begin() + half, entries_.begin() + end,
                   [&](const RoundedEntry& a, const RoundedEntry& b) {
                     return middle(a) != middle(b) ? middle(a) < middle(b) : a.part < b.part;
                   });
  build(begin, half);
  const uint32_t right = build(half, end);
  knots_[number].right = right;
  return number;
}

template <class Visit>
void PartIndex::visit(const Box& region, Visit visit) const {
  std::array<uint32_t, 64> open;  // deeper than any tree of 32-bit numbers
  size_t depth = 0;
  if (!knots_.empty()) open[depth++] = 0;
  while (depth > 0) {
    const uint32_t number = open[--depth];
    const Knot& knot = knots_[number];
    if (!knot.bounds.meets(region)) continue;
    if (knot.right != 0) {
      open[depth++] = knot.right;
      open[depth++] = number + 1;
      continue;
    }
    for (uint32_t n = knot.begin; n < knot.end; ++n)
      if (entries_[n].bounds.meets(region) && !visit(entries_[n].part, entries_[n].bounds)) return;
  }
}

void PartIndex::find(const Box& region, std::vector<uint32_t>& parts) const {
  parts.clear();
  visit(region, [&](uint32_t part, const Bounds&) {
    parts.push_back(part);
    return true;
  });
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
}

void PartIndex::find(const Box& region, std::vector<Entry>& entries) const {
  entries.clear();
  visit(region, [&](uint32_t part, const Bounds& bounds) {
    entries.push_back({bounds.box(), part});
    return true;
  });
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.part < b.part; });
}

size_t PartIndex::count(const Box& region, size_t most) const {
  std::array<uint32_t, 16> found;
  size_t count = 0;
  visit(region, [&](uint32_t part, const Bounds&) {
    if (std::find(found.begin(), found.begin() + count, part) == found.begin() + count) found[count++] = part;
    return count < most;
  });
  return count;
}

bool PartIndex::reaches(const Box& region) const {
  bool any = false;
  visit(region, [&](uint32_t, const Bounds&) {
    any = true;
    return false;
  });
  return any;
}

Box grown_for_rounding(const Box& box) {
  constexpr double share = 0x1p-16;
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) farthest = std::max({farthest, std::abs(box.lo[axis]), std::abs(box.hi[axis])});
  return box.expanded(share * farthest);
}

}  // namespace ombre::program
