#include "render/ray_cast.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "program/passes/prepare.h"
#include "render/end_colours.h"
#include "render/ray_batch.h"
#include "render/ray_ends.h"
#include "voxel/place_sources.h"

namespace ombre::render {
namespace {

using voxel::StripSources;

// Rays are evaluated in blocks of samples; the blocks of a leaf are evaluated together.
constexpr TileSize leaf{64, 32, 16}, block{steps_together, 8, 8};
constexpr TileSize fine_block{steps_together, 4, 4};  // for programs that query sources sample by sample
constexpr size_t most_samples = 512;                  // per batch
static_assert((leaf[0] / block[0]) * (leaf[1] / block[1]) * (leaf[2] / block[2]) <= most_pieces);
static_assert(leaf[1] * leaf[2] <= most_samples, "all rays of a leaf are followed together");
constexpr int64_t largest_tile = 128, smallest_tile = 64;  // sides of the picture's tiles, in rays
constexpr int64_t enough_tiles = 4;                        // number of tiles that keeps all threads busy
// number of parts within reach from which a tile is divided before its parts are unrolled
constexpr size_t many_parts = 12;
constexpr float dark = 0.01F;  // a share of light below this counts as none

// The programs of a scene for batches. The search for surfaces needs colours only in translucent material.
struct Programs {
  program::Program whole, traversal;
  Programs(const Scene& scene, const program::Program& reference)
      : whole(program::prepare(reference, program::Purpose::rays)) {
    whole.output_names.clear();
    traversal = whole;
    if (!scene.is_translucent) traversal.outputs.resize(Scene::red);
  }
};

bool reads_sources(const program::Program& program) {
  return std::ranges::any_of(program.code, [](const program::Instruction& in) { return in.op == program::Op::source; });
}

// The ends of a band's rays: known from an earlier picture, or to be found.
struct BandEnds {
  int64_t begin = 0, width = 0;  // first row; number of rays per row
  std::shared_ptr<const RayEnds> known = {};
  std::shared_ptr<RayEnds> found = {};  // null if the ends are not to be kept

  size_t place(int64_t column, int64_t row) const { return static_cast<size_t>((row - begin) * width + column); }
};

// Casts the rays of tiles, for one thread.
class RayCaster {
 public:
  RayCaster(const Scene& scene, const Programs& programs, const RaySteps& steps, const Clarity& clarity,
            const std::function<bool()>& is_stopped, const BandEnds& ends, RayBand& hits)
      : scene_(scene),
        programs_(programs),
        steps_(steps),
        clarity_(clarity),
        is_stopped_(is_stopped),
        band_ends_(ends),
        batch_(steps),
        colours_(programs.whole, steps, hits),
        blocks_(steps),
        hits_(hits) {}

  void cast(const TileBox& tile, const StripSources& sources) {
    sources_ = &sources;
    first_column_ = tile.lo[1];
    first_row_ = tile.lo[2];
    is_open_.fill(1);
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row)
      std::ranges::fill(hits_.part(row, tile.lo[1], tile.hi[1]), RayHit::nothing());
    if (band_ends_.known)
      recall(tile);
    else
      descend(programs_.traversal, tile, 0);
    colours_.take(sources, is_stopped_);
  }

 private:
  // Sets the known ends of a tile's rays without sampling.
  void recall(const TileBox& tile) {
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row)
      for (int64_t column = tile.lo[1]; column < tile.hi[1]; ++column) {
        const int64_t fine = band_ends_.known->fine[band_ends_.place(column, row)];
        if (fine == RayEnds::none) continue;
        const Ray ray{column, row, fine};
        hit(ray).surface = hit(ray).end = static_cast<float>(steps_.depth(fine));
        colours_.note(ray);
      }
  }
  RayHit& hit(const Ray& ray) { return hits_.at(ray.column, ray.row); }
  // Flag of a ray: 1 until its end is found.
  uint8_t& is_open(int64_t column, int64_t row) {
    return is_open_[static_cast<size_t>((row - first_row_) * largest_tile + column - first_column_)];
  }
  bool is_hidden(const TileBox& tile) {
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row) {
      const uint8_t* const begin = &is_open(tile.lo[1], row);
      if (std::find(begin, begin + tile.size(1), 1) != begin + tile.size(1)) return false;
    }
    return true;
  }
  // Returns the smallest part of a tile that contains all its open rays; there must be some.
  TileBox around_open(const TileBox& tile) {
    TileBox open = tile;
    open.lo[1] = tile.hi[1], open.hi[1] = tile.lo[1];
    open.lo[2] = tile.hi[2], open.hi[2] = tile.lo[2];
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row) {
      const uint8_t *const begin = &is_open(tile.lo[1], row), *const end = begin + tile.size(1);
      const uint8_t* const first = std::find(begin, end, 1);
      if (first == end) continue;
      const uint8_t* last = end;
      while (last[-1] == 0) --last;
      open.lo[1] = std::min(open.lo[1], tile.lo[1] + (first - begin));
      open.hi[1] = std::max(open.hi[1], tile.lo[1] + (last - begin));
      open.lo[2] = std::min(open.lo[2], row);
      open.hi[2] = row + 1;
    }
    return open;
  }
  void end(const Ray& ray, float depth) {
    hit(ray).end = depth;
    is_open(ray.column, ray.row) = 0;
  }

  // Lists the open rays of a tile, from its first step on.
  void list_open(const TileBox& tile) {
    for (int64_t row = tile.lo[2]; row < tile.hi[2]; ++row)
      for (int64_t column = tile.lo[1]; column < tile.hi[1]; ++column)
        if (is_open(column, row)) rays_.push_back({column, row, RaySteps::fine_of(tile.lo[0])});
  }
  // Calls f with the listed rays in groups, such that `width` samples of each ray fit into a batch.
  template <class F>
  void each_batch(size_t width, F f) {
    const size_t most = most_samples / width;
    for (size_t begin = 0; begin < rays_.size(); begin += most)
      f(std::span(rays_).subspan(begin, std::min(most, rays_.size() - begin)));
  }

  QueriedTiles& level(size_t depth) {
    while (levels_.size() <= depth) levels_.emplace_back(steps_);
    return levels_[depth];
  }

  // Visits the nearest pieces first, because they may hide the others.
  void descend(const program::Program& program, const TileBox& tile, size_t depth) {
    if (is_stopped_()) return;
    const std::vector<TileBox> pieces = cut(around_open(tile), leaf);
    QueriedTiles& here = level(depth);
    here.ask(program, fine_boxes(pieces), *sources_);
    for (size_t n = 0; n < pieces.size(); ++n) {
      const auto range = [&](Scene::Output output) { return here.intervals.output(output, n); };
      if (range(Scene::inside) == Interval(0) || is_hidden(pieces[n])) continue;
      const bool is_murky = range(Scene::inside) == Interval(1) && range(Scene::opaque) == Interval(0);
      if (is_murky && is_uniform(range))
        absorb_all(pieces[n], range);
      else
        enter(program, here, n, pieces[n], is_murky, depth);
    }
  }

  static std::vector<TileBox> fine_boxes(const std::vector<TileBox>& tiles) {
    std::vector<TileBox> fine;
    fine.reserve(tiles.size());
    for (const TileBox& tile : tiles) fine.push_back(fine_box(tile));
    return fine;
  }

  // Enters tile number `n` of those evaluated together.
  void enter(const program::Program& program, QueriedTiles& queried, size_t n, const TileBox& tile, bool is_murky,
             size_t depth) {
    if (!is_murky && is_small(tile, false)) return sample(program, tile);
    queried.shorten(n);
    const bool is_sampled = is_murky && is_small(tile, true);
    if (queried.left.has_parts() && (is_sampled || parts_in_reach(queried.left, queried.kept, many_parts) < many_parts))
      queried.write_out_parts();
    if (is_sampled) return sample_murk(queried.left, tile);
    descend(queried.left, tile, depth + 1);
  }

  static bool is_small(const TileBox& tile, bool is_murky) {
    return tile.size(0) <= (is_murky ? leaf[0] * murky_steps : leaf[0]) && tile.size(1) <= leaf[1] &&
           tile.size(2) <= leaf[2];
  }

  template <class Range>
  static bool is_uniform(Range range) {
    for (const auto output : {Scene::red, Scene::green, Scene::blue, Scene::opacity})
      if (!range(output).is_point()) return false;
    return true;
  }

  // Absorbs light through a tile with a constant colour and opacity.
  template <class Range>
  void absorb_all(const TileBox& tile, Range range) {
    const auto value = [&](Scene::Output output) { return static_cast<float>(range(output).lo); };
    const Colour colour{value(Scene::red), value(Scene::green), value(Scene::blue)};
    const float depth = static_cast<float>(steps_.depth(RaySteps::fine_of(tile.lo[0])));
    const float opacity = value(Scene::opacity);
    rays_.clear();
    list_open(tile);
    for (const Ray& ray : rays_) absorb(ray, opacity, tile.size(0), depth, colour);
  }

  // Samples translucent material with one sample for many steps.
  void sample_murk(const program::Program& program, const TileBox& tile) {
    blocks_.ask(program, {fine_box(tile)}, *sources_);
    blocks_.shorten(size_t{0});
    batch_.compile(blocks_.left, blocks_.kept, most_samples, *sources_);
    const int64_t count = (tile.size(0) + murky_steps - 1) / murky_steps;
    const auto width = static_cast<size_t>(count);
    rays_.clear();
    list_open(tile);
    each_batch(width, [&](std::span<const Ray> rays) {
      batch_.evaluate(rays, fine_per_step * murky_steps, width, true);
      for (size_t n = 0; n < rays.size(); ++n) {
        for (int64_t i = 0; i < count; ++i) {
          const int64_t steps = std::min(murky_steps, tile.size(0) - i * murky_steps);
          const auto at = static_cast<size_t>(i);
          if (absorb(rays[n], batch_.value(Scene::opacity, n, at), steps, batch_.depth(n, at), batch_.colour(n, at)))
            break;
        }
      }
    });
  }

  // Samples the blocks of a leaf that may contain something.
  void sample(const program::Program& program, const TileBox& tile) {
    std::vector<TileBox> pieces = cut(around_open(tile), block);
    std::erase_if(pieces, [&](const TileBox& piece) { return is_hidden(piece); });
    if (!pieces.empty()) keep_met(program, pieces);
    if (pieces.empty()) return;
    if (program.has_parts()) {
      blocks_.write_out_parts();
      evaluate_again(pieces);
      if (pieces.empty()) return;
    }
    if (reads_sources(blocks_.left)) {
      cut_finer(pieces);
      evaluate_again(pieces);
      if (pieces.empty()) return;
    }
    batch_.compile(blocks_.left, blocks_.kept, most_samples, *sources_);
    surfaces_.clear();
    ends_.clear();
    // Blocks at the same depth are sampled together.
    for (size_t n = 0; n < pieces.size();) {
      const int64_t depth = pieces[n].lo[0];
      rays_.clear();
      for (; n < pieces.size() && pieces[n].lo[0] == depth; ++n) list_open(pieces[n]);
      each_batch(steps_together, [&](std::span<const Ray> rays) { find_hits(rays); });
    }
    if (!surfaces_.empty()) refine(surfaces_, Scene::inside);
    if (!ends_.empty()) refine(ends_, Scene::opaque);
  }

  void cut_finer(std::vector<TileBox>& pieces) {
    std::vector<TileBox> finer;
    for (const TileBox& piece : pieces)
      for (const TileBox& part : cut(piece, fine_block))
        if (!is_hidden(part)) finer.push_back(part);
    pieces = std::move(finer);
  }

  // Evaluates the shortened program again.
  void evaluate_again(std::vector<TileBox>& pieces) {
    std::swap(queried_, blocks_.left);
    keep_met(queried_, pieces);
  }

  // Keeps the pieces that may contain something; evaluates blocks_, and shortens its program for these pieces.
  void keep_met(const program::Program& program, std::vector<TileBox>& pieces) {
    blocks_.ask(program, fine_boxes(pieces), *sources_);
    met_.clear();
    for (size_t n = 0; n < pieces.size(); ++n) {
      if (blocks_.intervals.output(Scene::inside, n) == Interval(0)) continue;
      pieces[met_.size()] = pieces[n];
      met_.push_back(n);
    }
    pieces.resize(met_.size());
    if (!pieces.empty()) blocks_.shorten(met_);
  }

  // Notes the samples after which rays enter a surface, to refine them later, and absorbs light at each sample.
  void find_hits(std::span<const Ray> rays) {
    constexpr auto width = static_cast<size_t>(steps_together);
    batch_.evaluate(rays, fine_per_step, width, scene_.is_translucent);
    for (size_t n = 0; n < rays.size(); ++n) {
      const Ray& ray = rays[n];
      for (size_t i = 0; (i = batch_.first_set(Scene::inside, n, i)) < width; ++i) {
        const Ray before{ray.column, ray.row, ray.first + (static_cast<int64_t>(i) - 1) * fine_per_step};
        const float depth = batch_.depth(n, i);
        if (hit(ray).surface == RayHit::none) {
          surfaces_.push_back(before);
          hit(ray).surface = depth;
        }
        const bool is_end = !scene_.is_translucent || batch_.value(Scene::opaque, n, i) != 0;
        if (is_end) end(ray, depth);
        if (is_end && scene_.is_translucent) ends_.push_back(before);
        if (is_end || absorb(ray, batch_.value(Scene::opacity, n, i), 1, depth, batch_.colour(n, i))) break;
      }
    }
  }

  // Absorbs light over some steps. Returns true if none is left.
  bool absorb(const Ray& ray, float opacity, int64_t steps, float depth, const Colour& here) {
    RayHit& found = hit(ray);
    const float through = clarity_.through(opacity, steps);
    const float taken = found.passes * (1 - through);
    found.veil.red += taken * here.red;
    found.veil.green += taken * here.green;
    found.veil.blue += taken * here.blue;
    found.passes *= through;
    if (found.passes > dark) return false;
    end(ray, depth);
    found.at_end = here;
    return true;
  }

  // Moves rays from a place up to a step before a surface to the fine step behind it. An opaque surface also ends its
  // ray.
  void refine(std::vector<Ray>& rays, Scene::Output what) {
    for (int64_t half = fine_per_step / 2; half > 0; half /= 2) {
      rays_ = rays;
      for (Ray& ray : rays_) ray.first += half;
      batch_.evaluate(rays_, 1, 1, what != Scene::inside);
      for (size_t n = 0; n < rays.size(); ++n)
        if (batch_.value(what, n, 0) == 0) rays[n].first += half;
    }
    const bool is_end = what == Scene::opaque || !scene_.is_translucent;
    for (Ray& ray : rays) {
      ++ray.first;
      RayHit& found = hit(ray);
      const float depth = static_cast<float>(steps_.depth(ray.first));
      if (what == Scene::inside) found.surface = depth;
      if (!is_end) continue;
      found.end = depth;
      colours_.note(ray);
      if (band_ends_.found)
        band_ends_.found->fine[band_ends_.place(ray.column, ray.row)] = static_cast<int32_t>(ray.first);
    }
  }

  const Scene& scene_;
  const Programs& programs_;
  const RaySteps& steps_;
  const Clarity& clarity_;
  const std::function<bool()>& is_stopped_;
  const BandEnds& band_ends_;
  const StripSources* sources_ = nullptr;
  RayBatch batch_;
  EndColours colours_;
  std::deque<QueriedTiles> levels_;
  QueriedTiles blocks_;
  RayBand& hits_;
  std::vector<size_t> met_;                   // numbers of the evaluated blocks to keep
  program::Program queried_;                  // the program of blocks_ while it is evaluated again
  int64_t first_column_ = 0, first_row_ = 0;  // first column and row of the current tile
  std::array<uint8_t, largest_tile * largest_tile> is_open_{};
  std::vector<Ray> rays_, surfaces_, ends_;
};

// Idle casters; as many are made as threads request at the same time.
class RayCasters {
 public:
  explicit RayCasters(std::function<std::unique_ptr<RayCaster>()> make) : make_(std::move(make)) {}
  template <class Use>
  void with_one(Use use) {
    std::unique_ptr<RayCaster> caster = take();
    use(*caster);
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(caster));
  }

 private:
  std::unique_ptr<RayCaster> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return make_();
    std::unique_ptr<RayCaster> caster = std::move(idle_.back());
    idle_.pop_back();
    return caster;
  }

  std::function<std::unique_ptr<RayCaster>()> make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<RayCaster>> idle_;
};

// Places the sources of a program, and drops the outputs that only serve that purpose.
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

int64_t tiles_along(int64_t rays, int64_t edge) { return (rays + edge - 1) / edge; }

// Returns the size of tiles, which are smaller in small pictures. It does not depend on the number of threads, because
// sums over translucent material depend on it.
int64_t tile_edge(int64_t columns, int64_t rows) {
  int64_t edge = largest_tile;
  while (edge > smallest_tile && tiles_along(columns, edge) * tiles_along(rows, edge) < enough_tiles) edge /= 2;
  return edge;
}

}  // namespace

namespace {

// Returns the key of a band's ends, or null if they are not to be kept.
std::optional<Hash> key_of_band(const program::Program& shape, const Scene& scene, const RaySteps& steps, int64_t begin,
                                int64_t end) {
  if (steps.steps >= std::numeric_limits<int32_t>::max() / fine_per_step) return std::nullopt;
  const auto number = [](int64_t whole) { return static_cast<double>(whole); };
  const Film& film = steps.film;
  const double where[] = {scene.eye_mm,       scene.near_mm,       scene.far_mm,  number(begin),       number(end),
                          number(film.width), number(film.height), film.pixel_mm, number(film.samples)};
  return key_of_ends(shape, where);
}

}  // namespace

RayBand cast_rays(const Scene& scene, const Film& film, int64_t begin, int64_t end, int threads,
                  const std::function<bool()>& is_stopped, KnownEnds* known) {
  if (eval::kernel_sets().empty()) throw Error("pictures need a processor with hardware multiply-add");
  const RaySteps steps(scene, film);
  const Clarity clarity(RaySteps::length_of(film) / scene.clarity_mm);
  program::Program reference = scene.program;
  const auto samplers = place_sources(reference, scene, steps);
  const Programs programs(scene, reference);
  RayBand band(begin, end, film.width);
  BandEnds ends{begin, film.width};
  std::optional<Hash> key;
  if (known && !scene.is_translucent) {
    program::Program shape = shape_alone(programs.traversal);
    key = key_of_band(shape, scene, steps, begin, end);
    if (key) ends.known = known->find(*key);
    if (key && !ends.known)
      ends.found = std::make_shared<RayEnds>(RayEnds{std::move(shape), std::vector(band.all().size(), RayEnds::none)});
  }
  RayCasters casters(
      [&] { return std::make_unique<RayCaster>(scene, programs, steps, clarity, is_stopped, ends, band); });
  const int64_t edge = tile_edge(film.width, end - begin);
  const int64_t across = tiles_along(film.width, edge), down = tiles_along(end - begin, edge);
  run_parallel(static_cast<size_t>(across * down), threads, [&](size_t n) {
    if (is_stopped()) return;
    const int64_t column = static_cast<int64_t>(n) % across * edge,
                  row = begin + static_cast<int64_t>(n) / across * edge;
    const TileBox tile{{0, column, row}, {steps.steps, std::min(column + edge, film.width), std::min(row + edge, end)}};
    TileBox strip = tile;
    strip.hi[0] = steps.steps * fine_per_step;
    const StripSources sources(samplers, strip);
    casters.with_one([&](RayCaster& caster) { caster.cast(tile, sources); });
  });
  if (ends.found && !is_stopped()) known->keep(*key, std::move(ends.found));
  return band;
}

}  // namespace ombre::render
