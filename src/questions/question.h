// Asks a design for fields and makes programs of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "design/design.h"
#include "design/lowering.h"
#include "program/program.h"
#include "stages/job_stages.h"

namespace ombre::compile {

// Makes the design's point from the inputs of a program.
using Frame = std::function<program::Point(program::Builder& builder)>;

struct QuestionOptions {
  int threads = 1;                  // for tables of many parts; 0: all cores
  bool parts = false;               // set if part() will be called
  design::NodePtr shape = nullptr;  // the part of the design that inside() and distance() are about; null: all of it
  Frame frame = program::Point::origin_frame;
  // Memory for tables of many parts, which may then differ in rounding. Null: none are kept.
  design::SubDesignMemory* memory = nullptr;
};

// Gives a design's values at a point as fields, and makes programs of what a job computes from them. Every program of a
// design is made by a question; one question may make several.
class Question {
 public:
  // `design` must outlive the question.
  explicit Question(const design::Design& design, const QuestionOptions& options = {});

  const design::Design& design() const { return design_; }
  // All parts as one solid, whose overlaps are mixed as in a union.
  const design::NodePtr& solid() const { return solid_; }
  program::Builder& builder() { return builder_; }
  const program::Point& point() const { return point_; }

  program::Field inside() { return lowering_.inside(*shape_, point_); }      // truth value
  program::Field distance() { return lowering_.distance(*shape_, point_); }  // mm, negative inside
  // The composition, like attributes, has a meaning inside only.
  design::Composition composition() { return lowering_.composition(*solid_, point_, design::Demand::inside); }
  // 1 inside the part with this number, else 0.
  program::Field part(size_t number) { return lowering_.inside(*design_.parts[number].solid, point_); }
  // Returns the number of that name, which may be one number of an attribute ("fibre.x"). Returns nothing, and adds a
  // diagnostic, if no node of the design declares it.
  std::optional<program::Field> attribute(std::string_view name, Diagnostics& diagnostics);
  // Returns the fraction of the material of that name, as dithering takes it, or else the attribute of that name.
  // Returns nothing, and adds a diagnostic, if the design has neither.
  std::optional<program::Field> value(const std::string& name, Diagnostics& diagnostics);
  const std::vector<design::AttributeDeclaration>& attributes() const { return context_.attributes(); }
  // Returns null if no node declares the attribute.
  const design::AttributeDeclaration* declaration(std::string_view name) const { return lowering_.declaration(name); }
  // The stages of the design's job, or stages of this question alone.
  const JobStagesPtr& stages() const { return stages_; }
  // Returns the check with this number of a composition.
  const design::Check& check(uint32_t number) const { return context_.checks()[number]; }

  // Makes the program; no question may follow. Nodes that are used more than once remain calls of bodies.
  program::Program program_with_calls(const program::Outputs& outputs);
  // Makes the program without calls; remarks of nodes become diagnostics. Returns nothing, and adds a diagnostic, if it
  // would not fit into memory.
  std::optional<program::Program> program(const program::Outputs& outputs, Diagnostics& diagnostics);

 private:
  const design::Design& design_;
  design::NodePtr solid_, shape_;
  JobStagesPtr stages_;  // must live as long as sources are made
  design::LoweringContext context_;
  program::Builder builder_;
  design::Lowering lowering_;
  program::Point point_;
  bool is_finished_ = false;
};

// Limit for the instructions of a program without calls; they take some gigabytes.
inline constexpr double most_instructions = 1e8;

// Returns all parts of a design as one solid.
design::NodePtr whole_solid(const design::Design& design);

// Returns the attributes that some node of the design declares.
std::vector<design::AttributeDeclaration> declared_attributes(const design::Design& design);
std::vector<std::string> attribute_names(const design::Design& design);
// Returns the names of an attribute's numbers: "fibre.x", "fibre.y", "fibre.z". A number, or a name that the design
// lacks, gives the name alone.
std::vector<std::string> attribute_parts(const design::Design& design, const std::string& name);
std::vector<std::string> all_attribute_parts(const design::Design& design);
// Returns the unit of Question::value(), as people write it; empty for fractions and attributes without a unit.
std::string value_unit(const design::Design& design, const std::string& name);
// Reports the error that the design has no attribute of that name.
void report_unknown_attribute(const design::Design& design, const std::string& name, Diagnostics& diagnostics);

// Returns a composition's fractions as dithering takes them: those that are not positive, or not numbers, are left out.
std::vector<std::pair<MaterialId, program::Field>> shares(const design::Composition& composition);

}  // namespace ombre::compile
