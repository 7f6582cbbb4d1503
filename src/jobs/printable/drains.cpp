#include "jobs/printable/drains.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "jobs/printable/flag_pieces.h"
#include "jobs/printable/held_regions.h"

namespace ombre::compile {
namespace {

constexpr size_t most_places = 64;  // of each hollow, whose volumes are compared

// A voxel's mark: solid, outside, or the number of its hollow, from 0 on.
constexpr int32_t solid = -2, outside = -1;

// A straight line of solid voxels between a hollow and the void outside; coordinates are those of its first voxel, with
// the margin of flags.
struct Place {
  double length_mm = 0, off_middle_mm = 0;
  int axis = 0;
  int64_t k = 0, j = 0, i = 0, length = 0;

  auto order() const { return std::tie(length_mm, off_middle_mm, axis, k, j, i); }
  bool operator<(const Place& other) const { return order() < other.order(); }
};

struct Hollow {
  Vec3 middle_mm;
  std::set<Place> places;
};

// Voxels as runs in rows of layers, which do not overlap.
using RowRuns = std::map<std::pair<int64_t, int64_t>, std::vector<std::pair<int64_t, int64_t>>>;

// Returns the voxels that a ball passes whose middle goes along a line.
RowRuns swept(const Offsets& ball, const Place& place) {
  RowRuns runs;
  for (int64_t n = 0; n < place.length; ++n) {
    const int64_t i = place.i + (place.axis == 0 ? n : 0), j = place.j + (place.axis == 1 ? n : 0),
                  k = place.k + (place.axis == 2 ? n : 0);
    for (const OffsetSpan& span : ball.spans)
      runs[{k + span.k, j + span.j}].emplace_back(i + span.from, i + span.to + 1);
  }
  for (auto& [row, spans] : runs) {
    std::ranges::sort(spans);
    std::vector<std::pair<int64_t, int64_t>> joined;
    for (const auto& span : spans)
      if (!joined.empty() && span.first <= joined.back().second)
        joined.back().second = std::max(joined.back().second, span.second);
      else
        joined.push_back(span);
    spans = std::move(joined);
  }
  return runs;
}

class DrainSearch {
 public:
  DrainSearch(const Plan& plan, const DrainRules& rules, const CheckRun& run)
      : plan_(plan),
        rules_(rules),
        run_(run),
        voxel_mm_(plan.request.lattice.voxel_mm()),
        ball_(ball_offsets(rules.diameter_mm, voxel_mm_)) {
    if (rules.support != 0) shape_.materials = {rules.support};
  }

  Drains run() {
    find_hollows();
    Drains drains;
    if (hollows_.empty()) return drains;
    find_places();
    compare_volumes();
    for (const Hollow& hollow : hollows_) ++(hollow.places.empty() ? drains.left : drains.opened);
    cut(drains.changes);
    return drains;
  }

 private:
  void each_solid_layer(const std::function<void(int64_t k, const BitLayer& layer)>& take) const {
    each_window(plan_, shape_, run_, [&](const SolidLayers& layers, int64_t begin, int64_t end) {
      const BitLayers flags = solid_without(layers, rules_.support, begin, end);
      for (int64_t k = begin; k < end; ++k) take(k, flags.at(k));
    });
  }

  void find_hollows() {
    const auto take = [this](const FlagPiece& piece) {
      if (!HeldRegionFinder::is_enclosed(piece)) return false;
      Vec3 middle;
      for (size_t axis = 0; axis < 3; ++axis)
        middle[static_cast<int>(axis)] =
            static_cast<double>(piece.box.lo[axis] + piece.box.hi[axis]) / 2 * voxel_mm_[static_cast<int>(axis)];
      pieces_.push_back({piece, middle});
      return false;
    };
    FlagPieceFinder finder(take, UINT64_MAX);
    each_solid_layer([&](int64_t k, const BitLayer& layer) {
      BitLayer open = layer;
      open.invert();
      finder.add(k, open);
    });
    finder.finish();
    // The order in which pieces end does not depend on how layers were cut into windows.
    for (size_t n = 0; n < pieces_.size(); ++n) {
      hollows_.push_back({pieces_[n].second, {}});
      for (const FlagRun& at : pieces_[n].first.runs) runs_[at.k].push_back({at, static_cast<int32_t>(n)});
    }
    pieces_.clear();
  }

  // Returns what each voxel of a layer is.
  std::vector<int32_t> kinds_of(int64_t k, const BitLayer& layer) const {
    std::vector<int32_t> kinds(static_cast<size_t>(layer.width() * layer.height()), outside);
    for (int64_t j = 0; j < layer.height(); ++j)
      each_run(layer, j, [&](int64_t begin, int64_t end) {
        std::fill(kinds.begin() + j * layer.width() + begin, kinds.begin() + j * layer.width() + end, solid);
      });
    if (const auto found = runs_.find(k); found != runs_.end())
      for (const auto& [at, hollow] : found->second)
        std::fill(kinds.begin() + at.j * layer.width() + at.begin, kinds.begin() + at.j * layer.width() + at.end,
                  hollow);
    return kinds;
  }

  // The last void along a line, and the solid voxels since then.
  struct Trace {
    int32_t last = solid;  // solid: no void yet
    int64_t length = 0;
  };

  // Follows a line to its next voxel, and keeps the place if a wall of a hollow ends there.
  void follow(Trace& trace, int32_t kind, int axis, const std::array<int64_t, 3>& at) {
    if (kind == solid) {
      ++trace.length;
      return;
    }
    const bool is_wall = trace.length > 0 && trace.last != solid && (trace.last == outside) != (kind == outside);
    if (is_wall) keep(std::max(trace.last, kind), axis, at, trace.length);
    trace = {kind, 0};
  }

  void keep(int32_t of, int axis, std::array<int64_t, 3> at, int64_t length) {
    at[static_cast<size_t>(axis)] -= length;
    Hollow& hollow = hollows_[static_cast<size_t>(of)];
    double squared = 0;
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      const double off =
          (static_cast<double>(at[static_cast<size_t>(other)]) + 0.5) * voxel_mm_[other] - hollow.middle_mm[other];
      squared += off * off;
    }
    hollow.places.insert(
        {static_cast<double>(length) * voxel_mm_[axis], std::sqrt(squared), axis, at[2], at[1], at[0], length});
    if (hollow.places.size() > most_places) hollow.places.erase(std::prev(hollow.places.end()));
  }

  void find_places() {
    std::vector<Trace> upwards;
    each_solid_layer([&](int64_t k, const BitLayer& layer) {
      const std::vector<int32_t> kinds = kinds_of(k, layer);
      const int64_t width = layer.width(), height = layer.height();
      const auto kind = [&](int64_t i, int64_t j) { return kinds[static_cast<size_t>(j * width + i)]; };
      upwards.resize(kinds.size());
      for (int64_t j = 0; j < height; ++j) {
        Trace along;
        for (int64_t i = 0; i < width; ++i) {
          follow(along, kind(i, j), 0, {i, j, k});
          follow(upwards[static_cast<size_t>(j * width + i)], kind(i, j), 2, {i, j, k});
        }
      }
      for (int64_t i = 0; i < width; ++i) {
        Trace along;
        for (int64_t j = 0; j < height; ++j) follow(along, kind(i, j), 1, {i, j, k});
      }
    });
  }

  // Leaves each hollow the place whose channel removes least.
  void compare_volumes() {
    std::vector<std::pair<RowRuns, uint64_t>> channels;
    for (const Hollow& hollow : hollows_)
      for (const Place& place : hollow.places) channels.push_back({swept(ball_, place), 0});
    each_solid_layer([&](int64_t k, const BitLayer& layer) {
      for (auto& [runs, volume] : channels)
        each_run_in(runs, k, layer, [&, &sum = volume](int64_t j, int64_t begin, int64_t end) {
          for (int64_t i = begin; i < end; ++i) sum += layer.get(i, j) ? 1 : 0;
        });
    });
    size_t n = 0;
    for (Hollow& hollow : hollows_) {
      std::optional<std::pair<uint64_t, Place>> best;
      for (const Place& place : hollow.places) {
        const uint64_t volume = channels[n++].second;
        if (!best || volume < best->first) best = {volume, place};
      }
      hollow.places.clear();
      if (best) hollow.places.insert(best->second);
    }
  }

  // Calls `take` with the runs of layer k within the layer.
  template <class Take>
  static void each_run_in(const RowRuns& runs, int64_t k, const BitLayer& layer, const Take& take) {
    for (auto at = runs.lower_bound({k, 0}); at != runs.end() && at->first.first == k; ++at) {
      const int64_t j = at->first.second;
      if (j >= layer.height()) break;
      for (const auto& [begin, end] : at->second) take(j, std::max<int64_t>(0, begin), std::min(layer.width(), end));
    }
  }

  void cut(VoxelChanges& changes) const {
    std::vector<RowRuns> channels;
    for (const Hollow& hollow : hollows_)
      for (const Place& place : hollow.places) channels.push_back(swept(ball_, place));
    each_solid_layer([&](int64_t k, const BitLayer& layer) {
      BitLayer flags(layer.width(), layer.height());
      for (const RowRuns& runs : channels)
        each_run_in(runs, k, layer, [&](int64_t j, int64_t begin, int64_t end) {
          if (begin < end) flags.set(j, begin, end);
        });
      flags &= layer;
      changes.add(k, flags, shape_.margin(), 0);
    });
  }

  const Plan& plan_;
  const DrainRules& rules_;
  const CheckRun& run_;
  Vec3 voxel_mm_;
  Offsets ball_;
  WindowShape shape_;
  std::vector<std::pair<FlagPiece, Vec3>> pieces_;
  std::vector<Hollow> hollows_;
  std::map<int64_t, std::vector<std::pair<FlagRun, int32_t>>> runs_;  // of hollows, by layer
};

}  // namespace

Drains open_hollows(const Plan& plan, const DrainRules& rules, const CheckRun& run) {
  return DrainSearch(plan, rules, run).run();
}

}  // namespace ombre::compile
