#include "questions/question.h"

#include <algorithm>

#include "base/system/assert.h"
#include "base/text/text.h"
#include "nodes/all_nodes.h"
#include "program/passes/passes.h"
#include "questions/design_stages.h"

namespace ombre::compile {
namespace {

using program::Field;
using program::Program;

std::vector<design::NodePtr> roots(const design::Design& design, const design::NodePtr& solid,
                                   const QuestionOptions& options) {
  std::vector<design::NodePtr> found;
  if (options.parts) found = design.roots();
  found.push_back(solid);
  if (options.shape) found.push_back(options.shape);
  return found;
}

}  // namespace

Question::Question(const design::Design& design, const QuestionOptions& options)
    : design_(design),
      solid_(whole_solid(design)),
      shape_(options.shape ? options.shape : solid_),
      stages_(stages_of(design)),
      context_(design.materials, roots(design, solid_, options), design.scale(), options.threads),
      lowering_(context_, builder_),
      point_(options.frame(builder_)) {
  context_.use_stages(design.lattice(), stages_);
  context_.use_memory(options.memory);
}

std::optional<Field> Question::attribute(std::string_view name, Diagnostics& diagnostics) {
  const design::AttributeDeclaration* declared = lowering_.declaration(name);
  if (!declared) {
    report_unknown_attribute(design_, std::string(name), diagnostics);
    return std::nullopt;
  }
  const std::vector<std::string> parts = design::parts_of(*declared);
  if (std::ranges::find(parts, name) != parts.end())
    return lowering_.attribute(*solid_, name, point_, design::Demand::inside);
  diagnostics.error(Code::unknown_attribute, design_.parts[0].solid->where(),
                    "the attribute \"" + declared->name + "\" is a " + std::string(design::name(declared->type)) +
                        ", where one number is wanted",
                    "write " + join(parts, " or "), {{"attribute", std::string(name)}});
  return std::nullopt;
}

std::optional<Field> Question::value(const std::string& name, Diagnostics& diagnostics) {
  if (const design::Material* material = design_.materials.find(name))
    for (const auto& [id, part] : shares(composition()))
      if (id == material->id) return part;
  if (lowering_.declaration(name)) return attribute(name, diagnostics);
  std::vector<std::string> known;
  for (const auto& [id, part] : composition().fractions) known.push_back(design_.materials.all()[id].name);
  for (const auto& attribute : attributes())
    for (const std::string& part : design::parts_of(attribute)) known.push_back(part);
  std::string hint = did_you_mean(name, known);
  if (hint.empty()) hint = "it has " + join(known, ", ");
  diagnostics.error(Code::unknown_attribute, solid_->where(),
                    "the design has neither a material nor an attribute \"" + name + '"', hint, {{"attribute", name}});
  return std::nullopt;
}

Program Question::program_with_calls(const program::Outputs& outputs) {
  if (!is_finished_) context_.finish_bodies();
  is_finished_ = true;
  return builder_.finish(outputs);
}

std::optional<Program> Question::program(const program::Outputs& outputs, Diagnostics& diagnostics) {
  const Program with_calls = program_with_calls(outputs);
  diagnostics.add_new(context_.diagnostics());
  const double size = program::inlined_size(with_calls);
  if (size <= most_instructions) return program::inline_bodies(with_calls);
  diagnostics.error(Code::too_large, solid_->where(),
                    "the design repeats its parts too often: about " + format_rounded(size, 2) + " operations a voxel");
  return std::nullopt;
}

design::NodePtr whole_solid(const design::Design& design) {
  if (design.parts.size() == 1) return design.parts[0].solid;
  Diagnostics none;
  return design::make_node(*nodes::registry().find("union"), {}, design.roots(),
                           {design.materials, none, nullptr, {}, "", ""});
}

std::vector<design::AttributeDeclaration> declared_attributes(const design::Design& design) {
  return design::LoweringContext(design.materials, design.roots()).attributes();
}

std::vector<std::string> attribute_names(const design::Design& design) {
  std::vector<std::string> names;
  for (const auto& attribute : declared_attributes(design)) names.push_back(attribute.name);
  return names;
}

std::string value_unit(const design::Design& design, const std::string& name) {
  if (design.materials.find(name)) return "";
  for (const auto& attribute : declared_attributes(design))
    if (attribute.name == design::attribute_of_part(name) && attribute.unit != "1") return attribute.unit;
  return "";
}

std::vector<std::string> attribute_parts(const design::Design& design, const std::string& name) {
  for (const auto& attribute : declared_attributes(design))
    if (attribute.name == name) return design::parts_of(attribute);
  return {name};
}

std::vector<std::string> all_attribute_parts(const design::Design& design) {
  std::vector<std::string> parts;
  for (const auto& attribute : declared_attributes(design))
    for (std::string& part : design::parts_of(attribute)) parts.push_back(std::move(part));
  return parts;
}

void report_unknown_attribute(const design::Design& design, const std::string& name, Diagnostics& diagnostics) {
  const std::vector<std::string> known = attribute_names(design);
  Phrase hint = did_you_mean(name, known);
  if (hint.empty()) hint = "it has " + join(known, ", ");
  if (known.empty()) hint = "give it one with " + spelled::call("attribute", {{"", '"' + name + '"'}, {"", "value"}});
  diagnostics.error(Code::unknown_attribute, design.parts[0].solid->where(),
                    "the design has no attribute \"" + name + '"', hint, {{"attribute", name}});
}

std::vector<std::pair<MaterialId, Field>> shares(const design::Composition& composition) {
  std::vector<std::pair<MaterialId, Field>> parts;
  std::vector<Field> all;
  for (const auto& [id, fraction] : composition.fractions) {
    parts.emplace_back(id, max(fraction, 0.0));
    all.push_back(parts.back().second);
  }
  const Field total = program::fold(all, [](Field a, Field b) { return a + b; });
  for (auto& [id, part] : parts) part = share(part, total);
  return parts;
}

}  // namespace ombre::compile
