#include "questions/region_survey.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "questions/build.h"
#include "questions/field_program.h"
#include "questions/partition_program.h"
#include "questions/question.h"
#include "voxel/fields.h"
#include "voxel/layers.h"

namespace ombre::compile {
namespace {

using surface::Partition;

constexpr double samples_along_longest = 48;
constexpr float about_equal = 1e-3f;  // fractions that differ by less than rounding of samples count as equal

voxel::Lattice coarse_lattice(const Box& box) {
  const Vec3 size = box.size();
  // The pitch is a short decimal, since a number of twenty digits is not a pitch.
  const std::string pitch = format_rounded(std::max({size.x, size.y, size.z, 1e-6}) / samples_along_longest, 3);
  voxel::Lattice lattice;
  lattice.origin = box.lo;
  lattice.pitch.fill(Pitch::from_mm(parse_number(pitch).value()).value());
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    lattice.count[a] = voxel::voxels_along(size[axis], lattice.pitch[a]);
  }
  return lattice;
}

}  // namespace

std::vector<std::vector<float>> sample_coarsely(const program::Program& program, const Box& box) {
  const voxel::Lattice lattice = coarse_lattice(box);
  const voxel::FieldEvaluator evaluator(program, lattice, voxel::best_evaluator(lattice));
  std::vector<std::vector<float>> values(program.outputs.size(), std::vector<float>(lattice.voxels()));
  for (const voxel::FieldTile& tile : evaluator.tiles({{0, 0, 0}, lattice.count}))
    for (size_t n = 0; n < values.size(); ++n) {
      const float* from = tile.output(n);
      for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
        for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
          for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i) {
            values[n][static_cast<size_t>((k * lattice.count[1] + j) * lattice.count[0] + i)] = *from;
            if (!tile.is_uniform) ++from;
          }
    }
  return values;
}

namespace {

// Samples the fractions of all materials except void.
std::optional<std::vector<std::vector<float>>> sample_fractions(const design::Design& design, const Box& box,
                                                                std::vector<MaterialId>& ids,
                                                                Diagnostics& diagnostics) {
  FieldQuery query;
  for (const design::Material& material : design.materials.all())
    if (material.id != 0) query.fractions.push_back(material.id);
  const auto program = build_field_program(design, query, diagnostics);
  if (!program) return std::nullopt;
  for (const std::string& name : program->output_names) ids.push_back(design.materials.find(name)->id);
  return sample_coarsely(*program, box);
}

// Finds the samples that are inside: fractions are 0 outside, so some fraction of the design's materials is positive
// inside.
std::vector<bool> inside_of(const std::vector<std::vector<float>>& fractions) {
  std::vector<bool> inside(fractions.front().size(), false);
  for (const auto& values : fractions)
    for (size_t n = 0; n < values.size(); ++n)
      if (values[n] > 0) inside[n] = true;
  return inside;
}

bool are_mixed(const std::vector<std::vector<float>>& fractions) {
  for (size_t n = 0; n < fractions.front().size(); ++n) {
    float sum = 0, greatest = 0;
    for (const auto& values : fractions) {
      const float fraction = std::max(values[n], 0.0f);
      sum += fraction;
      greatest = std::max(greatest, fraction);
    }
    if (greatest < (1 - about_equal) * sum) return true;
  }
  return false;
}

// Returns the range of the values that are numbers, where the mark is greater than 0.
std::optional<Interval> range_inside(const std::vector<float>& values, const std::vector<float>& flags) {
  std::optional<Interval> range;
  for (size_t n = 0; n < values.size(); ++n) {
    const double value = values[n];
    if (flags[n] > 0 && std::isfinite(value)) range = range ? hull(*range, value) : Interval(value);
  }
  return range;
}

}  // namespace

std::optional<MaterialId> most_varying_material(const design::Design& design, const Box& box,
                                                Diagnostics& diagnostics) {
  std::vector<MaterialId> ids;
  const auto fractions = sample_fractions(design, box, ids, diagnostics);
  if (!fractions || fractions->empty()) return std::nullopt;
  const std::vector<bool> inside = inside_of(*fractions);
  std::optional<MaterialId> most;
  float most_spread = -1;
  for (size_t m = 0; m < ids.size(); ++m) {
    float least = 2, greatest = -1;
    for (size_t n = 0; n < inside.size(); ++n) {
      if (!inside[n]) continue;
      least = std::min(least, (*fractions)[m][n]);
      greatest = std::max(greatest, (*fractions)[m][n]);
    }
    if (greatest - least <= most_spread + about_equal) continue;
    most_spread = greatest - least;
    most = ids[m];
  }
  return most;
}

std::optional<MaterialsInside> find_materials(const design::Design& design, const Box& box, int threads,
                                              Diagnostics& diagnostics) {
  auto built = build_flat_program(design, diagnostics, threads);
  if (!built) return std::nullopt;
  leave_out_impossible(*built, box, threads);
  MaterialsInside found;
  for (const MaterialId id : built->materials.materials)
    if (id != void_material) found.names.push_back(design.materials.all()[id].name);
  if (found.names.size() < 2) return found;
  std::vector<MaterialId> ids;
  const auto fractions = sample_fractions(design, box, ids, diagnostics);
  if (!fractions) return std::nullopt;
  found.are_mixed = are_mixed(*fractions);
  return found;
}

std::optional<Interval> value_range(const design::Design& design, const Box& box, const std::string& name,
                                    Diagnostics& diagnostics) {
  Question question(design);
  const auto value = question.value(name, diagnostics);
  if (!value) return std::nullopt;
  const auto program = question.program({{name, *value}, {"inside", question.inside()}}, diagnostics);
  if (!program) return std::nullopt;
  const auto values = sample_coarsely(*program, box);
  return range_inside(values[0], values[1]);
}

std::optional<Interval> score_range(const Partition& partition, const Box& box) {
  const auto values = sample_coarsely(partition.details.whole(), box);
  return range_inside(values[Partition::first_score], values[Partition::label_output]);
}

std::vector<design::Rgba> mean_colours(const design::Design& design, const Partition& partition, const Box& box,
                                       Diagnostics& diagnostics) {
  constexpr design::Rgba grey{128, 128, 128, 255};
  std::vector<design::Rgba> colours(partition.regions, grey);
  std::vector<MaterialId> ids;
  const auto fractions = sample_fractions(design, box, ids, diagnostics);
  if (!fractions) return colours;
  const std::vector<float> labels = sample_coarsely(partition.label, box).front();
  std::vector<std::array<double, 5>> sums(partition.regions);  // sums of four colour channels and of the fractions
  for (size_t n = 0; n < labels.size(); ++n) {
    if (labels[n] < 1) continue;
    auto& sum = sums[static_cast<size_t>(labels[n]) - 1];
    for (size_t m = 0; m < ids.size(); ++m) {
      const double fraction = (*fractions)[m][n];
      const design::Rgba& colour = design.materials.all()[ids[m]].colour;
      for (size_t c = 0; c < 4; ++c) sum[c] += fraction * colour[c];
      sum[4] += fraction;
    }
  }
  for (size_t r = 0; r < sums.size(); ++r)
    for (size_t c = 0; c < 4; ++c)
      if (sums[r][4] > 0) colours[r][c] = static_cast<uint8_t>(std::lround(sums[r][c] / sums[r][4]));
  return colours;
}

}  // namespace ombre::compile
