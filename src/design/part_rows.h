// Parts of a node as rows of a table, lowered one by one. Runs of parts are made apart and appended in order.
#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <vector>

#include "design/lowering.h"
#include "design/many_parts.h"
#include "design/registry.h"
#include "program/passes/replay.h"

namespace ombre::design {

struct PartsQuestion {
  LoweringContext& context;
  const Node& node;
  const PartList& list;
  PartQuery query;
  const Falloff* falloff;  // or null
  Affine node_from_program;
  double finest_mm;  // boxes of parts are cut into pieces about so large
};

class PartRows {
 public:
  explicit PartRows(const PartsQuestion& question);
  // All parts of the node will be appended: makes room for them once.
  void expect_all();
  // The next part of the node's; may be called in rows of the same question at once.
  void add(size_t part);
  void append(const PartRows& later);
  // When all are added.
  ManyParts finish() &&;

 private:
  // What a slot is for, where it is not one that every table has.
  struct SlotUse {
    bool is_weighed = false;
    std::optional<MaterialId> material;
    const NodeType* checked = nullptr;  // one check stands for all nodes of the type
    auto operator<=>(const SlotUse&) const = default;
  };
  struct NamedSlot {
    SlotUse use;
    size_t slot;
    Lowering::LocalCheck check{};  // the first one of its type
  };

  bool needs_composition() const;
  Box reach(size_t part, const Box& where) const;
  bool try_add(size_t part);
  void add_to(program::PartTable& table, const program::Program& program, const Box& box, program::Precision precision);
  void widen(size_t slot, const Interval& value);
  void set_ranges();
  void note_materials(const std::optional<MaterialId>& only);

  void add_pieces(size_t part, const Box& whole);
  double volume(const Box& whole) const;
  void find_slices(size_t part, const Box& whole);
  void find_halves(const Box& whole);

  size_t new_slot(program::SlotKind kind);
  NamedSlot& named_slot(const SlotUse& use, program::SlotKind kind);
  void set_slot(size_t slot, size_t output);
  void add_output(size_t slot, const char* name, Field field);
  void add_fractions(Field flag, Field weight, const Point& p);
  void add_checks(Lowering& lowering, bool is_weighed, Field flag, const Box& box);
  program::SlotKind fraction_kind() const;
  ManyParts::CompositionSlots composition_slots(bool is_weighed) const;

  PartsQuestion question_;
  Affine program_from_node_;
  bool is_turned_ = false;  // parts have frames of their own, within one that is turned
  size_t most_pieces_ = 0;

  ManyParts made_;
  std::shared_ptr<program::PartSet> set_ = std::make_shared<program::PartSet>();
  std::vector<NamedSlot> named_;  // in the order of their slots
  std::vector<Interval> reach_;   // by slot
  std::optional<MaterialId> only_;

  // Of the part being added; kept for their memory.
  program::Builder builder_;
  program::Workspace workspace_;
  program::Program program_, signs_, batch_, reached_;  // `reached_` is its first output alone
  program::Outputs outputs_;
  Composition composition_;
  bool has_checks_ = false;
  std::vector<int> slots_;  // outputs by slot, or -1
  std::vector<Interval> values_;
  std::vector<program::Cells> open_, pieces_;
};

}  // namespace ombre::design
