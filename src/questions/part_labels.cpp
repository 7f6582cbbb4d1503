#include "questions/part_labels.h"

#include "nodes/all_nodes.h"
#include "questions/question.h"

namespace ombre::compile {
design::Design with_part_nodes(design::Design design) {
  const design::NodeType& type = *nodes::registry().find("part");
  for (design::Part& part : design.parts) {
    if (part.name == design::nameless_part || &part.solid->type() == &type) continue;
    Diagnostics none;
    const design::Reader reader{design.materials, none, nullptr, part.solid->where(), "part", ""};
    part.solid = design::make_node(type, {{type.parameters.data(), Data(part.name)}}, {part.solid}, reader);
  }
  return design;
}

std::vector<std::string> part_names(const design::Design& design) {
  for (const design::AttributeDeclaration& declared : declared_attributes(design))
    if (declared.name == part_label) return declared.labels;
  return {};
}

void report_nameless_parts(const design::Design& design, Diagnostics& diagnostics) {
  diagnostics.error(Code::unknown_part, design.parts[0].solid->where(), "no part of the design has a name",
                    "name some: " + spelled::around("part", {{"", "\"handle\""}}));
}

}  // namespace ombre::compile
