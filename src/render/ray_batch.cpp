#include "render/ray_batch.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace ombre::render {
namespace {

// Returns true if steps_together samples are all +0; -0 counts as different.
bool are_all_zero(const float* values) {
  std::array<uint64_t, steps_together * sizeof(float) / sizeof(uint64_t)> words;
  std::memcpy(words.data(), values, sizeof words);
  return std::ranges::all_of(words, [](uint64_t word) { return word == 0; });
}

}  // namespace

void RayBatch::compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_samples,
                       const voxel::StripSources& sources) {
  sources_ = &sources;
  outputs_.resize(program.outputs.size());
  batch_.compile_for_list(program, ranges, most_samples, *this);
}

void RayBatch::fill(const program::Read& read, const eval::RowsToFill& to) const {
  float* value = to.values;
  for (const Ray& ray : rays_)
    for (size_t i = 0; i < width_; ++i) *value++ = sources_->value(read.tag, fine(ray, i), ray.column, ray.row);
}

void RayBatch::evaluate(std::span<const Ray> rays, int64_t stride, size_t width, bool all_outputs) {
  rays_ = rays;
  stride_ = stride;
  width_ = width;
  for (std::vector<float>* coordinates : {&depths_, &rights_, &downs_}) coordinates->resize(rays.size() * width);
  // Loops of a constant length are faster.
  if (width == steps_together)
    place<steps_together>();
  else if (width == 1)
    place<1>();
  else
    place<0>();
  batch_.place({depths_, rights_, downs_});
  batch_.begin_layer(0);
  batch_.begin_row(0);
  if (all_outputs) batch_.finish_row();
  for (size_t n = 0; n < outputs_.size(); ++n) outputs_[n] = batch_.output(n);
}

// Places the samples of all rays; known_width is 0 if the width is not a constant.
template <size_t known_width>
void RayBatch::place() {
  const size_t width = known_width > 0 ? known_width : width_;
  const auto apart = static_cast<double>(stride_);
  for (size_t n = 0; n < rays_.size(); ++n) {
    const Ray& ray = rays_[n];
    float* const depths = depths_.data() + n * width;
    if (known_width > 1 && n > 0 && ray.first == rays_[n - 1].first) {
      std::copy_n(depths - width, width, depths);
    } else {
      // Fine steps are integers in doubles, so they are exact.
      const auto first = static_cast<double>(ray.first);
      for (int i = 0; i < static_cast<int>(width); ++i) depths[i] = steps_.sample(first + apart * i);
    }
    std::fill_n(rights_.data() + n * width, width, static_cast<float>(steps_.film.right_of(ray.column)));
    std::fill_n(downs_.data() + n * width, width, static_cast<float>(steps_.film.down_of(ray.row)));
  }
}

size_t RayBatch::first_set(Scene::Output output, size_t n, size_t from) const {
  const eval::Values values = outputs_[output].from(n * width_);
  const auto is_set = [](float value) { return value > 0 || value < 0; };
  if (values.is_number) return is_set(values[0]) ? from : width_;
  if (from == 0 && width_ == steps_together && are_all_zero(values.row)) return width_;
  return static_cast<size_t>(std::find_if(values.row + from, values.row + width_, is_set) - values.row);
}

}  // namespace ombre::render
