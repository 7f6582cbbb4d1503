// From a design to programs.
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

// The design's point that a program's inputs stand for.
using Frame = std::function<program::Point(program::Builder& builder)>;

struct QuestionOptions {
  int threads = 1;                  // that make tables of many parts; 0: all cores
  bool parts = false;               // may part() be called?
  design::NodePtr shape = nullptr;  // a part of the design that inside() and distance() are of; null: all of it
  Frame frame = program::Point::origin_frame;
  // Of tables of many parts, which may then differ in rounding; null: none are kept.
  design::SubDesignMemory* memory = nullptr;
};

// What a design is at a point, as fields, and programs that compute what a job makes of them. Every program of a design
// is made by a question; one question may make several.
class Question {
 public:
  // The design must live as long.
  explicit Question(const design::Design& design, const QuestionOptions& options = {});

  const design::Design& design() const { return design_; }
  // All parts as one solid: overlaps are mixed, as in a union.
  const design::NodePtr& solid() const { return solid_; }
  program::Builder& builder() { return builder_; }
  const program::Point& point() const { return point_; }

  program::Field inside() { return lowering_.inside(*shape_, point_); }      // truth value
  program::Field distance() { return lowering_.distance(*shape_, point_); }  // mm, negative inside
  // Meant inside only, as are attributes.
  design::Composition composition() { return lowering_.composition(*solid_, point_, design::Demand::inside); }
  // Of one part, by its number: a truth value.
  program::Field part(size_t number) { return lowering_.inside(*design_.parts[number].solid, point_); }
  // A number, or one of the numbers of another attribute ("fibre.x"). Nothing, and a diagnostic, when no node of the
  // design declares it.
  std::optional<program::Field> attribute(std::string_view name, Diagnostics& diagnostics);
  // Of a material its fraction, as dithering takes it; else the attribute of that name. Nothing, and a diagnostic, when
  // the design has neither.
  std::optional<program::Field> value(const std::string& name, Diagnostics& diagnostics);
  const std::vector<design::AttributeDeclaration>& attributes() const { return context_.attributes(); }
  // Null when no node declares it.
  const design::AttributeDeclaration* declaration(std::string_view name) const { return lowering_.declaration(name); }
  // The stages of the design's job, or those of this question alone.
  const JobStagesPtr& stages() const { return stages_; }
  // What a composition's check of this number tells of.
  const design::Check& check(uint32_t number) const { return context_.checks()[number]; }

  // No question may follow. What nodes that are used more than once compute is called.
  program::Program program_with_calls(const program::Outputs& outputs);
  // The same without calls; what nodes have to tell becomes diagnostics. Nothing, and a diagnostic, when it would not
  // fit into memory.
  std::optional<program::Program> program(const program::Outputs& outputs, Diagnostics& diagnostics);

 private:
  const design::Design& design_;
  design::NodePtr solid_, shape_;
  JobStagesPtr stages_;  // must live while sources are made
  design::LoweringContext context_;
  program::Builder builder_;
  design::Lowering lowering_;
  program::Point point_;
  bool is_finished_ = false;
};

// A program without calls has no more of them; they take some gigabytes.
inline constexpr double most_instructions = 1e8;

// All parts of a design as one solid.
design::NodePtr whole_solid(const design::Design& design);

// The attributes that some node of the design declares.
std::vector<design::AttributeDeclaration> declared_attributes(const design::Design& design);
std::vector<std::string> attribute_names(const design::Design& design);
// The numbers of an attribute: itself, or "fibre.x", "fibre.y", "fibre.z"; the name alone where there is no such one.
std::vector<std::string> attribute_parts(const design::Design& design, const std::string& name);
std::vector<std::string> all_attribute_parts(const design::Design& design);
// The unit of what Question::value() gives: that of an attribute, as people write it; empty for fractions and where it
// has none.
std::string value_unit(const design::Design& design, const std::string& name);
// The error that the design has no attribute of that name.
void report_unknown_attribute(const design::Design& design, const std::string& name, Diagnostics& diagnostics);

// A composition's fractions as dithering takes them: those that are not positive, or not numbers, take no part.
std::vector<std::pair<MaterialId, program::Field>> shares(const design::Composition& composition);

}  // namespace ombre::compile
