#include "design/part_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/system/assert.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"

namespace ombre::design {

using program::Cells;
using program::Program;
using program::SlotKind;

namespace {

// Greatest number of pieces of one part, and of all parts together.
constexpr size_t most_pieces = 8, most_pieces_together = 2'000'000;
// Limits of a part that goes into a table. Such parts are written out with all their repetitions and contain no tables.
constexpr double most_repetitions = 64;
constexpr size_t most_solids = 256;

// Returns how often the innermost nodes are evaluated, or infinity for parts of too many solids.
double repetitions(const Node& node, size_t& solids) {
  solids += node.traits().instances;
  if (solids > most_solids) return std::numeric_limits<double>::infinity();
  double most = 1;
  for (const NodePtr& input : node.inputs()) most = std::max(most, repetitions(*input, solids));
  return most * node.traits().most_evaluations_of_input;
}

bool repeats_much(std::span<const NodePtr> inputs, size_t part) {
  size_t solids = 0;
  return part < inputs.size() && repetitions(*inputs[part], solids) > most_repetitions;
}

static int longest_axis(const Box& box) {
  const Vec3 size = box.size();
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// Returns the intersection of cells that intersect.
static Cells common(Cells a, const Cells& b) {
  for (size_t axis = 0; axis < 3; ++axis) {
    a.first[axis] = std::max(a.first[axis], b.first[axis]);
    a.last[axis] = std::min(a.last[axis], b.last[axis]);
  }
  return a;
}

}  // namespace

PartRows::PartRows(const PartsQuestion& question)
    : question_(question),
      program_from_node_(inverse(question.node_from_program)),
      is_turned_(mixes_axes(question.node_from_program)) {
  most_pieces_ = std::clamp(most_pieces_together / question.list.count(), size_t{1}, most_pieces);
  new_slot(SlotKind::any);
  if (question.falloff) set_->held_slot = new_slot(SlotKind::any);
  if (question.query == PartQuery::mix) made_.count_slot = new_slot(SlotKind::sum);
  if (question.query == PartQuery::along) made_.along_slot = new_slot(SlotKind::first);
  if (question.falloff) made_.weight_slot = new_slot(SlotKind::sum);
}

void PartRows::expect_all() {
  const size_t count = question_.list.count();
  for (program::PartTable* table : {&set_->reference, &set_->batch}) table->expect(count);
  set_->index.expect(count, count * most_pieces_);
}

void PartRows::add(size_t part) {
  if (!try_add(part)) made_.others.push_back(part);
}

// Returns false if the part cannot be a row of a table.
bool PartRows::try_add(size_t part) {
  const auto& [context, node, list, query, falloff, node_from_program, finest_mm] = question_;
  if (list.uses_cell(part)) return false;
  const Box bounds = reach(part, design_space());
  const Vec3 size = bounds.size();
  if (bounds.is_empty() || std::max({size.x, size.y, size.z}) >= design_limit_mm) return false;
  if (repeats_much(node.inputs(), part)) return false;
  const Box box = program::grown_for_rounding(image(program_from_node_, bounds));

  builder_.clear();
  Lowering lowering(context, builder_);
  lowering.write_bodies_out();
  const Inputs in(node, &lowering);
  const Point p = Point::origin_frame(builder_).mapped(node_from_program);
  const Border border = query == PartQuery::interior ? Border::excluded : Border::included;
  const Field flag = list.membership(in, part, p, border);
  const Field weight = falloff ? falloff->weight(list.distance(in, part, p), p) : Field();
  const Field is_reached = weight ? less(p.constant(0), weight) : flag;
  outputs_.clear();
  slots_.clear();
  has_checks_ = false;
  add_output(0, "reached", weight ? logical_or(flag, is_reached) : flag);
  if (weight) add_output(set_->held_slot, "held", flag);
  if (weight) add_output(made_.weight_slot, "weight", weight);
  if (query == PartQuery::along) add_output(made_.along_slot, "t", list.along(in, part, p));
  if (query == PartQuery::mix) set_slot(made_.count_slot, weight ? 1 : 0);
  if (needs_composition()) {
    composition_ = list.composition(in, part, p, weight ? Demand::everywhere : Demand::inside);
    add_fractions(flag, weight, p);
    add_checks(lowering, false, flag, box);
    if (weight) add_checks(lowering, true, is_reached, box);
  }
  builder_.finish(outputs_, program_);
  if (!program_.reads.empty() || program_.has_parts()) return false;
  const bool is_pure = needs_composition() && composition_.fractions.size() == 1 && !has_checks_;
  note_materials(is_pure ? std::optional(composition_.fractions[0].first) : std::nullopt);
  add_to(set_->reference, program_, box, program::Precision::reference);
  sign_only(program_, workspace_, signs_);
  fuse(signs_, workspace_, batch_);
  if (is_turned_) batch_ = compose_affine(batch_);
  add_to(set_->batch, batch_, box, program::Precision::batch);
  outputs_.resize(1);
  builder_.finish(outputs_, reached_);
  add_pieces(part, program::PartIndex::rounded(box));
  return true;
}

bool PartRows::needs_composition() const {
  return question_.query != PartQuery::interior && question_.query != PartQuery::along;
}

Box PartRows::reach(size_t part, const Box& where) const {
  return question_.list.reach(part, where, question_.falloff ? question_.falloff->reach_mm : 0);
}

// Must be called before the part's row is added.
void PartRows::note_materials(const std::optional<MaterialId>& only) {
  if (set_->reference.size() == 0)
    only_ = only;
  else if (only_ != only)
    only_.reset();
}

void PartRows::add_to(program::PartTable& table, const Program& program, const Box& box, program::Precision precision) {
  evaluate_intervals(program, box, values_, nullptr, precision);
  const auto is_everything = [](const Interval& value) { return value.is_everything(); };
  table.add(program, slots_, std::any_of(values_.begin(), values_.end(), is_everything));
  for (size_t slot = 0; slot < slots_.size(); ++slot)
    if (slots_[slot] >= 0) widen(slot, values_[program.outputs[static_cast<size_t>(slots_[slot])]]);
}

// Extends the range of a slot where parts reach, for every evaluator. Where no part reaches, slots are 0.
void PartRows::widen(size_t slot, const Interval& value) {
  if (reach_.size() <= slot) reach_.resize(slot + 1);
  reach_[slot] =
      value.is_everything() || reach_[slot].is_everything() ? Interval::everything() : hull(reach_[slot], value);
}

void PartRows::set_ranges() {
  reach_.resize(set_->slots.size());
  const auto most = static_cast<double>(question_.list.count());
  for (size_t slot = 0; slot < reach_.size(); ++slot) {
    const Interval one = reach_[slot];
    const bool adds = set_->slots[slot] == SlotKind::sum && one.is_bounded();
    set_->ranges.push_back(adds ? Interval(most * one.lo, most * one.hi) : one);
  }
}

// Adds pieces of a part's box that do not overlap, since for example a diagonal strut fills little of its box.
void PartRows::add_pieces(size_t part, const Box& whole) {
  find_slices(part, whole);
  if (volume(whole) > 0.5 * program::volume(whole)) find_halves(whole);
  set_->index.add(whole, pieces_);
}

double PartRows::volume(const Box& whole) const {
  double sum = 0;
  for (const Cells& piece : pieces_) sum += program::volume(piece.in(whole));
  return sum;
}

// Cuts the box into slices across its longest side, and shrinks each to the bounds that the node knows.
void PartRows::find_slices(size_t part, const Box& whole) {
  pieces_.clear();
  const int axis = longest_axis(whole);
  const double wanted = std::ceil(whole.size()[axis] / question_.finest_mm);
  const int count = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(most_pieces_)));
  for (int n = 0; n < count; ++n) {
    Cells slice;
    slice.first[static_cast<size_t>(axis)] = static_cast<uint8_t>(Cells::per_axis * n / count);
    slice.last[static_cast<size_t>(axis)] = static_cast<uint8_t>(Cells::per_axis * (n + 1) / count - 1);
    const Box box = slice.in(whole), wide = program::grown_for_rounding(box);
    const Box tight = image(program_from_node_, reach(part, image(question_.node_from_program, wide)));
    const Box reached = intersect(program::grown_for_rounding(tight), box);
    if (!reached.is_empty()) pieces_.push_back(common(slice, Cells::around(reached, whole)));
  }
}

// Halves the box repeatedly, and drops the boxes in which intervals show that the part is absent.
void PartRows::find_halves(const Box& whole) {
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
    const bool is_fine = box.size()[longest] <= question_.finest_mm || cells.first[axis] == cells.last[axis];
    if (is_fine || open_.size() + pieces_.size() + 1 >= most_pieces_) {
      pieces_.push_back(cells);
      continue;
    }
    Cells low = cells, high = cells;
    low.last[axis] = static_cast<uint8_t>((cells.first[axis] + cells.last[axis]) / 2);
    high.first[axis] = static_cast<uint8_t>(low.last[axis] + 1);
    // The oldest, and therefore largest, box is cut next.
    open_.insert(open_.begin(), {low, high});
  }
}

void PartRows::set_slot(size_t slot, size_t output) {
  if (slots_.size() <= slot) slots_.resize(slot + 1, -1);
  slots_[slot] = static_cast<int>(output);
}

size_t PartRows::new_slot(SlotKind kind) {
  set_->slots.push_back(kind);
  return set_->slots.size() - 1;
}

void PartRows::add_output(size_t slot, const char* name, Field field) {
  set_slot(slot, outputs_.size());
  outputs_.emplace_back(name, field);
}

PartRows::NamedSlot& PartRows::named_slot(const SlotUse& use, SlotKind kind) {
  const auto known = std::ranges::find(named_, use, &NamedSlot::use);
  if (known != named_.end()) return *known;
  return named_.emplace_back(NamedSlot{use, new_slot(kind)});
}

SlotKind PartRows::fraction_kind() const {
  if (question_.query == PartQuery::mix) return SlotKind::sum;
  return question_.query == PartQuery::first ? SlotKind::first : SlotKind::last;
}

void PartRows::add_fractions(Field flag, Field weight, const Point& p) {
  const Field zero = p.constant(0);
  for (const auto& [id, fraction] : composition_.fractions) {
    // Uses select instead of a product, since values of a part outside it may be NaN.
    const Field term = question_.query == PartQuery::mix ? select(flag, fraction, zero) : fraction;
    add_output(named_slot({false, id}, fraction_kind()).slot, "fraction", term);
    if (!weight) continue;
    const Field weighed = select(truth(weight), fraction * weight, zero);
    add_output(named_slot({true, id}, SlotKind::sum).slot, "weighed", weighed);
  }
}

// Drops checks that cannot fail within the part. The others are merged for each type of node.
void PartRows::add_checks(Lowering& lowering, bool is_weighed, Field flag, const Box& box) {
  if (composition_.checks.empty()) return;
  program::Outputs flags;
  for (const auto& [number, bad] : composition_.checks) flags.emplace_back("check", logical_and(flag, bad));
  const Program program = lowering.builder().finish(flags);
  if (!program.reads.empty()) return;
  evaluate_intervals(program, box, values_);
  for (size_t n = 0; n < flags.size(); ++n) {
    if (values_[program.outputs[n]] == Interval(0)) continue;
    has_checks_ = true;
    const Lowering::LocalCheck& check = lowering.local_checks()[composition_.checks[n].first];
    NamedSlot& named = named_slot({is_weighed, std::nullopt, &check.node->type()}, SlotKind::any);
    if (!named.check.node) named.check = check;
    set_slot(named.slot, outputs_.size());
    outputs_.push_back(flags[n]);
  }
}

void PartRows::append(const PartRows& later) {
  std::vector<size_t> places(later.set_->slots.size());  // numbers of its slots in this object
  std::iota(places.begin(), places.end(), size_t{0});
  for (const NamedSlot& theirs : later.named_) {
    NamedSlot& named = named_slot(theirs.use, later.set_->slots[theirs.slot]);
    if (!named.check.node) named.check = theirs.check;
    places[theirs.slot] = named.slot;
  }
  for (size_t slot = 0; slot < later.reach_.size(); ++slot) widen(places[slot], later.reach_[slot]);
  if (later.set_->reference.size() > 0) note_materials(later.only_);
  set_->reference.append(later.set_->reference, places);
  set_->batch.append(later.set_->batch, places);
  set_->index.append(later.set_->index);
  made_.others.insert(made_.others.end(), later.made_.others.begin(), later.made_.others.end());
}

ManyParts PartRows::finish() && {
  set_->index.build();
  set_ranges();
  if (set_->reference.size() > 0) made_.only = only_;
  made_.held = composition_slots(false);
  made_.weighed = composition_slots(true);
  made_.set = std::move(set_);
  return std::move(made_);
}

ManyParts::CompositionSlots PartRows::composition_slots(bool is_weighed) const {
  ManyParts::CompositionSlots made;
  for (const NamedSlot& named : named_) {
    if (named.use.is_weighed != is_weighed) continue;
    if (named.use.material) made.materials.emplace_back(*named.use.material, named.slot);
    if (const auto& [node, message] = named.check; node)
      made.checks.emplace_back(question_.context.register_check(*node, message), named.slot);
  }
  std::ranges::sort(made.materials);
  return made;
}

}  // namespace ombre::design
