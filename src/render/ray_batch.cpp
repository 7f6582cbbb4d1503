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
  for (size_t n = 0; n < rays_->size(); ++n) {
    const Ray& ray = (*rays_)[n];
    for (size_t i = 0; i < width_; ++i) {
      const int64_t fine = ray.first + fine_stride_ * static_cast<int64_t>(i);
      to.values[places_[n] + i] = sources_->inside(read.tag, fine, ray.column, row_) ? 1 : 0;
    }
  }
}

void RayBatch::evaluate(const std::vector<Ray>& rays, int64_t row, int64_t stride, size_t width, bool all_outputs) {
  rays_ = &rays;
  row_ = row;
  fine_stride_ = stride;
  width_ = width;
  place_rays();
  const auto down = static_cast<float>(steps_.film.down_of(row));
  batch_.place({rows_, {&down, 1}, eval::padded(width)});
  batch_.begin_layer(0);
  batch_.begin_row(0);
  if (all_outputs) batch_.finish_row();
  for (size_t n = 0; n < outputs_.size(); ++n) outputs_[n] = batch_.output(n);
}

// As many rays of one column as fit share a row of floats.
void RayBatch::place_rays() {
  const size_t row_floats = eval::padded(width_), most_in_row = row_floats / width_;
  depths_.resize(rays_->size() * row_floats);
  places_.clear();
  rows_.clear();
  size_t in_row = 0;
  for (size_t n = 0; n < rays_->size(); ++n) {
    const Ray& ray = (*rays_)[n];
    const bool shares = n > 0 && in_row < most_in_row && (*rays_)[n - 1].column == ray.column;
    in_row = shares ? in_row + 1 : 1;
    if (!shares) rows_.push_back({nullptr, static_cast<float>(steps_.film.right_of(ray.column))});
    const size_t row_begin = (rows_.size() - 1) * row_floats;
    places_.push_back(row_begin + (in_row - 1) * width_);
    // Whole numbers of doubles, so as exact as those of steps.
    float* const depths = depths_.data() + places_.back();
    const auto first = static_cast<double>(ray.first), apart = static_cast<double>(fine_stride_);
    for (size_t i = 0; i < width_; ++i) depths[i] = steps_.sample(first + apart * static_cast<double>(i));
    std::fill(depths + width_, depths_.data() + row_begin + row_floats, depths[width_ - 1]);
  }
  for (size_t n = 0; n < rows_.size(); ++n) rows_[n].xs = depths_.data() + n * row_floats;
}

size_t RayBatch::first_set(Scene::Output output, size_t n, size_t from) const {
  const eval::Values values = outputs_[output].from(places_[n]);
  const auto is_set = [](float value) { return value > 0 || value < 0; };
  if (values.is_number) return is_set(values[0]) ? from : width_;
  return static_cast<size_t>(std::find_if(values.row + from, values.row + width_, is_set) - values.row);
}

}  // namespace ombre::render
