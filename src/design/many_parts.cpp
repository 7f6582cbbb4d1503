// Lowers the parts of a node one by one into the rows of a table.
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

bool repeats_much(std::span<const NodePtr> inputs, size_t part) {
  int visits = 0;
  return part < inputs.size() && repetitions(*inputs[part], visits) > most_repetitions;
}

class PartsMaker {
 public:
  PartsMaker(LoweringContext& context, const Node& node, const PartList& list, PartQuery query,
             const Affine& node_from_program, const Falloff* falloff)
      : context_(context),
        node_(node),
        list_(list),
        query_(query),
        falloff_(falloff),
        node_from_program_(node_from_program),
        program_from_node_(inverse(node_from_program)) {
    new_slot(SlotKind::any);
    if (falloff) set_->held_slot = new_slot(SlotKind::any);
    if (query == PartQuery::mix) made_.count_slot = new_slot(SlotKind::sum);
    if (query == PartQuery::along) made_.along_slot = new_slot(SlotKind::first);
    if (falloff) made_.weight_slot = new_slot(SlotKind::sum);
  }

  ManyParts make() {
    const size_t count = list_.count();
    for (program::PartTable* table : {&set_->reference, &set_->batch}) table->expect(count);
    most_pieces_ = std::clamp(most_pieces_together / count, size_t{1}, most_pieces);
    set_->index.expect(count, count * most_pieces_);
    // Half the distance from part to part, about.
    const Vec3 size = image(program_from_node_, node_.bounds(design_space())).size();
    finest_ = 0.5 * std::cbrt(size.x * size.y * size.z / static_cast<double>(count));
    for (size_t i = 0; i < count; ++i)
      if (!add(i)) made_.others.push_back(i);
    set_->index.build();
    set_ranges(count);
    if (is_one_material_ && part_count_ > 0 && asks_composition()) made_.only = material_;
    held_.finish(made_.held);
    weighed_.finish(made_.weighed);
    made_.set = std::move(set_);
    return std::move(made_);
  }

 private:
  // The slots of a kind of composition while parts are added.
  struct Slots {
    std::map<MaterialId, size_t> materials;
    std::map<const NodeType*, std::pair<uint32_t, size_t>> checks;

    void finish(ManyParts::CompositionSlots& made) const {
      made.materials.assign(materials.begin(), materials.end());
      for (const auto& [type, check] : checks) made.checks.emplace_back(check);
    }
  };

  bool asks_composition() const { return query_ != PartQuery::interior && query_ != PartQuery::along; }
  Box reach(size_t part, const Box& where) const { return list_.reach(part, where, falloff_ ? falloff_->reach_mm : 0); }

  // False: the part does not go into a table.
  bool add(size_t part) {
    if (list_.uses_cell(part)) return false;
    const Box bounds = reach(part, design_space());
    const Vec3 size = bounds.size();
    if (bounds.is_empty() || std::max({size.x, size.y, size.z}) >= design_limit_mm) return false;
    if (repeats_much(node_.inputs(), part)) return false;
    const Box box = program::grown_for_rounding(image(program_from_node_, bounds));

    builder_.clear();
    Lowering lowering(context_, builder_);
    lowering.write_bodies_out();
    const Inputs in(node_, &lowering);
    const Point p = Point::origin_frame(builder_).mapped(node_from_program_);
    const Field mark = query_ == PartQuery::interior ? list_.interior(in, part, p) : list_.inside(in, part, p);
    const Field weight = falloff_ ? falloff_->weight(list_.distance(in, part, p), p) : Field();
    const Field felt = weight ? less(p.constant(0), weight) : mark;
    outputs_.clear();
    slots_.clear();
    add_output(0, "reached", weight ? logical_or(mark, felt) : mark);
    if (weight) add_output(set_->held_slot, "held", mark);
    if (weight) add_output(made_.weight_slot, "weight", weight);
    if (query_ == PartQuery::along) add_output(made_.along_slot, "t", list_.along(in, part, p));
    if (query_ == PartQuery::mix) set_slot(made_.count_slot, weight ? 1 : 0);
    if (asks_composition()) {
      composition_ = list_.composition(in, part, p, weight ? Demand::everywhere : Demand::inside);
      note_material();
      add_fractions(mark, weight, p);
      add_checks(lowering, held_, mark, box);
      if (weight) add_checks(lowering, weighed_, felt, box);
    }
    builder_.finish(outputs_, program_);
    if (!program_.reads.empty() || program_.has_parts()) return false;
    add_to(set_->reference, program_, box, program::Precision::reference);
    sign_only(program_, workspace_, signs_);
    fuse(signs_, workspace_, batch_);
    add_to(set_->batch, batch_, box, program::Precision::batch);
    outputs_.resize(1);
    builder_.finish(outputs_, reached_);
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
  void add_pieces(size_t part, const Box& whole) {
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
  void find_slices(size_t part, const Box& whole) {
    pieces_.clear();
    const int axis = longest_axis(whole);
    const double wished = std::ceil(whole.size()[axis] / finest_);
    const int count = static_cast<int>(std::clamp(wished, 1.0, static_cast<double>(most_pieces_)));
    for (int n = 0; n < count; ++n) {
      Cells slice;
      slice.first[static_cast<size_t>(axis)] = static_cast<uint8_t>(Cells::per_axis * n / count);
      slice.last[static_cast<size_t>(axis)] = static_cast<uint8_t>(Cells::per_axis * (n + 1) / count - 1);
      const Box box = slice.in(whole), wide = program::grown_for_rounding(box);
      const Box tight = image(program_from_node_, reach(part, image(node_from_program_, wide)));
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
      evaluate_intervals(reached_, program::grown_for_rounding(box), values_);
      if (values_[reached_.outputs[0]] == Interval(0)) continue;
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

  size_t new_slot(SlotKind kind) {
    set_->slots.push_back(kind);
    return set_->slots.size() - 1;
  }

  void add_output(size_t slot, const char* name, Field field) {
    set_slot(slot, outputs_.size());
    outputs_.emplace_back(name, field);
  }

  void note_material() {
    const bool one = composition_.fractions.size() == 1;
    if (one && part_count_ == 0) material_ = composition_.fractions[0].first;
    is_one_material_ = is_one_material_ && one && composition_.fractions[0].first == material_;
  }

  void add_fractions(Field mark, Field weight, const Point& p) {
    const SlotKind kind = query_ == PartQuery::mix     ? SlotKind::sum
                          : query_ == PartQuery::first ? SlotKind::first
                                                       : SlotKind::last;
    const Field zero = p.constant(0);
    for (const auto& [id, fraction] : composition_.fractions) {
      // select, not a product: what a part says of a point outside of it may not be a number.
      const Field term = query_ == PartQuery::mix ? select(mark, fraction, zero) : fraction;
      add_output(material_slot(held_, id, kind), "fraction", term);
      if (!weight) continue;
      const Field weighed = select(truth(weight), fraction * weight, zero);
      add_output(material_slot(weighed_, id, SlotKind::sum), "weighed", weighed);
    }
  }

  size_t material_slot(Slots& slots, MaterialId id, SlotKind kind) {
    const auto [it, is_new] = slots.materials.try_emplace(id, 0);
    if (is_new) it->second = new_slot(kind);
    return it->second;
  }

  // Checks that cannot fail where the part is are left out; the others share one for each kind of node.
  void add_checks(Lowering& lowering, Slots& slots, Field mark, const Box& box) {
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
      set_slot(check_slot(slots, check), outputs_.size());
      outputs_.push_back(marks[n]);
    }
  }

  size_t check_slot(Slots& slots, const Lowering::LocalCheck& check) {
    const auto known = slots.checks.find(&check.node->type());
    if (known != slots.checks.end()) return known->second.second;
    const uint32_t number = context_.register_check(*check.node, check.message);
    const size_t slot = new_slot(SlotKind::any);
    slots.checks[&check.node->type()] = {number, slot};
    return slot;
  }

  LoweringContext& context_;
  const Node& node_;
  const PartList& list_;
  PartQuery query_;
  const Falloff* falloff_;
  Affine node_from_program_, program_from_node_;
  ManyParts made_;
  std::shared_ptr<program::PartSet> set_ = std::make_shared<program::PartSet>();
  std::vector<Interval> reach_;
  size_t part_count_ = 0;
  double finest_ = 0;
  size_t most_pieces_ = most_pieces;
  Composition composition_;
  Slots held_, weighed_;
  bool is_one_material_ = true;
  MaterialId material_ = 0;
  // Of the part being added; kept for their memory.
  Builder builder_;
  program::Workspace workspace_;
  Program program_, signs_, batch_, reached_;  // `reached_` is its first output alone
  program::Outputs outputs_;
  std::vector<int> slots_;  // outputs by slot, or -1
  std::vector<Interval> values_;
  std::vector<Cells> open_, pieces_;
};

}  // namespace

PartFields ManyParts::at(const Point& p) const {
  const auto slot = [&](size_t number) { return p.builder().parts(set, number, p.x, p.y, p.z); };
  PartFields fields;
  fields.inside = slot(set->held_slot);
  if (count_slot > 0) fields.count = slot(count_slot);
  if (along_slot > 0) fields.along = slot(along_slot);
  if (weight_slot > 0) fields.weight = slot(weight_slot);
  const auto composition = [&](const CompositionSlots& slots) {
    Composition result;
    for (const auto& [id, number] : slots.materials) result.fractions.emplace_back(id, slot(number));
    for (const auto& [check, number] : slots.checks) result.checks.emplace_back(check, slot(number));
    return result;
  };
  fields.composition = composition(held);
  fields.weighed = composition(weighed);
  fields.others = others;
  fields.only = only;
  return fields;
}

const ManyParts* LoweringContext::many_parts(const Node& node, const PartList& list, PartQuery query,
                                             const Affine& node_from_program, const Falloff* falloff) {
  if (list.count() < least_parts) return nullptr;
  const auto& [rows, offset] = node_from_program;
  const PartsKey key{&node,
                     query,
                     falloff != nullptr,
                     {rows[0].x, rows[0].y, rows[0].z, rows[1].x, rows[1].y, rows[1].z,  //
                      rows[2].x, rows[2].y, rows[2].z, offset.x, offset.y, offset.z}};
  const auto [it, is_new] = many_parts_.try_emplace(key);
  if (is_new)
    it->second = std::make_unique<ManyParts>(PartsMaker(*this, node, list, query, node_from_program, falloff).make());
  return it->second->others.size() + least_parts > list.count() ? nullptr : it->second.get();
}

}  // namespace ombre::design
