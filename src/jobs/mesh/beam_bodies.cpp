#include "jobs/mesh/beam_bodies.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "questions/sampler.h"

namespace ombre::compile {
namespace {

// Gives points that agree within rounding one number.
class PointMerger {
 public:
  explicit PointMerger(double rounding_mm) : rounding_(rounding_mm) {}

  uint32_t add(Vec3 p) {
    const auto [x0, x1] = cells_around(p.x);
    const auto [y0, y1] = cells_around(p.y);
    const auto [z0, z1] = cells_around(p.z);
    for (int64_t z = z0; z <= z1; ++z)
      for (int64_t y = y0; y <= y1; ++y)
        for (int64_t x = x0; x <= x1; ++x)
          if (const auto known = find({x, y, z}, p)) return *known;
    const auto number = static_cast<uint32_t>(points_.size());
    points_.push_back(p);
    const auto [first, is_new] = first_.try_emplace({cell(p.x), cell(p.y), cell(p.z)}, number);
    next_.push_back(is_new ? none : first->second);
    first->second = number;
    return number;
  }

  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  static constexpr uint32_t none = UINT32_MAX;
  using Cell = std::array<int64_t, 3>;
  struct CellHash {
    size_t operator()(const Cell& c) const {
      uint64_t h = 0;
      for (const int64_t n : c) h = (h ^ static_cast<uint64_t>(n)) * 0x9E3779B97F4A7C15ull + (h >> 29);
      return h;
    }
  };

  // Cells are much wider than rounding, so that few points are near to several cells.
  int64_t cell(double x) const { return static_cast<int64_t>(std::floor(x / (1000 * rounding_))); }
  std::pair<int64_t, int64_t> cells_around(double x) const { return {cell(x - rounding_), cell(x + rounding_)}; }

  std::optional<uint32_t> find(const Cell& cell, Vec3 p) const {
    const auto first = first_.find(cell);
    if (first == first_.end()) return std::nullopt;
    for (uint32_t n = first->second; n != none; n = next_[n])
      if (length(points_[n] - p) <= rounding_) return n;
    return std::nullopt;
  }

  double rounding_;
  std::vector<Vec3> points_;
  std::vector<uint32_t> next_;  // another point of the same cell
  std::unordered_map<Cell, uint32_t, CellHash> first_;
};

double farthest_coordinate(const std::vector<nodes::StrutShape>& struts) {
  double farthest = 1;
  for (const nodes::StrutShape& strut : struts)
    for (const Vec3 p : {strut.start, strut.end})
      farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return farthest;
}

bool have_same_radius(const formats::Beam& beam) {
  return static_cast<float>(beam.radii[0]) == static_cast<float>(beam.radii[1]);
}

void leave_out_doubled(std::vector<formats::Beam>& beams) {
  const auto key = [&](uint32_t index) {
    const formats::Beam& beam = beams[index];
    const size_t low = beam.ends[0] < beam.ends[1] ? 0 : 1;
    return std::tuple(beam.ends[low], beam.ends[1 - low], static_cast<float>(beam.radii[low]),
                      static_cast<float>(beam.radii[1 - low]), beam.caps);
  };
  std::vector<uint32_t> order(beams.size());
  for (uint32_t n = 0; n < order.size(); ++n) order[n] = n;
  std::ranges::sort(order, [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  const auto is_double = [&](uint32_t a, uint32_t b) { return key(a) == key(b); };
  order.erase(std::unique(order.begin(), order.end(), is_double), order.end());
  std::ranges::sort(order);
  for (size_t n = 0; n < order.size(); ++n) beams[n] = beams[order[n]];
  beams.resize(order.size());
}

constexpr std::array<double, 5> places{0.5, 0.25, 0.75, 0, 1};  // places along an axis; the middle first, the ends last

// Samples fractions at places along beams.
class BeamSampler {
 public:
  static std::optional<BeamSampler> build(const design::Design& design, int threads, const StopFlag* stop,
                                          Diagnostics& diagnostics) {
    auto sampler = Sampler::build(design, {true, false, true, false, {}}, diagnostics);
    if (!sampler) return std::nullopt;
    return BeamSampler(std::move(*sampler), threads, stop);
  }

  // Samples only the beams from number `first` on.
  void sample(const BeamBody& body, size_t first, size_t count) {
    std::vector<Vec3> points;
    for (size_t n = first; n < first + count; ++n) {
      const auto [a, b] = body.beams[n].ends;
      const Vec3 start = body.vertices[a], along = body.vertices[b] - start;
      for (const double place : places) points.push_back(start + place * along);
    }
    values_.assign(sampler_.columns().size(), std::vector<double>(points.size()));
    std::vector<double*> columns;
    for (auto& column : values_) columns.push_back(column.data());
    sampler_.sample(points, columns, threads_, stop_);
  }

  size_t materials() const { return values_.size() - 1; }
  MaterialId id(size_t material) const { return sampler_.columns()[material + 1].material; }
  bool is_inside(size_t beam, size_t place) const { return values_[0][beam * places.size() + place] != 0; }
  double fraction(size_t beam, size_t place, size_t material) const {
    return values_[material + 1][beam * places.size() + place];
  }

  // Returns the first place that is inside; else the middle.
  size_t place_of(size_t beam) const {
    for (size_t place = 0; place < places.size(); ++place)
      if (is_inside(beam, place)) return place;
    return 0;
  }

  // Returns the material with the greatest fraction, the first of equal ones.
  size_t greatest(size_t beam, size_t place) const {
    size_t greatest = 0;
    for (size_t m = 1; m < materials(); ++m)
      if (fraction(beam, place, m) > fraction(beam, place, greatest)) greatest = m;
    return greatest;
  }

  bool is_graded(size_t beam) const {
    constexpr double least = 0.01;
    constexpr size_t start = places.size() - 2, end = places.size() - 1;
    if (!is_inside(beam, start) || !is_inside(beam, end)) return false;
    for (size_t m = 0; m < materials(); ++m)
      if (std::abs(fraction(beam, start, m) - fraction(beam, end, m)) > least) return true;
    return false;
  }

 private:
  BeamSampler(Sampler sampler, int threads, const StopFlag* stop)
      : sampler_(std::move(sampler)), threads_(threads), stop_(stop) {}

  Sampler sampler_;
  int threads_;
  const StopFlag* stop_;
  std::vector<std::vector<double>> values_;
};

// Mean of colours by fractions and volumes.
class MeanColour {
 public:
  void add(design::Rgba colour, double weight) {
    if (!(weight > 0)) return;
    for (size_t c = 0; c < 4; ++c) sums_[c] += weight * colour[c];
    sums_[4] += weight;
  }
  design::Rgba mean() const {
    design::Rgba colour{128, 128, 128, 255};
    for (size_t c = 0; c < 4 && sums_[4] > 0; ++c) colour[c] = static_cast<uint8_t>(std::lround(sums_[c] / sums_[4]));
    return colour;
  }

 private:
  std::array<double, 5> sums_{};
};

double volume_of(const BeamBody& body, const formats::Beam& beam) {
  const auto [r, s] = beam.radii;
  return length(body.vertices[beam.ends[1]] - body.vertices[beam.ends[0]]) * (r * r + r * s + s * s);
}

void leave_out_void(BeamBody& body) {
  constexpr MaterialId void_material = 0;
  size_t kept = 0;
  for (size_t n = 0; n < body.beams.size(); ++n) {
    if (body.materials[n] == void_material) continue;
    body.beams[kept] = body.beams[n];
    body.materials[kept++] = body.materials[n];
  }
  body.beams.resize(kept);
  body.materials.resize(kept);
}

}  // namespace

BeamBody beams_of(const BeamSet& set) {
  constexpr double rounding = 1e-9;
  PointMerger merger(rounding * farthest_coordinate(set.struts));
  BeamBody body;
  body.clipping = set.clipping;
  body.beams.reserve(set.struts.size());
  for (const nodes::StrutShape& strut : set.struts) {
    formats::Beam beam{{merger.add(strut.start), merger.add(strut.end)}, {strut.start_radius, strut.end_radius}, {}};
    beam.caps.fill(strut.has_flat_ends      ? formats::BeamCap::butt
                   : have_same_radius(beam) ? formats::BeamCap::sphere
                                            : formats::BeamCap::hemisphere);
    body.beams.push_back(beam);
  }
  body.vertices = merger.take_points();
  leave_out_doubled(body.beams);
  return body;
}

std::optional<size_t> add_materials(const design::Design& design, int threads, BeamBody& body, Diagnostics& diagnostics,
                                    const StopFlag* stop) {
  constexpr size_t at_once = size_t{1} << 18;
  auto sampler = BeamSampler::build(design, threads, stop, diagnostics);
  if (!sampler) return std::nullopt;
  size_t graded = 0;
  MeanColour colour;
  for (size_t first = 0; first < body.beams.size(); first += at_once) {
    const size_t count = std::min(at_once, body.beams.size() - first);
    sampler->sample(body, first, count);
    for (size_t n = 0; n < count; ++n) {
      const size_t place = sampler->place_of(n);
      body.materials.push_back(sampler->id(sampler->greatest(n, place)));
      graded += sampler->is_graded(n);
      const double volume = volume_of(body, body.beams[first + n]);
      for (size_t m = 0; m < sampler->materials(); ++m)
        if (sampler->id(m) != 0)
          colour.add(design.materials.all()[sampler->id(m)].colour, volume * sampler->fraction(n, place, m));
    }
  }
  body.colour = colour.mean();
  leave_out_void(body);
  return graded;
}

}  // namespace ombre::compile
