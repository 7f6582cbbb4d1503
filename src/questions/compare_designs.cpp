#include "questions/compare_designs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "questions/design_stages.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

constexpr int points_along = 40;

std::vector<Vec3> points_in(const Box& box) {
  std::vector<Vec3> points;
  const auto place = [&box](int axis, int n) { return box.lo[axis] + box.size()[axis] * (n + 0.5) / points_along; };
  for (int k = 0; k < points_along; ++k)
    for (int j = 0; j < points_along; ++j)
      for (int i = 0; i < points_along; ++i) points.push_back({place(0, i), place(1, j), place(2, k)});
  return points;
}

// The values of a design at points. A material that it never has has no column.
struct Values {
  std::vector<double> inside;
  std::map<std::string, std::vector<double>> of;

  double at(const std::string& name, size_t point) const {
    const auto found = of.find(name);
    return found == of.end() ? 0 : found->second[point];
  }
};

std::optional<Values> values_of(const design::Design& design, const std::string& attribute, const Box& box,
                                const std::vector<Vec3>& points, Diagnostics& diagnostics) {
  design::StageLattice lattice;
  lattice.origin = box.lo;
  for (size_t axis = 0; axis < 3; ++axis)
    lattice.pitch[axis] =
        Pitch::from_mm(box.size()[static_cast<int>(axis)] / points_along).value_or(lattice.pitch[axis]);
  const design::Design staged = with_stages(design::for_lattice(design, lattice), {});
  SampleQuery query;
  query.inside = true;
  query.fractions = attribute.empty();
  if (!attribute.empty()) query.attributes.push_back(attribute);
  const auto sampler = Sampler::build(staged, query, diagnostics);
  if (!sampler) return std::nullopt;
  std::vector<std::vector<double>> columns(sampler->columns().size(), std::vector<double>(points.size()));
  std::vector<double*> starts;
  for (auto& column : columns) starts.push_back(column.data());
  sampler->sample(points, starts);
  Values values{columns[0], {}};
  for (size_t n = 1; n < columns.size(); ++n) values.of[sampler->columns()[n].name] = std::move(columns[n]);
  return values;
}

}  // namespace

std::optional<Difference> greatest_difference(const design::Design& first, const design::Design& second,
                                              const std::string& attribute, const Box& box, Diagnostics& diagnostics) {
  const std::vector<Vec3> points = points_in(box);
  const auto one = values_of(first, attribute, box, points, diagnostics);
  const auto other = one ? values_of(second, attribute, box, points, diagnostics) : std::nullopt;
  if (!other) return std::nullopt;
  std::optional<Difference> greatest;
  for (const auto& [name, column] : one->of)
    for (size_t n = 0; n < points.size(); ++n) {
      if (one->inside[n] == 0 || column[n] == other->at(name, n)) continue;
      const Difference here{points[n], name, column[n], other->at(name, n)};
      if (!greatest || std::abs(here.second - here.first) > std::abs(greatest->second - greatest->first))
        greatest = here;
    }
  return greatest;
}

}  // namespace ombre::compile
