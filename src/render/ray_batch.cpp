#include "render/ray_batch.h"

#include <algorithm>

namespace ombre::render {

void RayBatch::compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_samples,
                       const voxel::StripSources& sources) {
  sources_ = &sources;
  outputs_.resize(program.outputs.size());
  batch_.compile_for_list(program, ranges, most_samples, *this);
}

void RayBatch::fill(const program::Read& read, const eval::RowsToFill& to) const {
  float* value = to.values;
  for (const Ray& ray : rays_)
    for (size_t i = 0; i < width_; ++i)
      *value++ = sources_->inside(read.tag, fine(ray, i), ray.column, ray.row) ? 1 : 0;
}

void RayBatch::evaluate(std::span<const Ray> rays, int64_t stride, size_t width, bool all_outputs) {
  rays_ = rays;
  stride_ = stride;
  width_ = width;
  for (std::vector<float>* coordinates : {&depths_, &rights_, &downs_}) coordinates->resize(rays.size() * width);
  for (size_t n = 0; n < rays.size(); ++n) {
    // Whole numbers of doubles, so as exact as those of steps.
    const auto first = static_cast<double>(rays[n].first), apart = static_cast<double>(stride);
    float* const depths = depths_.data() + n * width;
    for (int i = 0; i < static_cast<int>(width); ++i) depths[i] = steps_.sample(first + apart * i);
    std::fill_n(rights_.data() + n * width, width, static_cast<float>(steps_.film.right_of(rays[n].column)));
    std::fill_n(downs_.data() + n * width, width, static_cast<float>(steps_.film.down_of(rays[n].row)));
  }
  batch_.place({depths_, rights_, downs_});
  batch_.begin_layer(0);
  batch_.begin_row(0);
  if (all_outputs) batch_.finish_row();
  for (size_t n = 0; n < outputs_.size(); ++n) outputs_[n] = batch_.output(n);
}

size_t RayBatch::first_set(Scene::Output output, size_t n, size_t from) const {
  const eval::Values values = outputs_[output].from(n * width_);
  const auto is_set = [](float value) { return value > 0 || value < 0; };
  if (values.is_number) return is_set(values[0]) ? from : width_;
  return static_cast<size_t>(std::find_if(values.row + from, values.row + width_, is_set) - values.row);
}

}  // namespace ombre::render
