#include "jobs/fea/element_size.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "expr/expression.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

using program::Field;

// Eq. 1 of the 2025 paper; it is 1 for one material.
Field heterogeneity(Question& question) {
  program::Builder& builder = question.builder();
  const auto fractions = shares(question.composition());
  if (fractions.size() < 2) return builder.constant(1);
  const double even = 1 / static_cast<double>(fractions.size());
  Field total = builder.constant(0), squares = builder.constant(0);
  for (const auto& [id, fraction] : fractions) total = total + fraction;
  for (const auto& [id, fraction] : fractions) {
    const Field off = fraction / total - builder.constant(even);
    squares = squares + off * off;
  }
  return sqrt(squares) * builder.constant(1 / std::sqrt(1 - even));
}

}  // namespace

std::optional<ElementSize> ElementSize::build(const design::Design& design, const Box& box, const SizeRequest& request,
                                              Diagnostics& diagnostics) {
  ElementSize size;
  size.request_ = request;
  if (size.is_one()) return size;
  const SourcePtr source = make_source("--size-by", request.formula);
  const SourceRange where{source, 0, static_cast<uint32_t>(request.formula.size())};
  const auto formula = expr::Expression::parse(request.formula, where, diagnostics);
  if (!formula) return std::nullopt;
  std::vector<std::string> known = expr::coordinate_names();
  known.insert(known.end(), {"h", "min_cell", "max_cell"});
  const std::vector<std::string> attributes = all_attribute_parts(design);
  for (const std::string& name : attributes) known.push_back(to_lower(name));
  if (!formula->check_variables(known, request.formula, where, diagnostics)) return std::nullopt;
  Question question(design);
  const auto variable = [&](std::string_view name) -> std::optional<Field> {
    if (name == "h") return heterogeneity(question);
    if (name == "min_cell") return question.builder().constant(request.least_mm);
    if (name == "max_cell") return question.builder().constant(request.most_mm);
    for (const std::string& attribute : attributes)
      if (to_lower(attribute) == name) return question.attribute(attribute, diagnostics);
    return std::nullopt;
  };
  const Field value = formula->lower(question.point(), variable);
  auto program = question.program({{"size", value}}, diagnostics);
  if (!program) return std::nullopt;
  size.stages_ = question.stages();
  size.values_ = PointValues(std::move(*program), box, request.most_mm);
  return size;
}

double ElementSize::at(Vec3 p) {
  if (is_one()) return request_.least_mm;
  const double size = values_.at(p);
  return std::isnan(size) ? request_.most_mm : std::clamp(size, request_.least_mm, request_.most_mm);
}

}  // namespace ombre::compile
