#include "program/parts.h"

#include <algorithm>
#include <cmath>

#include "base/system/assert.h"

namespace ombre::program {
namespace {

constexpr size_t most_in_leaf = 8;

// Returns the number of leaves of a tree that halves its entries until a leaf holds few of them.
size_t leaves_of(size_t entries) {
  return entries <= most_in_leaf ? 1 : leaves_of(entries / 2) + leaves_of(entries - entries / 2);
}

// Writes everything of a program except the values of its constants, as a key.
void write_structure(const Program& program, const std::vector<int>& slots, bool may_be_unknown, std::string& key) {
  key.assign(1, may_be_unknown ? '?' : ' ');
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

// In an excerpt, operands below this number are inputs.
constexpr ValueId input_places = 3;

size_t parameters_of(const Program& program, const Instruction& in) {
  if (in.op == Op::affine) return program.maps[in.aux].size();
  return in.op == Op::constant ? 1 : 0;
}

}  // namespace

void PartTable::add(const Program& program, const std::vector<int>& slots, bool may_be_unknown) {
  ASSERT(program.calls.empty() && program.reads.empty());
  const uint32_t body = body_number(program, slots, may_be_unknown);
  row_.clear();
  for (const Instruction& in : program.code) {
    if (in.op == Op::constant) row_.push_back(in.value);
    if (in.op == Op::affine) row_.insert(row_.end(), program.maps[in.aux].begin(), program.maps[in.aux].end());
  }
  add_row(body);
}

void PartTable::add_row(uint32_t body) {
  const uint32_t row = std::visit([&](auto& parameters) { return parameters.add(row_); }, parameters_[body]);
  rows_.push_back({body, row});
}

void PartTable::append(const PartTable& later, const std::vector<size_t>& places) {
  ASSERT(later.precision_ == precision_);
  std::vector<uint32_t> bodies;  // numbers of its bodies in this table
  for (const Body& body : later.bodies_) {
    std::vector<int> slots;
    for (size_t slot = 0; slot < body.slots.size(); ++slot) {
      if (body.slots[slot] < 0) continue;
      if (slots.size() <= places[slot]) slots.resize(places[slot] + 1, -1);
      slots[places[slot]] = body.slots[slot];
    }
    bodies.push_back(body_number(body.code, slots, body.may_be_unknown));
  }
  for (const Row& row : later.rows_) {
    const auto copy = [&](const auto& parameters) {
      row_.clear();
      for (size_t number = 0; number < parameters.per_row(); ++number)
        row_.push_back(parameters.at(row.number, number));
    };
    std::visit(copy, later.parameters_[row.body]);
    add_row(bodies[row.body]);
  }
}

uint32_t PartTable::body_number(const Program& program, const std::vector<int>& slots, bool may_be_unknown) {
  write_structure(program, slots, may_be_unknown, key_);
  const auto [it, is_new] = known_.try_emplace(key_, static_cast<uint32_t>(bodies_.size()));
  if (!is_new) return it->second;
  const auto& code = program.code;
  const auto is_input = [](const Instruction& in) { return in.op == Op::input; };
  const auto inputs = static_cast<size_t>(std::find_if_not(code.begin(), code.end(), is_input) - code.begin());
  ASSERT(std::none_of(code.begin() + static_cast<ptrdiff_t>(inputs), code.end(), is_input));
  bodies_.push_back({program, slots, may_be_unknown, inputs});
  if (precision_ == Precision::batch)
    parameters_.emplace_back(ParametersOfBatch());
  else
    parameters_.emplace_back(ParametersOfReference());
  return it->second;
}

template <class T>
uint32_t PartTable::Parameters<T>::add(const std::vector<double>& row) {
  if (rows_ == 0) {
    for (const double value : row) common_.push_back(static_cast<T>(value));
    places_.assign(row.size(), common);
  }
  for (size_t number = 0; number < row.size(); ++number) {
    const T value = static_cast<T>(row[number]), other = common_[number];
    const bool is_equal = value == other && std::signbit(value) == std::signbit(other);
    if (places_[number] == common && !is_equal) let_vary(number);
  }
  for (const size_t number : varying_) values_.push_back(static_cast<T>(row[number]));
  return rows_++;
}

template <class T>
void PartTable::Parameters<T>::let_vary(size_t number) {
  std::deque<T> wider;
  auto value = values_.begin();
  for (uint32_t row = 0; row < rows_; ++row) {
    for (size_t n = 0; n < varying_.size(); ++n) wider.push_back(*value++);
    wider.push_back(common_[number]);
  }
  values_ = std::move(wider);
  places_[number] = static_cast<uint32_t>(varying_.size());
  varying_.push_back(number);
}

double PartTable::parameter(uint32_t part, size_t number) const {
  const Row& row = rows_[part];
  return std::visit([&](const auto& parameters) { return parameters.at(row.number, number); }, parameters_[row.body]);
}

void PartTable::parameters(std::span<const uint32_t> parts, size_t number, float* row) const {
  const auto fill = [&](const auto& parameters) {
    for (const uint32_t part : parts) *row++ = static_cast<float>(parameters.at(rows_[part].number, number));
  };
  if (!parts.empty()) std::visit(fill, parameters_[rows_[parts.front()].body]);
}

std::optional<double> PartTable::common_parameter(uint32_t body, size_t number) const {
  const auto common = [&](const auto& parameters) -> std::optional<double> {
    if (!parameters.is_common(number)) return std::nullopt;
    return parameters.at(0, number);
  };
  return std::visit(common, parameters_[body]);
}

PartTable::Excerpt PartTable::reach(uint32_t body) const {
  std::vector<bool> only_reached(bodies_[body].slots.size(), false);
  only_reached[0] = true;
  return excerpt(body, only_reached);
}

PartTable::Excerpt PartTable::excerpt(uint32_t number, const std::vector<bool>& wanted) const {
  const Body& body = bodies_[number];
  const std::vector<Instruction>& code = body.code.code;
  const auto output = [&](int slot) { return body.code.outputs[static_cast<size_t>(slot)]; };
  std::vector<bool> needed(code.size(), false);
  for (size_t slot = 0; slot < body.slots.size(); ++slot)
    if (wanted[slot] && body.slots[slot] >= 0) needed[output(body.slots[slot])] = true;
  for (size_t n = code.size(); n-- > body.input_count;)
    if (needed[n]) each_operand(code[n], [&](ValueId id) { needed[id] = true; });

  Excerpt made;
  std::vector<ValueId> place(code.size());  // inputs keep their places before the lines
  size_t parameter = 0;
  for (ValueId n = 0; n < code.size(); ++n) {
    if (n < body.input_count) place[n] = static_cast<ValueId>(code[n].value);
    if (n >= body.input_count && needed[n]) {
      place[n] = static_cast<ValueId>(input_places + made.lines.size());
      Instruction in = code[n];
      each_operand(in, [&](ValueId& id) { id = place[id]; });
      made.lines.push_back({in, parameter});
    }
    parameter += parameters_of(body.code, code[n]);
  }
  for (size_t slot = 0; slot < body.slots.size(); ++slot)
    made.slots.push_back(wanted[slot] && body.slots[slot] >= 0 ? place[output(body.slots[slot])] : none);
  return made;
}

void PartTable::append(uint32_t part, const Excerpt& excerpt, Program& to, const std::array<ValueId, 3>& inputs,
                       std::vector<ValueId>& slots) const {
  const auto first = static_cast<ValueId>(to.code.size());
  const auto renamed = [&](ValueId id) { return id < input_places ? inputs[id] : first + (id - input_places); };
  for (const auto& [line, parameter_number] : excerpt.lines) {
    Instruction in = line;
    each_operand(in, [&](ValueId& id) { id = renamed(id); });
    if (in.op == Op::constant) in.value = parameter(part, parameter_number);
    if (in.op == Op::affine) {
      in.aux = static_cast<uint32_t>(to.maps.size());
      size_t number = parameter_number;
      for (double& value : to.maps.emplace_back()) value = parameter(part, number++);
    }
    to.code.push_back(in);
  }
  slots.clear();
  for (const ValueId slot : excerpt.slots) slots.push_back(slot == none ? none : renamed(slot));
}

Cells Cells::around(const Box& box, const Box& whole) {
  Cells cells;
  for (size_t n = 0; n < 3; ++n) {
    const int axis = static_cast<int>(n);
    const double per_mm = per_axis / (whole.hi[axis] - whole.lo[axis]);
    if (!std::isfinite(per_mm)) continue;
    const auto cell = [](double at) { return static_cast<uint8_t>(std::clamp(at, 0.0, per_axis - 1.0)); };
    cells.first[n] = cell(std::floor((box.lo[axis] - whole.lo[axis]) * per_mm));
    cells.last[n] = cell(std::ceil((box.hi[axis] - whole.lo[axis]) * per_mm) - 1);
  }
  return cells;
}

Box Cells::in(const Box& whole) const {
  Box box = whole;
  for (size_t n = 0; n < 3; ++n) {
    const int axis = static_cast<int>(n);
    const double size = whole.hi[axis] - whole.lo[axis];
    box.lo[axis] = whole.lo[axis] + size * first[n] / per_axis;
    if (last[n] + 1 < per_axis) box.hi[axis] = whole.lo[axis] + size * (last[n] + 1) / per_axis;
  }
  return box;
}

// Rounds to nearest; boxes of parts are grown by more than this rounding (grown_for_rounding).
PartIndex::Bounds::Bounds(const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = static_cast<float>(box.lo[axis]);
    hi[axis] = static_cast<float>(box.hi[axis]);
  }
}

bool PartIndex::Bounds::meets(const Box& box) const {
  for (int axis = 0; axis < 3; ++axis)
    if (static_cast<double>(lo[axis]) > box.hi[axis] || static_cast<double>(hi[axis]) < box.lo[axis]) return false;
  return true;
}

Box PartIndex::rounded(const Box& box) { return Bounds(box).box(); }

void PartIndex::expect(size_t parts, size_t pieces) {
  parts_.reserve(parts);
  piece_begins_.reserve(parts + 1);
  pieces_.reserve(pieces);
}

void PartIndex::add(const Box& box, const std::vector<Cells>& pieces) {
  parts_.push_back({Bounds(box), static_cast<uint32_t>(parts_.size())});
  piece_begins_.push_back(static_cast<uint32_t>(pieces_.size()));
  pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
}

void PartIndex::append(const PartIndex& later) {
  const auto parts = static_cast<uint32_t>(parts_.size()), pieces = static_cast<uint32_t>(pieces_.size());
  for (const Part& part : later.parts_) parts_.push_back({part.bounds, parts + part.number});
  for (const uint32_t begin : later.piece_begins_) piece_begins_.push_back(pieces + begin);
  pieces_.insert(pieces_.end(), later.pieces_.begin(), later.pieces_.end());
}

void PartIndex::build() {
  piece_begins_.push_back(static_cast<uint32_t>(pieces_.size()));
  tree_.clear();
  if (parts_.empty()) return;
  tree_.reserve(2 * leaves_of(parts_.size()) - 1);
  build(0, static_cast<uint32_t>(parts_.size()));
}

// Splits at the median of the boxes' centres along the longest side.
uint32_t PartIndex::build(uint32_t begin, uint32_t end) {
  const auto number = static_cast<uint32_t>(tree_.size());
  Bounds bounds = parts_[begin].bounds;
  for (uint32_t n = begin; n < end; ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = std::min(bounds.lo[axis], parts_[n].bounds.lo[axis]);
      bounds.hi[axis] = std::max(bounds.hi[axis], parts_[n].bounds.hi[axis]);
    }
  }
  tree_.push_back({bounds, begin, end, 0});
  if (end - begin <= most_in_leaf) return number;
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (bounds.hi[axis] - bounds.lo[axis] > bounds.hi[longest] - bounds.lo[longest]) longest = axis;
  const auto middle = [longest](const Part& part) { return part.bounds.lo[longest] + part.bounds.hi[longest]; };
  const uint32_t half = begin + (end - begin) / 2;
  std::nth_element(parts_.begin() + begin, parts_.begin() + half, parts_.begin() + end,
                   [&](const Part& a, const Part& b) {
                     return middle(a) != middle(b) ? middle(a) < middle(b) : a.number < b.number;
                   });
  build(begin, half);
  const uint32_t right = build(half, end);
  tree_[number].right = right;
  return number;
}

double volume(const Box& box) { return box.size().x * box.size().y * box.size().z; }

double PartIndex::filling() const {
  if (tree_.empty()) return 0;
  double pieces = 0;
  for (const Part& part : parts_)
    visit_pieces(part, part.bounds.box(), [&](uint32_t, const Box& piece) {
      pieces += volume(piece);
      return true;
    });
  return pieces / volume(tree_[0].bounds.box());
}

template <class Visit>
void PartIndex::visit(const Box& region, Visit visit) const {
  std::array<uint32_t, 64> open;  // larger than the depth of any tree with 32-bit numbers
  size_t depth = 0;
  if (!tree_.empty()) open[depth++] = 0;
  while (depth > 0) {
    const uint32_t number = open[--depth];
    const TreeNode& branch = tree_[number];
    if (!branch.bounds.meets(region)) continue;
    if (branch.right != 0) {
      open[depth++] = branch.right;
      open[depth++] = number + 1;
      continue;
    }
    for (uint32_t n = branch.begin; n < branch.end; ++n)
      if (parts_[n].bounds.meets(region) && !visit_pieces(parts_[n], region, visit)) return;
  }
}

template <class Visit>
bool PartIndex::visit_pieces(const Part& part, const Box& region, Visit visit) const {
  const Box whole = part.bounds.box();
  for (uint32_t n = piece_begins_[part.number]; n < piece_begins_[part.number + 1]; ++n) {
    const Box piece = pieces_[n].in(whole);
    if (!intersect(piece, region).is_empty() && !visit(part.number, piece)) return false;
  }
  return true;
}

void PartIndex::find(const Box& region, std::vector<uint32_t>& parts) const {
  parts.clear();
  visit(region, [&](uint32_t part, const Box&) {
    if (parts.empty() || parts.back() != part) parts.push_back(part);
    return true;
  });
  std::sort(parts.begin(), parts.end());
}

void PartIndex::find(const Box& region, std::vector<Entry>& entries) const {
  entries.clear();
  visit(region, [&](uint32_t part, const Box& piece) {
    entries.push_back({piece, part});
    return true;
  });
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.part < b.part; });
}

bool PartIndex::find_few(const Box& region, size_t most, std::vector<Entry>& entries) const {
  entries.clear();
  bool are_few = true;
  visit(region, [&](uint32_t part, const Box& piece) {
    are_few = entries.size() < most;
    if (are_few) entries.push_back({piece, part});
    return are_few;
  });
  return are_few;
}

size_t PartIndex::count(const Box& region, size_t most) const {
  size_t count = 0;
  uint32_t last = 0;
  visit(region, [&](uint32_t part, const Box&) {
    // Pieces of a part are consecutive.
    if (count == 0 || part != last) ++count;
    last = part;
    return count < most;
  });
  return count;
}

Box grown_for_rounding(const Box& box) {
  constexpr double share = 0x1p-16;
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) farthest = std::max({farthest, std::abs(box.lo[axis]), std::abs(box.hi[axis])});
  return box.expanded(share * farthest);
}

}  // namespace ombre::program
