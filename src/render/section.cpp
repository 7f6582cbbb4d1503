// Sections: the solid in a plane, with a ray for each point of the film that ends there if the point is inside.
#include "render/section.h"

#include <algorithm>

#include "base/system/tasks.h"
#include "eval/batch/batch.h"

namespace ombre::render {
namespace {

constexpr int64_t strip_rows = 32;  // rows per task

voxel::Lattice lattice_of(const Film& film) {
  const Pitch one{1, 1};
  return {{0, 0, 0}, {one, one, one}, {film.width, film.height, 1}};
}

voxel::Evaluator evaluator() {
  return eval::kernel_sets().empty() ? voxel::Evaluator::reference : voxel::Evaluator::batch;
}

void copy(const voxel::FieldTile& tile, RayBand& band) {
  for (int64_t row = tile.box.lo[1]; row < tile.box.hi[1]; ++row) {
    for (int64_t column = tile.box.lo[0]; column < tile.box.hi[0]; ++column) {
      const int64_t n = tile.is_uniform ? 0 : (row - tile.box.lo[1]) * tile.box.size(0) + column - tile.box.lo[0];
      RayHit& ray = band.at(column, row);
      ray = RayHit::nothing();
      if (!(tile.output(Section::inside)[n] > 0)) continue;
      ray.surface = ray.end = 0;
      ray.at_end = {tile.output(Section::red)[n], tile.output(Section::green)[n], tile.output(Section::blue)[n]};
    }
  }
}

}  // namespace

Affine Section::design_from_film(const Camera& camera, const Film& film) {
  const Affine view_from_film{
      {Vec3{0, 0, film.pixel_mm}, Vec3{film.pixel_mm, 0, 0}, Vec3{0, film.pixel_mm, 0}},
      {-0.5 * film.pixel_mm, film.right_of(0) - 0.5 * film.pixel_mm, film.down_of(0) - 0.5 * film.pixel_mm}};
  return camera.design_from_view() * view_from_film;
}

Section::Section(program::Program program, const Film& film)
    : width_(film.width), fields_(std::move(program), lattice_of(film), evaluator()) {}

RayBand Section::cast(int64_t begin, int64_t end, int threads, const StopFlag& stop) const {
  RayBand band(begin, end, width_);
  const int64_t strips = (end - begin + strip_rows - 1) / strip_rows;
  run_parallel(static_cast<size_t>(strips), threads, [&](size_t n) {
    const int64_t first = begin + static_cast<int64_t>(n) * strip_rows;
    const voxel::TileBox region{{0, first, 0}, {width_, std::min(first + strip_rows, end), 1}};
    for (const voxel::FieldTile& tile : fields_.tiles(region, &stop)) copy(tile, band);
  });
  return band;
}

}  // namespace ombre::render
