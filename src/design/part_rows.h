// Lowers parts of a node into rows of a table. Ranges of parts are lowered in parallel and appended in order.
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
  const Falloff* falloff;  // may be null
  Affine node_from_program;
  double finest_mm;  // approximate size of the pieces into which boxes of parts are cut
};

class PartRows {
 public:
  explicit PartRows(const PartsQuestion& question);
  // Reserves memory for all parts of the node.
  void expect_all();
  // Adds a part of the node. Different PartRows of the same question may be used in parallel.
  void add(size_t part);
  void append(const PartRows& later);
  // Returns the table after all parts are added.
  ManyParts finish() &&;

 private:
  // Identifies the use of a slot, except for those that every table has.
  struct SlotUse {
    bool is_weighed = false;
    std::optional<MaterialId> material;
    const NodeType* checked = nullptr;  // one check stands for all nodes of this type
    auto operator<=>(const SlotUse&) const = default;
  };
  struct NamedSlot {
    SlotUse use;
    size_t slot;
    Lowering::LocalCheck check{};  // the first check of this type
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
  bool is_turned_ = false;  // parts have frames of their own within a rotated frame
  size_t most_pieces_ = 0;

  ManyParts made_;
  std::shared_ptr<program::PartSet> set_ = std::make_shared<program::PartSet>();
  std::vector<NamedSlot> named_;  // in the order of their slots
  std::vector<Interval> reach_;   // indexed by slot
  std::optional<MaterialId> only_;

  // Data of the part that is being added. The memory is reused.
  program::Builder builder_;
  program::Workspace workspace_;
  program::Program program_, signs_, batch_, reached_;  // `reached_` has only the first output
  program::Outputs outputs_;
  Composition composition_;
  bool has_checks_ = false;
  std::vector<int> slots_;  // output number of each slot, or -1
  std::vector<Interval> values_;
  std::vector<program::Cells> open_, pieces_;
};

}  // namespace ombre::design
