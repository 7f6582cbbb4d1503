// Makes grids of a design's materials and attributes for the page's volume view.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/text/error.h"
#include "base/text/text.h"
#include "questions/question.h"
#include "questions/region_survey.h"
#include "studio/design_answer.h"
#include "studio/sampled_design.h"
#include "studio/views.h"

namespace ombre::studio {
namespace {

constexpr size_t channels = 4;        // channels of a texture
constexpr size_t most_materials = 8;  // greatest number of materials shown, in two textures

// Textures of materials, with a byte for each material and texel and four materials in each texture, which WebGL takes
// as RGBA. A texel is the mean of 2 x 2 x 2 voxels, so that surfaces, and the light on them, are smooth.
class Textures {
 public:
  explicit Textures(const compile::GridJob& job) : materials_(std::min(job.grids.size(), most_materials)) {
    for (size_t axis = 0; axis < 3; ++axis) count_[axis] = (job.request.lattice.count[axis] + 1) / 2;
    sums_.resize((materials_ + channels - 1) / channels * texels() * channels, 0);
  }

  void add(const voxel::FieldTile& tile) {
    for (size_t m = 0; m < materials_; ++m) add_material(tile, m);
  }
  size_t materials() const { return materials_; }
  const std::array<int64_t, 3>& count() const { return count_; }
  std::string bytes() const {
    std::string bytes(sums_.size(), '\0');
    for (size_t n = 0; n < bytes.size(); ++n)
      bytes[n] = static_cast<char>(static_cast<unsigned char>((sums_[n] + 4U) / voxels_of_texel));
    return bytes;
  }

 private:
  static constexpr unsigned voxels_of_texel = 8;
  size_t texels() const { return static_cast<size_t>(count_[0] * count_[1] * count_[2]); }

  void add_material(const voxel::FieldTile& tile, size_t material) {
    const float* from = tile.output(material);
    const voxel::TileBox& box = tile.box;
    const size_t texture = material / channels * texels() * channels + material % channels;
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        const size_t row = texture + static_cast<size_t>((k / 2 * count_[1] + j / 2) * count_[0]) * channels;
        for (int64_t i = box.lo[0]; i < box.hi[0]; ++i, from += tile.is_uniform ? 0 : 1)
          sums_[row + static_cast<size_t>(i / 2) * channels] +=
              static_cast<uint16_t>(std::lround((*from > 0 ? std::min(*from, 1.F) : 0.F) * 255));
      }
  }

  std::array<int64_t, 3> count_{};
  size_t materials_;
  std::vector<uint16_t> sums_;  // sums over 8 voxels
};

// A texture of an attribute with two bytes for each texel, which WebGL takes as RG: the attribute's value times the
// share inside, and the share inside. A graphics processor may then interpolate texels, although those outside of the
// design have no value. A texel is the mean of 2 x 2 x 2 voxels.
class ValueTexture {
 public:
  ValueTexture(const std::array<int64_t, 3>& voxels, const Interval& range) : range_(range) {
    for (size_t axis = 0; axis < 3; ++axis) count_[axis] = (voxels[axis] + 1) / 2;
    sums_.resize(2 * static_cast<size_t>(count_[0] * count_[1] * count_[2]), 0);
  }

  // Adds a tile of the value, and of the flag for inside.
  void add(const voxel::FieldTile& tile) {
    const float *value = tile.output(0), *inside = tile.output(1);
    const int64_t next = tile.is_uniform ? 0 : 1;
    const voxel::TileBox& box = tile.box;
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        const int64_t row = (k / 2 * count_[1] + j / 2) * count_[0];
        for (int64_t i = box.lo[0]; i < box.hi[0]; ++i, value += next, inside += next)
          if (*inside > 0 && !std::isnan(*value)) add(static_cast<size_t>(row + i / 2), static_cast<double>(*value));
      }
  }
  const std::array<int64_t, 3>& count() const { return count_; }
  std::string bytes() const {
    std::string bytes;
    bytes.reserve(sums_.size());
    for (const float sum : sums_) bytes += static_cast<char>(static_cast<unsigned char>(std::lround(sum * 255 / 8)));
    return bytes;
  }

 private:
  void add(size_t texel, double value) {
    const double size = range_.hi - range_.lo;
    sums_[2 * texel] += static_cast<float>(size > 0 ? std::clamp((value - range_.lo) / size, 0.0, 1.0) : 0.5);
    sums_[2 * texel + 1] += 1;
  }

  Interval range_;
  std::array<int64_t, 3> count_{};
  std::vector<float> sums_;  // sums over 8 voxels
};

DataMembers describe_texels(const std::array<int64_t, 3>& texels, const voxel::Lattice& lattice) {
  DataList count;
  for (const int64_t n : texels) count.emplace_back(number(n));
  return {{"count", std::move(count)}, {"pitch_mm", 2 * lattice.pitch[0].mm()}, {"origin_mm", list_of(lattice.origin)}};
}

// Throws RequestError unless the name is that of a single number, such as "stiffness" or "fibre.x".
void check_is_number(const design::Design& design, const std::string& attribute) {
  const std::vector<std::string> all = compile::all_attribute_parts(design);
  if (std::ranges::find(all, attribute) != all.end()) return;
  throw RequestError("design",
                     all.empty() ? "the design has no attributes"
                                 : "the design has no number called \"" + attribute + "\"; it has " + join(all, ", "));
}

Answer value_volume(OpenDesign& design, const std::string& attribute, double voxels, const StopFlag& stop) {
  check_is_number(design.loaded->design, attribute);
  Diagnostics diagnostics;
  const auto range = compile::value_range(design.loaded->design, design.bounds, attribute, diagnostics);
  if (!range) throw diagnostics.has_errors() ? design_error(diagnostics) : RequestError("design", "nothing is inside");
  compile::GridQuery query;
  query.attributes = {attribute};
  const SampledDesign sampled = sample(design, design.bounds, voxels, stop, query);
  const voxel::Lattice& lattice = sampled.job.request.lattice;
  ValueTexture texture(lattice.count, *range);
  const auto take = [&](const compile::GridSlab& slab) {
    for (const voxel::FieldTile& tile : slab.tiles) texture.add(tile);
  };
  compile::each_slab(sampled.job, 0, take, nullptr, &stop);
  Answer answer{describe_texels(texture.count(), lattice), texture.bytes()};
  answer.members.emplace_back("range", DataList{range->lo, range->hi});
  return answer;
}

}  // namespace

Answer volume_answer(OpenDesign& design, const Request& request, const StopFlag& stop) {
  const double side = static_cast<double>(request.whole("side", 8, 256));
  const double voxels = 8 * side * side * side;
  if (const std::string by = request.text("by", ""); !by.empty()) return value_volume(design, by, voxels, stop);
  const SampledDesign sampled = sample(design, design.bounds, voxels, stop);
  if (sampled.job.grids.empty()) throw RequestError("design", "the design has no material to show");
  Textures textures(sampled.job);
  const auto take = [&](const compile::GridSlab& slab) {
    for (const voxel::FieldTile& tile : slab.tiles) textures.add(tile);
  };
  compile::each_slab(sampled.job, 0, take, nullptr, &stop);
  const voxel::Lattice& lattice = sampled.job.request.lattice;
  DataList materials;
  for (size_t m = 0; m < textures.materials(); ++m) {
    const compile::SliceMaterial& material = *sampled.job.grids[m].material;
    DataList colour;
    for (const uint8_t channel : material.rgba) colour.emplace_back(number(channel));
    materials.emplace_back(DataMembers{{"name", material.name}, {"colour", std::move(colour)}});
  }
  Answer answer{describe_texels(textures.count(), lattice), textures.bytes()};
  answer.members.emplace_back("materials", std::move(materials));
  answer.members.emplace_back("left_out", number(sampled.job.grids.size() - textures.materials()));
  return answer;
}

}  // namespace ombre::studio
