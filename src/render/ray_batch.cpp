#include "render/ray_batch.h"

#include <algorithm>

namespace ombre::render {

void RayBatch::compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_samples,
                       const voxel::StripSources& sources) {
  sources_ = &sources;
  outputs_.resize(program.outputs.size());
  batch_.compile(program, ranges, most_samples, 1, *this);
}

void RayBatch::fill(const program::Read& read, const eval::RowsToFill& to) const {
  for (size_t n = 0; n < to.count; ++n) {
    const Ray& ray = (*rays_)[n];
    for (size_t i = 0; i < to.width; ++i) {
      const int64_t fine = ray.first + fine_stride_ * static_cast<int64_t>(i);
      to.values[n * to.stride + i] = sources_->inside(read.tag, fine, ray.column, row_) ? 1 : 0;
    }
  }
}

void RayBatch::evaluate(const std::vector<Ray>& rays, int64_t row, int64_t stride, size_t width, bool all_outputs) {
  rays_ = &rays;
  row_ = row;
  fine_stride_ = stride;
  width_ = width;
  stride_ = eval::padded(width);
  depths_.resize(stride_ * rays.size());
  rows_.clear();
  for (size_t n = 0; n < rays.size(); ++n) {
    float* const depths = depths_.data() + n * stride_;
    // Whole numbers of doubles, so as exact as those of steps.
    const auto first = static_cast<double>(rays[n].first), apart = static_cast<double>(stride);
    for (size_t i = 0; i < width; ++i) depths[i] = steps_.sample(first + apart * static_cast<double>(i));
    std::fill(depths + width, depths + stride_, depths[width - 1]);
    rows_.push_back({depths, static_cast<float>(steps_.film.right_of(rays[n].column))});
  }
  const auto down = static_cast<float>(steps_.film.down_of(row));
  batch_.place({rows_, {&down, 1}, width});
  batch_.begin_layer(0);
  batch_.begin_row(0);
  if (all_outputs) batch_.finish_row();
  for (size_t n = 0; n < outputs_.size(); ++n) outputs_[n] = batch_.output(n);
}

size_t RayBatch::first_set(Scene::Output output, size_t n, size_t from) const {
  const eval::Values values = outputs_[output].from(n * stride_);
  const auto is_set = [](float value) { return value > 0 || value < 0; };
  if (values.is_number) return is_set(values[0]) ? from : width_;
  return static_cast<size_t>(std::find_if(values.row + from, values.row + width_, is_set) - values.row);
}

}  // namespace ombre::render
