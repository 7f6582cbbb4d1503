#include "jobs/fea/fea_selection.h"

#include <algorithm>

#include "base/text/text.h"
#include "expr/expression.h"
#include "questions/design_stages.h"
#include "questions/nearby_values.h"
#include "questions/question.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using Nodes = std::vector<bool>;

std::optional<Nodes> of_part(const design::Design& design, const fea::MeshView& mesh, const fea::PlacedText& name,
                             int threads, const StopFlag* stop, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const design::Part& part : design.parts) names.push_back(part.name);
  const auto wanted = std::ranges::find(names, name.text);
  if (wanted == names.end()) {
    const std::string slip = did_you_mean(name.text, names);
    diagnostics.error(Code::unknown_part, name.where, "the design has no part \"" + name.text + "\"",
                      slip.empty() ? "its parts are " + join(names, ", ") : slip);
    return std::nullopt;
  }
  SampleQuery query;
  query.parts = true;
  const auto sampler = Sampler::build(design, query, diagnostics);
  if (!sampler) return std::nullopt;
  std::vector<Vec3> middles;
  for (size_t n = 0; n < mesh.count(); ++n) middles.push_back(mesh.centroid(n));
  std::vector<std::vector<double>> values(names.size(), std::vector<double>(middles.size()));
  std::vector<double*> columns;
  for (auto& column : values) columns.push_back(column.data());
  sampler->sample(middles, columns, threads, stop);
  Nodes nodes(mesh.node_count());
  const std::vector<double>& inside = values[static_cast<size_t>(wanted - names.begin())];
  for (size_t n = 0; n < middles.size(); ++n)
    for (const uint32_t node : mesh.nodes(n)) nodes[node] = nodes[node] || inside[n] > 0;
  return nodes;
}

std::optional<Nodes> by_formula(const design::Design& design, const fea::MeshView& mesh, const fea::PlacedText& text,
                                Diagnostics& diagnostics) {
  const auto formula = expr::Expression::parse(text.text, text.where, diagnostics);
  if (!formula) return std::nullopt;
  std::vector<std::string> known = expr::coordinate_names();
  const std::vector<std::string> attributes = all_attribute_parts(design);
  for (const std::string& name : attributes) known.push_back(to_lower(name));
  if (!formula->check_variables(known, text.text, text.where, diagnostics)) return std::nullopt;
  Question question(design);
  const auto variable = [&](std::string_view name) -> std::optional<program::Field> {
    for (const std::string& attribute : attributes)
      if (to_lower(attribute) == name) return question.attribute(attribute, diagnostics);
    return std::nullopt;
  };
  auto program = question.program({{"where", formula->lower(question.point(), variable)}}, diagnostics);
  if (!program) return std::nullopt;
  PointValues values(std::move(*program), mesh.bounds(), mesh.typical_size_mm());
  Nodes nodes(mesh.node_count());
  for (size_t n = 0; n < nodes.size(); ++n) {
    const double value = values.at(mesh.node(n));
    nodes[n] = value != 0 && value == value;
  }
  return nodes;
}

}  // namespace

fea::ChooseNodes node_chooser(const Loaded& loaded, const fea::MeshView& mesh, int threads, const StopFlag* stop) {
  return [&loaded, mesh, threads, stop](const fea::Selection& selection,
                                        Diagnostics& diagnostics) -> std::optional<Nodes> {
    StageLoan loan;
    loan.threads = threads;
    loan.stop = stop;
    const design::Design design = with_stages(loaded.design, loan);
    stages_of(design)->prepare(loan);
    Nodes nodes(mesh.node_count(), true);
    const auto keep = [&](const std::optional<Nodes>& those) {
      for (size_t n = 0; those && n < nodes.size(); ++n) nodes[n] = nodes[n] && (*those)[n];
      return those.has_value();
    };
    if (selection.part && !keep(of_part(design, mesh, *selection.part, threads, stop, diagnostics)))
      return std::nullopt;
    if (selection.formula && !keep(by_formula(design, mesh, *selection.formula, diagnostics))) return std::nullopt;
    return nodes;
  };
}

}  // namespace ombre::compile
