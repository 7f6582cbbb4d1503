#include "jobs/mesh/vertex_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "questions/colour_map.h"
#include "questions/question.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using Columns = std::vector<std::vector<double>>;

// Returns the colour that the attribute gives; alpha is full if the attribute has none.
formats::Rgba own_colour(const Columns& columns, size_t vertex) {
  formats::Rgba colour{0, 0, 0, 255};
  for (size_t part = 0; part < std::min<size_t>(4, columns.size()); ++part)
    colour[part] = colour_byte(columns[part][vertex]);
  return colour;
}

formats::Rgba mixed_colour(const design::MaterialTable& table, const Sampler& sampler, const Columns& columns,
                           size_t vertex) {
  std::array<double, 4> sum{};
  double total = 0;
  for (size_t c = 0; c < columns.size(); ++c) {
    const double share = columns[c][vertex] > 0 ? columns[c][vertex] : 0;
    const design::Rgba& colour = table.all()[sampler.columns()[c].material].colour;
    for (size_t part = 0; part < 4; ++part) sum[part] += share * colour[part];
    total += share;
  }
  formats::Rgba colour{128, 128, 128, 255};
  for (size_t part = 0; part < 4 && total > 0; ++part) colour[part] = colour_byte(sum[part] / total / 255);
  return colour;
}

Interval range_of(const std::vector<Columns>& bodies) {
  Interval range(Box::inf, -Box::inf);
  for (const Columns& columns : bodies)
    for (const double value : columns[0])
      if (std::isfinite(value)) range = hull(range, value);
  return range.lo <= range.hi ? range : Interval(0, 1);
}

formats::Rgba palette_colour(const VertexColouring& colouring, Interval range, double value) {
  const Palette* palette = palette_called(colouring.palette);
  const double width = range.hi > range.lo ? range.hi - range.lo : 1;
  return map_colour(std::isfinite(value) ? (value - range.lo) / width : 0, palette ? *palette : palettes().front());
}

}  // namespace

uint8_t colour_byte(double share) {
  return std::isfinite(share) ? static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))) : 0;
}

bool colour_vertices(const Loaded& loaded, const VertexColouring& colouring, formats::MeshDocument& document,
                     Diagnostics& diagnostics, int threads, const StopFlag* stop) {
  const bool by_materials = colouring.by == "materials";
  SampleQuery query;
  query.fractions = by_materials;
  if (!by_materials) query.attributes = attribute_parts(loaded.design, colouring.by);
  const auto sampler = Sampler::build(loaded.design, query, diagnostics);
  if (!sampler) return false;
  std::vector<Columns> bodies;
  for (const formats::MeshBody& body : document.bodies) {
    bodies.emplace_back(sampler->columns().size(), std::vector<double>(body.vertices.size()));
    std::vector<double*> columns;
    for (auto& column : bodies.back()) columns.push_back(column.data());
    sampler->sample(body.vertices, columns, threads, stop);
  }
  const bool is_number = !by_materials && sampler->columns().size() < 3;
  const Interval range = is_number ? colouring.range.value_or(range_of(bodies)) : Interval();
  for (size_t b = 0; b < bodies.size(); ++b)
    for (size_t n = 0; n < document.bodies[b].vertices.size(); ++n)
      document.bodies[b].vertex_colours.push_back(by_materials
                                                      ? mixed_colour(loaded.design.materials, *sampler, bodies[b], n)
                                                  : is_number ? palette_colour(colouring, range, bodies[b][0][n])
                                                              : own_colour(bodies[b], n));
  return true;
}

}  // namespace ombre::compile
