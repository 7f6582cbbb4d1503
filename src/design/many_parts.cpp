// Lowers the inputs of a node one by one into the rows of a table.
#include "design/many_parts.h"

#include <cmath>
#include <map>

#include "design/lowering.h"
#include "design/registry.h"
#include "program/passes/passes.h"

namespace ombre::design {
namespace {

using program::Builder;
using program::Program;
using program::SlotKind;

// With fewer inputs, writing them out costs less than looking them up.
constexpr size_t least_parts = 32;
// Boxes of a part, and of all parts together.
constexpr size_t most_boxes = 8, most_boxes_together = 2'000'000;

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
    most_boxes_ = std::clamp(most_boxes_together / node.inputs().size(), size_t{1}, most_boxes);
    // Half the distance from part to part, about.
    const Vec3 size = image(program_from_node_, node.bounds(design_space())).size();
    finest_ = 0.5 * std::cbrt(size.x * size.y * size.z / parts);
    for (size_t i = 0; i < node.inputs().size(); ++i)
      if (!add(*node.inputs()[i])) made_.others.push_back(i);
    set_->index.build(entries_);
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
    const Box box = program::grown_for_rounding(image(program_from_node_, bounds));

    Builder builder;
    Lowering lowering(context_, builder);
    lowering.write_bodies_out();
    const Point p = Point::origin_frame(builder).mapped(node_from_program_);
    const Field mark = query_ == PartQuery::interior ? lowering.interior(part, p) : lowering.inside(part, p);
    std::vector<std::pair<std::string, Field>> outputs{{"inside", mark}};
    std::vector<int> slots{0};
    if (query_ != PartQuery::interior) {
      add_composition(lowering, part, mark, p, outputs, slots);
      add_checks(lowering, mark, box, outputs, slots);
    }
    const Program program = builder.finish(outputs);
    if (!program.reads.empty() || program.has_parts()) return false;
    add_to(set_->reference, program, slots, box, program::Precision::reference);
    add_to(set_->batch, fuse(sign_only(program)), slots, box, program::Precision::batch);
    add_boxes(part, builder.finish({outputs[0]}), box);
    return true;
  }

  void add_to(program::PartTable& table, const Program& program, const std::vector<int>& slots, const Box& box,
              program::Precision precision) {
    std::vector<Interval> values;
    evaluate_intervals(program, box, values, nullptr, precision);
    const auto is_everything = [](const Interval& value) { return value.is_everything(); };
    table.add(program, slots, std::any_of(values.begin(), values.end(), is_everything));
    widen_ranges(program, slots, values);
  }

  // What the slots can be where the part is, whoever evaluates it.
  void widen_ranges(const Program& program, const std::vector<int>& slots, const std::vector<Interval>& values) {
    for (size_t slot = 0; slot < slots.size(); ++slot) {
      if (slots[slot] < 0) continue;
      if (reach_.size() <= slot) reach_.resize(slot + 1);
      const Interval value = values[program.outputs[static_cast<size_t>(slots[slot])]];
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

  // Boxes around a part that share no inside. A strut that lies across its box fills little of it.
  void add_boxes(const Node& part, const Program& inside, const Box& whole) {
    std::vector<Box> boxes = slices(part, whole);
    if (volume(boxes) > 0.5 * volume({whole})) boxes = pieces(inside, whole);
    const auto number = static_cast<uint32_t>(part_count_++);
    for (const Box& box : boxes) entries_.push_back({box, number});
  }

  static double volume(const std::vector<Box>& boxes) {
    double sum = 0;
    for (const Box& box : boxes) sum += box.size().x * box.size().y * box.size().z;
    return sum;
  }

  static int longest_axis(const Box& box) {
    const Vec3 size = box.size();
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  // Slices across the longest side, as small as the node knows.
  std::vector<Box> slices(const Node& part, const Box& whole) const {
    const int axis = longest_axis(whole);
    const double length = whole.size()[axis];
    const auto count = std::clamp(std::ceil(length / finest_), 1.0, static_cast<double>(most_boxes_));
    std::vector<Box> boxes;
    for (double n = 0; n < count; ++n) {
      Box slice = whole;
      slice.lo[axis] = whole.lo[axis] + length * n / count;
      slice.hi[axis] = n + 1 < count ? whole.lo[axis] + length * (n + 1) / count : whole.hi[axis];
      const Box wide = program::grown_for_rounding(slice);
      const Box tight = image(program_from_node_, part.bounds(image(node_from_program_, wide)));
      const Box box = intersect(program::grown_for_rounding(tight), slice);
      if (!box.is_empty()) boxes.push_back(box);
    }
    return boxes;
  }

  // Halves, quarters and so on, without those where intervals see nothing of the part.
  std::vector<Box> pieces(const Program& inside, const Box& whole) const {
    std::vector<Box> open{whole}, kept;
    std::vector<Interval> ranges;
    while (!open.empty()) {
      const Box box = open.back();
      open.pop_back();
      evaluate_intervals(inside, program::grown_for_rounding(box), ranges);
      if (ranges[inside.outputs[0]] == Interval(0)) continue;
      const int axis = longest_axis(box);
      if (box.size()[axis] <= finest_ || open.size() + kept.size() + 1 >= most_boxes_) {
        kept.push_back(box);
        continue;
      }
      Box low = box, high = box;
      low.hi[axis] = high.lo[axis] = 0.5 * (box.lo[axis] + box.hi[axis]);
      // The widest box is cut first.
      open.insert(open.begin(), {low, high});
    }
    return kept;
  }

  void set_slot(std::vector<int>& slots, size_t slot, size_t output) {
    if (slots.size() <= slot) slots.resize(slot + 1, -1);
    slots[slot] = static_cast<int>(output);
  }

  void add_composition(Lowering& lowering, const Node& part, Field mark, const Point& p,
                       std::vector<std::pair<std::string, Field>>& outputs, std::vector<int>& slots) {
    composition_ = lowering.composition(part, p, Demand::inside);
    if (query_ == PartQuery::mix) set_slot(slots, made_.count_slot, 0);
    for (const auto& [id, fraction] : composition_.fractions) {
      set_slot(slots, material_slot(id), outputs.size());
      // select, not a product: what a part says of a point outside of it may not be a number.
      const Field term = query_ == PartQuery::mix ? select(mark, fraction, p.constant(0)) : fraction;
      outputs.emplace_back("fraction", term);
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
  void add_checks(Lowering& lowering, Field mark, const Box& box, std::vector<std::pair<std::string, Field>>& outputs,
                  std::vector<int>& slots) {
    if (composition_.checks.empty()) return;
    std::vector<std::pair<std::string, Field>> marks;
    for (const auto& [number, bad] : composition_.checks) marks.emplace_back("check", logical_and(mark, bad));
    const Program program = lowering.builder().finish(marks);
    if (!program.reads.empty()) return;
    std::vector<Interval> ranges;
    evaluate_intervals(program, box, ranges);
    for (size_t n = 0; n < marks.size(); ++n) {
      if (ranges[program.outputs[n]] == Interval(0)) continue;
      is_one_material_ = false;
      const Lowering::LocalCheck& check = lowering.local_checks()[composition_.checks[n].first];
      set_slot(slots, check_slot(check), outputs.size());
      outputs.push_back(marks[n]);
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
  std::vector<program::PartIndex::Entry> entries_;
  std::vector<Interval> reach_;
  size_t part_count_ = 0;
  double finest_ = 0;
  size_t most_boxes_ = most_boxes;
  Composition composition_;
  std::map<MaterialId, size_t> material_slots_;
  std::map<const NodeType*, std::pair<uint32_t, size_t>> checks_;
  bool is_one_material_ = true;
  MaterialId material_ = 0;
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
