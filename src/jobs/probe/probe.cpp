#include "jobs/probe/probe.h"

#include "questions/question.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

void take(ProbeResult& result, const Sampler::Column& column, double value) {
  using Kind = Sampler::Column::Kind;
  switch (column.kind) {
    case Kind::inside:
      result.inside = value != 0;
      return;
    case Kind::distance:
      result.distance = value;
      return;
    case Kind::fraction:
      if (result.inside && value > 0) result.composition.emplace_back(column.name, value);
      return;
    case Kind::attribute:
      result.attributes.emplace_back(column.name, value);
      return;
    case Kind::part:
      if (value != 0) result.parts.push_back(column.name);
      return;
    case Kind::check:
      return;
  }
}

}  // namespace

std::optional<std::vector<ProbeResult>> probe(const Loaded& loaded, const std::vector<Vec3>& points,
                                              Diagnostics& diagnostics) {
  const SampleQuery all{true, true, true, true, all_attribute_parts(loaded.design)};
  const auto sampler = Sampler::build(loaded.design, all, diagnostics);
  if (!sampler) return std::nullopt;
  std::vector<std::vector<double>> values(sampler->columns().size(), std::vector<double>(points.size()));
  std::vector<double*> columns;
  for (auto& column : values) columns.push_back(column.data());
  sampler->sample(points, columns);
  std::vector<ProbeResult> results(points.size());
  for (size_t n = 0; n < points.size(); ++n) {
    results[n].point = points[n];
    for (size_t c = 0; c < columns.size(); ++c) take(results[n], sampler->columns()[c], values[c][n]);
  }
  return results;
}

}  // namespace ombre::compile
