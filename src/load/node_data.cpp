#include "load/node_data.h"

namespace ombre::compile {

DataMembers describe_node(const design::NodeType& type) {
  DataList parameters;
  const auto texts = [](const std::vector<std::string>& list) { return DataList(list.begin(), list.end()); };
  for (const design::ParameterInfo& parameter : type.parameters)
    parameters.emplace_back(DataMembers{{"name", parameter.name},
                                        {"doc", parameter.doc},
                                        {"kind", parameter.text.kind},
                                        {"python", parameter.text.python},
                                        {"widget", std::string(parameter.text.widget)},
                                        {"unit", std::string(parameter.domain.unit)},
                                        {"in_space", std::string(design::name_of(parameter.domain.in_space))},
                                        {"required", parameter.domain.required},
                                        {"default", parameter.default_value},
                                        {"choices", texts(parameter.domain.choices)},
                                        {"variables", texts(parameter.domain.variables)}});
  DataList outputs;
  for (const design::OutputInfo& output : type.outputs)
    outputs.emplace_back(DataMembers{
        {"name", output.name}, {"doc", output.doc}, {"type", output.type.name}, {"python", output.type.python}});
  const bool has_many = type.inputs.most == design::many_solids.most;
  return {{"name", type.name},
          {"category", type.category},
          {"sentence", type.sentence},
          {"parameters", parameters},
          {"inputs", DataMembers{{"least", static_cast<double>(type.inputs.least)},
                                 {"most", has_many ? Data() : Data(static_cast<double>(type.inputs.most))}}},
          {"gives", type.is_solid() ? "solid" : "values"},
          {"outputs", outputs},
          {"example", type.example}};
}

}  // namespace ombre::compile
