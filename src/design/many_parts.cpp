// Lowers the inputs of a node one by one into the rows of a table.
#include "design/many_parts.h"

#include <cmath>
#include <map>

#include "design/lowering.h"
#include "design/registry.h"
#include "program/passes/passes.h"
#include "program/passes/replay.h"

namespace ombre::design {
namespace {

using program::Builder;
using program::Cells;
using program::Program;
using program::SlotKind;

// With fewer inputs, writing them out costs less than looking them up.
constexpr size_t least_parts = 32;
// Pieces of a part, and of all parts together.
constexpr size_t most_pieces = 8, most_pieces_together = 2'000'000;
// Parts are written out in full, with all that they repeat.
constexpr double most_repetitions = 64;
constexpr int most_visits = 10'000;

// How often the innermost nodes are asked; infinite for parts that are too large to tell.
double repetitions(const Node& node, int& visits) {
  if (++visits > most_visits) return std::numeric_limits<double>::infinity();
  double most = 1;
  for (const NodePtr& input : node.inputs()) most = std::max(most, repetitions(*input, visits));
  return most * node.repetitions();
}

bool repeats_much(const Node& part) {
  int visits = 0;
  return repetitions(part, visits) > most_repetitions;
}

class PartsMaker {
 public:
  PartsMaker(LoweringContext& context, PartQuery query, const Affine& node_from_program)
      : context_(context),
        query_(query),
        node_from_program_(node_from_program),
        program_from_node_(inverse(node_from_program)) {
    set_->slots.push_back(SlotKind::any);
    if (query == PartQuery::mix) {
      made_.count_slot = set_->slots.size();
      set_->slots.push_back(SlotKind::sum);
    }
  }

  ManyParts make(const Node& node) {
    const auto parts = static_cast<double>(node.inputs().size());
    for (program::PartTable* table : {&set_->reference, &set_->batch}) table->expect(node.inputs().size());
    most_pieces_ = std::clamp(most_pieces_together / node.inputs().size(), size_t{1}, most_pieces);
    set_->index.expect(node.inputs().size(), node.inputs().size() * most_pieces_);
    // Half the distance from part to part, about.
    const Vec3 size = image(program_from_node_, node.bounds(design_space())).size();
    finest_ = 0.5 * std::cbrt(size.x * size.y * size.z / parts);
    for (size_t i = 0; i < node.inputs().size(); ++i)
      if (!add(*node.inputs()[i])) made_.others.push_back(i);
    set_->index.build();
    set_ranges(node.inputs().size());
    if (is_one_material_ && part_count_ > 0 && query_ != PartQuery::interior) made_.only = material_;
    made_.material_slots.assign(material_slots_.begin(), material_slots_.end());
    for (const auto& [type, check] : checks_) made_.check_slots.emplace_back(check);
    made_.set = std::move(set_);
    return std::move(made_);
  }

 private:
  // False: the input does not go into a table.
  bool add(const Node& part) {
    const Box bounds = part.bounds(design_space());
    const Vec3 size = bounds.size();
    if (bounds.is_empty() || std::max({size.x, size.y, size.z}) >= design_limit_mm) return false;
    if (repeats_much(part)) return false;
    const Box box = program::grown_for_rounding(image(program_from_node_, bounds));

    builder_.clear();
    Lowering lowering(context_, builder_);
    lowering.write_bodies_out();
    const Point p = Point::origin_frame(builder_).mapped(node_from_program_);
    const Field mark = query_ == PartQuery::interior ? lowering.interior(part, p) : lowering.inside(part, p);
    outputs_.assign(1, {"inside", mark});
    slots_.assign(1, 0);
    if (query_ != PartQuery::interior) {
      add_composition(lowering, part, mark, p);
      add_checks(lowering, mark, box);
    }
    builder_.finish(outputs_, program_);
    if (!program_.reads.empty() || program_.has_parts()) return false;
    add_to(set_->reference, program_, box, program::Precision::reference);
    sign_only(program_, workspace_, signs_);
    fuse(signs_, workspace_, batch_);
    add_to(set_->batch, batch_, box, program::Precision::batch);
    outputs_.resize(1);
    builder_.finish(outputs_, inside_);
    add_pieces(part, program::PartIndex::rounded(box));
    ++part_count_;
    return true;
  }

  void add_to(program::PartTable& table, const Program& program, const Box& box, program::Precision precision) {
    evaluate_intervals(program, box, values_, nullptr, precision);
    const auto is_everything = [](const Interval& value) { return value.is_everything(); };
    table.add(program, slots_, std::any_of(values_.begin(), values_.end(), is_everything));
    widen_ranges(program);
  }

  // What the slots can be where the part is, whoever evaluates it; values_ has what the program's code can be.
  void widen_ranges(const Program& program) {
    for (size_t slot = 0; slot < slots_.size(); ++slot) {
      if (slots_[slot] < 0) continue;
      if (reach_.size() <= slot) reach_.resize(slot + 1);
      const Interval value = values_[program.outputs[static_cast<size_t>(slots_[slot])]];
      reach_[slot] =
          value.is_everything() || reach_[slot].is_everything() ? Interval::everything() : hull(reach_[slot], value);
    }
  }

  // reach_ holds 0, which is what a slot has where no part reaches.
  void set_ranges(size_t parts) {
    reach_.resize(set_->slots.size());
    const auto most = static_cast<double>(parts);
    for (size_t slot = 0; slot < reach_.size(); ++slot) {
      const Interval one = reach_[slot];
      const bool adds = set_->slots[slot] == SlotKind::sum && one.is_bounded();
      set_->ranges.push_back(adds ? Interval(most * one.lo, most * one.hi) : one);
    }
  }

  // Pieces of a part's box that share no inside. A strut that lies across its box fills little of it.
  void add_pieces(const Node& part, const Box& whole) {
    find_slices(part, whole);
    if (volume(whole) > 0.5 * volume_of_box(whole)) find_halves(whole);
    set_->index.add(whole, pieces_);
  }

  static double volume_of_box(const Box& box) { return box.size().x * box.size().y * box.size().z; }

  double volume(const Box& whole) const {
    double sum = 0;
    for (const Cells& piece : pieces_) sum += volume_of_box(piece.in(whole));
    return sum;
  }

  static int longest_axis(const Box& box) {
    const Vec3 size = box.size();
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  // Slices across the longest side, as small as the node knows.
  void find_slices(const Node& part, const Box& whole) {
    pieces_.clear();
    const int axis = longest_axis(whole);
    const double wished = std::ceil(whole.size()[axis] / finest_);
    const int count = static_cast<int>(std::clamp(wished, 1.0, static_cast<double>(most_pieces_)));
    for (int n = 0; n < count; ++n) {
      Cells slice;
      slice.first[static_cast<size_t>(axis)] = static_cast<uint8_t>(Cells::per_axis * n / count);
      slice.last[static_cast<size_t>(axis)] = static_cast<uint8_t>(Cells::per_axis * (n + 1) / count - 1);
      const Box box = slice.in(whole), wide = program::grown_for_rounding(box);
      const Box tight = image(program_from_node_, part.bounds(image(node_from_program_, wide)));
      const Box reached = intersect(program::grown_for_rounding(tight), box);
      if (!reached.is_empty()) pieces_.push_back(common(slice, Cells::around(reached, whole)));
    }
  }

  // They meet.
  static Cells common(Cells a, const Cells& b) {
    for (size_t axis = 0; axis < 3; ++axis) {
      a.first[axis] = std::max(a.first[axis], b.first[axis]);
      a.last[axis] = std::min(a.last[axis], b.last[axis]);
    }
    return a;
  }

  // Halves, quarters and so on, without those where intervals see nothing of the part.
  void find_halves(const Box& whole) {
    pieces_.clear();
    open_.assign(1, Cells{});
    while (!open_.empty()) {
      const Cells cells = open_.back();
      const Box box = cells.in(whole);
      open_.pop_back();
      evaluate_intervals(inside_, program::grown_for_rounding(box), values_);
      if (values_[inside_.outputs[0]] == Interval(0)) continue;
      const int longest = longest_axis(box);
      const auto axis = static_cast<size_t>(longest);
      const bool is_fine = box.size()[longest] <= finest_ || cells.first[axis] == cells.last[axis];
      if (is_fine || open_.size() + pieces_.size() + 1 >= most_pieces_) {
        pieces_.push_back(cells);
        continue;
      }
      Cells low = cells, high = cells;
      low.last[axis] = static_cast<uint8_t>((cells.first[axis] + cells.last[axis]) / 2);
      high.first[axis] = static_cast<uint8_t>(low.last[axis] + 1);
      // The widest box is cut first.
      open_.insert(open_.begin(), {low, high});
    }
  }

  void set_slot(size_t slot, size_t output) {
    if (slots_.size() <= slot) slots_.resize(slot + 1, -1);
    slots_[slot] = static_cast<int>(output);
  }

  void add_composition(Lowering& lowering, const Node& part, Field mark, const Point& p) {
    composition_ = lowering.composition(part, p, Demand::inside);
    if (query_ == PartQuery::mix) set_slot(made_.count_slot, 0);
    for (const auto& [id, fraction] : composition_.fractions) {
      set_slot(material_slot(id), outputs_.size());
      // select, not a product: what a part says of a point outside of it may not be a number.
      const Field term = query_ == PartQuery::mix ? select(mark, fraction, p.constant(0)) : fraction;
      outputs_.emplace_back("fraction", term);
    }
    const bool one = composition_.fractions.size() == 1;
    if (one && part_count_ == 0) material_ = composition_.fractions[0].first;
    is_one_material_ = is_one_material_ && one && composition_.fractions[0].first == material_;
  }

  size_t material_slot(MaterialId id) {
    const auto [it, is_new] = material_slots_.try_emplace(id, set_->slots.size());
    if (is_new)
      set_->slots.push_back(query_ == PartQuery::mix     ? SlotKind::sum
                            : query_ == PartQuery::first ? SlotKind::first
                                                         : SlotKind::last);
    return it->second;
  }

  // Checks that cannot fail where the part is are left out; the others share one for each kind of node.
  void add_checks(Lowering& lowering, Field mark, const Box& box) {
    if (composition_.checks.empty()) return;
    program::Outputs marks;
    for (const auto& [number, bad] : composition_.checks) marks.emplace_back("check", logical_and(mark, bad));
    const Program program = lowering.builder().finish(marks);
    if (!program.reads.empty()) return;
    evaluate_intervals(program, box, values_);
    for (size_t n = 0; n < marks.size(); ++n) {
      if (values_[program.outputs[n]] == Interval(0)) continue;
      is_one_material_ = false;
      const Lowering::LocalCheck& check = lowering.local_checks()[composition_.checks[n].first];
      set_slot(check_slot(check), outputs_.size());
      outputs_.push_back(marks[n]);
    }
  }

  size_t check_slot(const Lowering::LocalCheck& check) {
    const auto known = checks_.find(&check.node->type());
    if (known != checks_.end()) return known->second.second;
    const uint32_t number = context_.register_check(*check.node, check.message);
    set_->slots.push_back(SlotKind::any);
    checks_[&check.node->type()] = {number, set_->slots.size() - 1};
    return set_->slots.size() - 1;
  }

  LoweringContext& context_;
  PartQuery query_;
  Affine node_from_program_, program_from_node_;
  ManyParts made_;
  std::shared_ptr<program::PartSet> set_ = std::make_shared<program::PartSet>();
  std::vector<Interval> reach_;
  size_t part_count_ = 0;
  double finest_ = 0;
  size_t most_pieces_ = most_pieces;
  Composition composition_;
  std::map<MaterialId, size_t> material_slots_;
  std::map<const NodeType*, std::pair<uint32_t, size_t>> checks_;
  bool is_one_material_ = true;
  MaterialId material_ = 0;
  // Of the part being added; kept for their memory.
  Builder builder_;
  program::Workspace workspace_;
  Program program_, signs_, batch_, inside_;  // `inside_` is its first output alone
  program::Outputs outputs_;
  std::vector<int> slots_;  // outputs by slot, or -1
  std::vector<Interval> values_;
  std::vector<Cells> open_, pieces_;
};

}  // namespace

PartFields ManyParts::at(const Point& p) const {
  const auto slot = [&](size_t number) { return p.builder().parts(set, number, p.x, p.y, p.z); };
  PartFields fields;
  fields.inside = slot(0);
  if (count_slot > 0) fields.count = slot(count_slot);
  for (const auto& [id, number] : material_slots) fields.composition.fractions.emplace_back(id, slot(number));
  for (const auto& [check, number] : check_slots) fields.composition.checks.emplace_back(check, slot(number));
  fields.others = others;
  fields.only = only;
  return fields;
}

const ManyParts* LoweringContext::many_parts(const Node& node, PartQuery query, const Affine& node_from_program) {
  if (node.inputs().size() < least_parts) return nullptr;
  const auto& [rows, offset] = node_from_program;
  const PartsKey key{&node,
                     query,
                     {rows[0].x, rows[0].y, rows[0].z, rows[1].x, rows[1].y, rows[1].z,  //
                      rows[2].x, rows[2].y, rows[2].z, offset.x, offset.y, offset.z}};
  const auto [it, is_new] = many_parts_.try_emplace(key);
  if (is_new) it->second = std::make_unique<ManyParts>(PartsMaker(*this, query, node_from_program).make(node));
  return it->second->others.size() + least_parts > node.inputs().size() ? nullptr : it->second.get();
}

}  // namespace ombre::design
