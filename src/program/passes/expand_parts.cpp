// Replaces ops of many parts by the code of the parts that reach a region, as far as the program needs them.
#include <map>

#include "program/evaluate.h"
#include "program/parts.h"
#include "program/passes/copy_tables.h"
#include "program/passes/passes.h"

namespace ombre::program {
namespace {

// If the index finds fewer parts than this, they are not filtered.
constexpr size_t worth_asking = 3;

// A filter that evaluates each part over the region with intervals.
class PartByPart : public PartFilter {
 public:
  explicit PartByPart(Precision precision) : precision_(precision) {}

  void keep_reaching(const PartTable& table, const Box& where, std::vector<uint32_t>& parts) override {
    std::map<uint32_t, PartTable::Excerpt> excerpts;  // keyed by body
    std::erase_if(parts, [&](uint32_t part) {
      const auto [it, is_new] = excerpts.try_emplace(table.body_of(part));
      if (is_new) it->second = table.reach(it->first);
      return !may_reach(table, part, it->second, where);
    });
  }

 private:
  bool may_reach(const PartTable& table, uint32_t part, const PartTable::Excerpt& excerpt, const Box& where) {
    if (excerpt.slots[0] == PartTable::none) return true;
    program_.code.clear();
    program_.maps.clear();
    std::array<ValueId, 3> inputs{};
    for (ValueId axis = 0; axis < 3; ++axis) {
      inputs[axis] = axis;
      program_.code.push_back({Op::input, 0, 0, 0, 0, static_cast<double>(axis)});
    }
    table.append(part, excerpt, program_, inputs, slots_);
    evaluate_intervals(program_, where, values_, nullptr, precision_);
    return values_[slots_[0]] != Interval(0);
  }

  Precision precision_;
  Program program_;
  std::vector<ValueId> slots_;
  std::vector<Interval> values_;
};

class Expander {
 public:
  Expander(const Program& program, const std::vector<Interval>& values, Precision precision, PartFilter& filter)
      : from_(program), values_(values), precision_(precision), filter_(filter) {}

  Program run() {
    std::vector<ValueId> renamed;
    renamed.reserve(from_.code.size());
    for (Instruction in : from_.code) {
      if (in.op == Op::parts) {
        renamed.push_back(slot(in, renamed));
        continue;
      }
      each_operand(in, [&](ValueId& id) { id = renamed[id]; });
      copy_tables(from_, to_, in);
      renamed.push_back(push(in));
    }
    for (const ValueId output : from_.outputs) to_.outputs.push_back(renamed[output]);
    to_.output_names = from_.output_names;
    return std::move(to_);
  }

 private:
  // The code of the parts at one place.
  struct Expansion {
    const PartSet* set;
    std::array<ValueId, 3> at;
    std::vector<std::vector<ValueId>> values;         // indexed [part][slot]
    std::vector<ValueId> slots;                       // combined values; PartTable::none until they are needed
    std::map<uint32_t, PartTable::Excerpt> excerpts;  // keyed by body
  };

  ValueId push(const Instruction& in) {
    to_.code.push_back(in);
    return static_cast<ValueId>(to_.code.size() - 1);
  }
  ValueId constant(double value) {
    Instruction in;
    in.value = value;
    return push(in);
  }
  ValueId apply(Op op, ValueId a, ValueId b, ValueId c = 0) {
    Instruction in;
    in.op = op;
    in.a = a;
    in.b = b;
    in.c = c;
    return push(in);
  }

  ValueId slot(const Instruction& in, const std::vector<ValueId>& renamed) {
    Expansion& expansion = expand(in, renamed);
    const auto number = static_cast<size_t>(in.value);
    ValueId& value = expansion.slots[number];
    if (value == PartTable::none) value = combine(expansion, number);
    return value;
  }

  Expansion& expand(const Instruction& in, const std::vector<ValueId>& renamed) {
    const PartSet* set = from_.part_sets[in.aux].get();
    const std::array<ValueId, 3> at{renamed[in.a], renamed[in.b], renamed[in.c]};
    for (Expansion& known : expansions_)
      if (known.set == set && known.at == at) return known;
    Expansion& made = expansions_.emplace_back(Expansion{set, at, {}, {}, {}});
    made.slots.assign(set->slots.size(), PartTable::none);
    find_reaching(*set, in);
    const PartTable& table = set->table(precision_);
    for (const uint32_t part : found_) {
      const uint32_t body = table.body_of(part);
      auto excerpt = made.excerpts.find(body);
      if (excerpt == made.excerpts.end()) {
        excerpt = made.excerpts.emplace(body, table.excerpt(body, wanted(in))).first;
        to_.code.reserve(to_.code.size() + found_.size() * excerpt->second.lines.size());
      }
      table.append(part, excerpt->second, to_, at, made.values.emplace_back());
    }
    return made;
  }

  void find_reaching(const PartSet& set, const Instruction& place) {
    const Interval &x = values_[place.a], &y = values_[place.b], &z = values_[place.c];
    const Box where{{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}};
    set.index.find(where, found_);
    if (found_.size() >= worth_asking) filter_.keep_reaching(set.table(precision_), where, found_);
  }

  // Returns the slots that the program needs at the place of an instruction.
  std::vector<bool> wanted(const Instruction& place) const {
    const PartSet& set = *from_.part_sets[place.aux];
    std::vector<bool> slots(set.slots.size(), false);
    for (const Instruction& in : from_.code) {
      if (in.op != Op::parts || from_.part_sets[in.aux].get() != &set) continue;
      const auto slot = static_cast<size_t>(in.value);
      slots[slot] = true;
      if (set.slots[slot] == SlotKind::first || set.slots[slot] == SlotKind::last) slots[set.held_slot] = true;
    }
    return slots;
  }

  ValueId combine(const Expansion& expansion, size_t number) {
    const SlotKind kind = expansion.set->slots[number];
    const auto at = [&](const std::vector<ValueId>& part) {
      return number < part.size() ? part[number] : PartTable::none;
    };
    ValueId result = PartTable::none;
    const auto take = [&](const std::vector<ValueId>& part) {
      const ValueId value = at(part);
      if (kind == SlotKind::first || kind == SlotKind::last) {
        if (result == PartTable::none) result = constant(0);
        result =
            apply(Op::select, part[expansion.set->held_slot], value == PartTable::none ? constant(0) : value, result);
      } else if (value != PartTable::none) {
        result =
            result == PartTable::none ? value : apply(kind == SlotKind::any ? Op::logical_or : Op::add, result, value);
      }
    };
    if (expansion.set->is_backwards())
      for (size_t n = expansion.values.size(); n-- > 0;) take(expansion.values[n]);
    else
      for (const auto& part : expansion.values) take(part);
    return result == PartTable::none ? constant(0) : result;
  }

  const Program& from_;
  const std::vector<Interval>& values_;
  Precision precision_;
  PartFilter& filter_;
  Program to_;
  std::vector<Expansion> expansions_;
  std::vector<uint32_t> found_;
};

}  // namespace

size_t parts_in_reach(const Program& program, const std::vector<Interval>& values, size_t most) {
  size_t count = 0;
  for (const Instruction& in : program.code) {
    if (in.op != Op::parts) continue;
    const Interval &x = values[in.a], &y = values[in.b], &z = values[in.c];
    const Box where{{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}};
    count = std::max(count, program.part_sets[in.aux]->index.count(where, most));
  }
  return count;
}

Program expand_parts(const Program& program, const std::vector<Interval>& values, Precision precision,
                     PartFilter* filter) {
  PartByPart part_by_part(precision);
  return Expander(program, values, precision, filter ? *filter : part_by_part).run();
}

}  // namespace ombre::program
