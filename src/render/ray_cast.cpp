#include "render/ray_cast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <tuple>

#include "base/error.h"
#include "eval/batch/batch.h"
#include "program/passes/passes.h"
#include "render/ray_steps.h"
#include "voxel/place_sources.h"
#include "voxel/tile.h"

namespace ombre::render {
namespace {

using voxel::StripSources;
using voxel::TileBox;

// Tiles of rays that are sampled without further questions.
constexpr int64_t leaf_steps = 32, leaf_columns = 16, leaf_rows = 8;
constexpr int64_t tile_edge = 32;              // of the picture's tiles, in pixels
constexpr size_t many_parts = 4;               // while so many reach a tile, it is cut before they are written out
constexpr int64_t behind = fine_per_step / 2;  // a surface, its colour is taken
constexpr float dark = 0.01F;                  // less light than that is none

// Samples of the rays at work.
class RaySamples : public eval::SourceRows {
 public:
  struct Ray {
    int64_t column = 0, first = 0;  // the fine place of its first sample
  };
  std::vector<Ray> rays;
  int64_t row = 0, stride = 1;  // of the picture; from sample to sample
  const StripSources* sources = nullptr;

  bool has(const program::Read& read) const override { return sources->has(read.tag); }
  void fill(const program::Read& read, const eval::RowsToFill& to) const override {
    for (size_t n = 0; n < to.count; ++n)
      for (size_t i = 0; i < to.width; ++i)
        to.values[n * to.stride + i] =
            sources->inside(read.tag, rays[n].first + stride * static_cast<int64_t>(i), rays[n].column, row) ? 1 : 0;
  }
};

// For batches. While surfaces are looked for, colours matter in translucent material only.
struct Programs {
  program::Program whole, walk;
  Programs(const Scene& scene, const program::Program& reference) : whole(fuse(sign_only(reference))), walk(whole) {
    if (scene.is_translucent) return;
    walk.outputs.resize(Scene::red);
    walk.output_names.resize(Scene::red);
  }
};

// One thread's.
class RayCaster {
 public:
  RayCaster(const Scene& scene, const Programs& programs, const RaySteps& steps, const Clarity& clarity,
            const std::function<bool()>& is_stopped, RayBand& hits)
      : scene_(scene),
        programs_(programs),
        steps_(steps),
        clarity_(clarity),
        is_stopped_(is_stopped),
        batch_(eval::kernel_sets().front()),
        hits_(hits) {}

  void cast(const TileBox& tile, const StripSources& sources) {
    samples_.sources = &sources;
    descend(programs_.walk, tile);
    colour_ends();
  }

 private:
  // Where a ray ends in opaque material.
  struct End {
    RaySamples::Ray ray;
    int64_t row = 0;
  };

  // Tiles are boxes of steps, columns and rows. Samples that look closer lie up to a step before the first.
  static TileBox fine_box(const TileBox& tile) {
    TileBox fine = tile;
    fine.lo[0] = RaySteps::fine_of(tile.lo[0] - 1);
    fine.hi[0] = RaySteps::fine_of(tile.hi[0] - 1) + 1;
    return fine;
  }

  void find_ranges(const program::Program& program, const TileBox& fine, std::vector<Interval>& values) {
    const Film& film = steps_.film;
    const Box points{{steps_.depth(fine.lo[0]), film.right_of(fine.lo[1]), film.down_of(fine.lo[2])},
                     {steps_.depth(fine.hi[0] - 1), film.right_of(fine.hi[1] - 1), film.down_of(fine.hi[2] - 1)}};
    evaluate_intervals(program, points, values, samples_.sources->ranges(fine), program::Precision::batch);
  }

  RayHit& hit(int64_t column, int64_t row) { return hits_.at(column, row); }
  bool is_open(int64_t column, int64_t row) { return hit(column, row).end == RayHit::none; }
  bool is_hidden(const TileBox& tile) {
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row)
      for (int64_t column = tile.lo[1]; column < tile.hi[1]; ++column)
        if (is_open(column, row)) return false;
    return true;
  }

  void descend(const program::Program& program, const TileBox& tile) {
    if (is_hidden(tile) || is_stopped_()) return;
    std::vector<Interval> values, kept;
    find_ranges(program, fine_box(tile), values);
    const auto range = [&](Scene::Output output) { return values[program.outputs[output]]; };
    if (range(Scene::inside) == Interval(0)) return;
    const bool is_murky = range(Scene::inside) == Interval(1) && range(Scene::opaque) == Interval(0);
    if (is_murky && is_uniform(range)) return absorb_all(tile, range);
    program::Program shorter = program::shorten(program, values, &kept);
    if (shorter.has_parts()) {
      if (!is_small(tile, false) && parts_in_reach(shorter, kept, many_parts) >= many_parts) return cut(shorter, tile);
      return descend(program::expand_parts(shorter, kept, program::Precision::batch), tile);
    }
    if (is_small(tile, is_murky)) return is_murky ? sample_murk(shorter, kept, tile) : sample(shorter, kept, tile);
    cut(shorter, tile);
  }

  static bool is_small(const TileBox& tile, bool is_murky) {
    return tile.size(0) <= (is_murky ? leaf_steps * murky_steps : leaf_steps) && tile.size(1) <= leaf_columns &&
           tile.size(2) <= leaf_rows;
  }

  template <class Range>
  static bool is_uniform(Range range) {
    for (const auto output : {Scene::red, Scene::green, Scene::blue, Scene::opacity})
      if (!range(output).is_point()) return false;
    return true;
  }

  // Of one colour and opacity throughout.
  template <class Range>
  void absorb_all(const TileBox& tile, Range range) {
    const auto value = [&](Scene::Output output) { return static_cast<float>(range(output).lo); };
    const Colour colour{value(Scene::red), value(Scene::green), value(Scene::blue)};
    const float depth = steps_.sample(RaySteps::fine_of(tile.lo[0]));
    const float through = clarity_.through(value(Scene::opacity), tile.size(0));
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row)
      for (int64_t column = tile.lo[1]; column < tile.hi[1]; ++column)
        if (is_open(column, row)) absorb(hit(column, row), through, depth, colour);
  }

  // A few samples for many steps.
  void sample_murk(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile) {
    batch_.compile(program, ranges, static_cast<size_t>(leaf_columns * leaf_steps), 1, samples_);
    const int64_t count = (tile.size(0) + murky_steps - 1) / murky_steps;
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row) {
      find_open(row, tile);
      if (samples_.rays.empty()) continue;
      evaluate(fine_per_step * murky_steps, static_cast<size_t>(count), true);
      for (size_t n = 0; n < samples_.rays.size(); ++n) {
        RayHit& ray = hit(samples_.rays[n].column, row);
        for (int64_t i = 0; i < count; ++i) {
          const int64_t steps = std::min(murky_steps, tile.size(0) - i * murky_steps);
          const auto at = static_cast<size_t>(i);
          const float through = clarity_.through(value(Scene::opacity, n, at), steps);
          if (absorb(ray, through, depths_[n * stride_ + at], colour(n, at))) break;
        }
      }
    }
  }

  void find_open(int64_t row, const TileBox& tile) {
    samples_.row = row;
    samples_.rays.clear();
    for (int64_t column = tile.lo[1]; column < tile.hi[1]; ++column)
      if (is_open(column, row)) samples_.rays.push_back({column, RaySteps::fine_of(tile.lo[0])});
  }

  // The near half first, which may hide the other one.
  void cut(const program::Program& program, const TileBox& tile) {
    const int64_t sizes[] = {(tile.size(0) + leaf_steps - 1) / leaf_steps,
                             (tile.size(1) + leaf_columns - 1) / leaf_columns,
                             (tile.size(2) + leaf_rows - 1) / leaf_rows};
    const auto axis = static_cast<size_t>(std::max_element(sizes, sizes + 3) - sizes);
    TileBox low = tile, high = tile;
    low.hi[axis] = high.lo[axis] = (tile.lo[axis] + tile.hi[axis]) / 2;
    descend(program, low);
    descend(program, high);
  }

  void sample(const program::Program& program, const std::vector<Interval>& ranges, const TileBox& tile) {
    batch_.compile(program, ranges, static_cast<size_t>(leaf_columns * leaf_steps), 1, samples_);
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row) {
      find_open(row, tile);
      if (samples_.rays.empty()) continue;
      evaluate(fine_per_step, static_cast<size_t>(tile.size(0)), scene_.is_translucent);
      find_hits(tile);
      if (!surfaces_.empty()) look_closer(surfaces_, Scene::inside);
      if (!ends_.empty()) look_closer(ends_, Scene::opaque);
    }
  }

  void evaluate(int64_t stride, size_t width, bool all_outputs) {
    samples_.stride = stride;
    width_ = width;
    stride_ = eval::padded(width);
    depths_.resize(stride_ * samples_.rays.size());
    rows_.clear();
    for (size_t n = 0; n < samples_.rays.size(); ++n) {
      float* const depths = depths_.data() + n * stride_;
      for (size_t i = 0; i < stride_; ++i)
        depths[i] = steps_.sample(samples_.rays[n].first + stride * static_cast<int64_t>(std::min(i, width - 1)));
      rows_.push_back({depths, static_cast<float>(steps_.film.right_of(samples_.rays[n].column))});
    }
    const auto down = static_cast<float>(steps_.film.down_of(samples_.row));
    batch_.place({rows_, {&down, 1}, width});
    batch_.begin_layer(0);
    batch_.begin_row(0);
    if (all_outputs) batch_.finish_row();
  }

  // Of sample `i` of ray `n`. What floats cannot hold counts as 0.
  float value(Scene::Output output, size_t n, size_t i) const {
    const float value = batch_.output(output)[n * stride_ + i];
    return std::isnan(value) ? 0 : value;
  }
  Colour colour(size_t n, size_t i) const {
    return {value(Scene::red, n, i), value(Scene::green, n, i), value(Scene::blue, n, i)};
  }

  // Notes between which samples rays meet a surface, and what the light loses in each.
  void find_hits(const TileBox& tile) {
    surfaces_.clear();
    ends_.clear();
    for (size_t n = 0; n < samples_.rays.size(); ++n) {
      RayHit& ray = hit(samples_.rays[n].column, samples_.row);
      bool is_new = ray.surface == RayHit::none;
      for (size_t i = 0; i < width_; ++i) {
        if (value(Scene::inside, n, i) == 0) continue;
        const RaySamples::Ray before{samples_.rays[n].column,
                                     RaySteps::fine_of(tile.lo[0] + static_cast<int64_t>(i) - 1)};
        if (is_new) surfaces_.push_back(before);
        is_new = false;
        if (!scene_.is_translucent) break;
        if (value(Scene::opaque, n, i) != 0) {
          ends_.push_back(before);
          break;
        }
        const float through = clarity_.through(value(Scene::opacity, n, i), 1);
        if (absorb(ray, through, depths_[n * stride_ + i], colour(n, i))) break;
      }
    }
  }

  // True: no light is left.
  bool absorb(RayHit& ray, float through, float depth, const Colour& here) {
    const float taken = ray.passes * (1 - through);
    ray.veil.red += taken * here.red;
    ray.veil.green += taken * here.green;
    ray.veil.blue += taken * here.blue;
    ray.passes *= through;
    if (ray.passes > dark) return false;
    ray.end = depth;
    ray.at_end = here;
    return true;
  }

  // From places before a surface to the first fine step behind it. An opaque surface also ends its ray.
  void look_closer(const std::vector<RaySamples::Ray>& before, Scene::Output what) {
    samples_.rays = before;
    for (const int64_t stride : {finer, int64_t{1}}) {
      for (RaySamples::Ray& ray : samples_.rays) ray.first += stride;
      evaluate(stride, finer, what != Scene::inside);
      for (size_t n = 0; n < samples_.rays.size(); ++n) {
        size_t i = 0;
        while (i + 1 < finer && value(what, n, i) == 0) ++i;
        samples_.rays[n].first += stride * (static_cast<int64_t>(i) - (stride > 1 ? 1 : 0));
      }
    }
    const bool is_end = what == Scene::opaque || !scene_.is_translucent;
    for (const RaySamples::Ray& ray : samples_.rays) {
      RayHit& found = hit(ray.column, samples_.row);
      const float depth = steps_.sample(ray.first);
      if (what == Scene::inside) found.surface = depth;
      if (!is_end) continue;
      found.end = depth;
      ends_met_.push_back({ray, samples_.row});
    }
  }

  // The ends of rays that were found in opaque material get its colour, those that lie together at a time.
  void colour_ends() {
    const auto block = [](const End& end) {
      return std::tuple(end.row / leaf_rows, end.ray.column / leaf_columns,
                        end.ray.first / (leaf_steps * fine_per_step));
    };
    std::sort(ends_met_.begin(), ends_met_.end(), [&](const End& a, const End& b) {
      return std::tuple(block(a), a.row, a.ray.column) < std::tuple(block(b), b.row, b.ray.column);
    });
    for (auto begin = ends_met_.begin(); begin != ends_met_.end() && !is_stopped_();) {
      const auto end =
          std::find_if(begin, ends_met_.end(), [&](const End& other) { return block(other) != block(*begin); });
      colour_block({begin, end});
      begin = end;
    }
    ends_met_.clear();
  }

  void colour_block(std::span<const End> ends) {
    TileBox fine{{ends[0].ray.first, ends[0].ray.column, ends[0].row}, {}};
    for (const End& end : ends) {
      const int64_t first[] = {end.ray.first, end.ray.column, end.row};
      const int64_t last[] = {end.ray.first + behind, end.ray.column, end.row};
      for (size_t axis = 0; axis < 3; ++axis) {
        fine.lo[axis] = std::min(fine.lo[axis], first[axis]);
        fine.hi[axis] = std::max(fine.hi[axis], last[axis] + 1);
      }
    }
    std::vector<Interval> kept;
    program::Program program = shortened(programs_.whole, fine, kept);
    if (program.has_parts())
      program = shortened(program::expand_parts(program, kept, program::Precision::batch), fine, kept);
    batch_.compile(program, kept, static_cast<size_t>(leaf_columns * leaf_steps), 1, samples_);
    for (size_t n = 0; n < ends.size();) {
      samples_.row = ends[n].row;
      samples_.rays.clear();
      for (; n < ends.size() && ends[n].row == samples_.row; ++n) samples_.rays.push_back(ends[n].ray);
      take_colours();
    }
  }

  program::Program shortened(const program::Program& program, const TileBox& fine, std::vector<Interval>& kept) {
    std::vector<Interval> values;
    find_ranges(program, fine, values);
    return program::shorten(program, values, &kept);
  }

  // A little behind the surface, if the solid is thick enough: where surfaces of two materials coincide, rounding
  // decides which is met first.
  void take_colours() {
    evaluate(behind, 2, true);
    for (size_t n = 0; n < samples_.rays.size(); ++n)
      hit(samples_.rays[n].column, samples_.row).at_end = colour(n, value(Scene::opaque, n, 1) != 0 ? 1 : 0);
  }

  const Scene& scene_;
  const Programs& programs_;
  const RaySteps& steps_;
  const Clarity& clarity_;
  const std::function<bool()>& is_stopped_;
  eval::BatchEvaluator batch_;
  RaySamples samples_;
  RayBand& hits_;
  size_t width_ = 0, stride_ = 0;
  std::vector<float> depths_;  // of the samples at work
  std::vector<eval::PointRow> rows_;
  std::vector<RaySamples::Ray> surfaces_, ends_;
  std::vector<End> ends_met_;
};

// Drops the outputs that are there for this alone.
voxel::RowSamplers place_sources(program::Program& program, const Scene& scene, const RaySteps& steps) {
  if (scene.eye_mm == 0) {
    Affine view_from_index = Affine::scaling(steps.step());
    view_from_index.offset = steps.first();
    return voxel::place_sources(program, view_from_index);
  }
  const std::vector<program::ValueId> base(program.outputs.begin() + Scene::output_count, program.outputs.end());
  program.outputs.resize(Scene::output_count);
  program.output_names.resize(Scene::output_count);
  return voxel::place_sources(program, program::RayLattice{scene.eye_mm, steps.first(), steps.step()}, base);
}

}  // namespace

RayBand cast_rays(const Scene& scene, const Film& film, int64_t begin, int64_t end, int threads,
                  const std::function<bool()>& is_stopped) {
  if (eval::kernel_sets().empty()) throw Error("pictures need a processor with hardware multiply-add");
  const RaySteps steps(scene, film);
  const Clarity clarity(film.pixel_mm / steps_per_pixel / scene.clarity_mm);
  program::Program reference = scene.program;
  const auto samplers = place_sources(reference, scene, steps);
  const Programs programs(scene, reference);
  RayBand band{begin, end, film.width, std::vector<RayHit>(static_cast<size_t>(film.width * (end - begin)))};
  const int64_t across = (film.width + tile_edge - 1) / tile_edge, down = (end - begin + tile_edge - 1) / tile_edge;
  run_parallel(static_cast<size_t>(across * down), threads, [&](size_t n) {
    if (is_stopped()) return;
    const int64_t column = static_cast<int64_t>(n) % across * tile_edge,
                  row = begin + static_cast<int64_t>(n) / across * tile_edge;
    const TileBox tile{{0, column, row},
                       {steps.steps, std::min(column + tile_edge, film.width), std::min(row + tile_edge, end)}};
    TileBox strip = tile;
    strip.hi[0] = steps.steps * fine_per_step;
    const StripSources sources(samplers, strip);
    RayCaster(scene, programs, steps, clarity, is_stopped, band).cast(tile, sources);
  });
  return band;
}

}  // namespace ombre::render
