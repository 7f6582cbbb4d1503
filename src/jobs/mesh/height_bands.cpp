#include "jobs/mesh/height_bands.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "formats/slicers/slicer_settings.h"
#include "jobs/mesh/slicer_bodies.h"
#include "questions/build.h"
#include "questions/region_request.h"
#include "questions/sampler.h"

namespace ombre::jobs {
namespace {

// Samples along each side of a plane, and planes.
constexpr int samples_across = 24, planes = 400;

// The values of attributes at a height, in their order.
struct Plane {
  double z = 0;
  std::vector<double> values;
};

class HeightSurvey {
 public:
  HeightSurvey(const compile::Loaded& loaded, const compile::MeshChoices& choices, Diagnostics& diagnostics,
               const StopFlag* stop)
      : loaded_(loaded),
        choices_(choices),
        diagnostics_(diagnostics),
        stop_(stop),
        names_(split(choices.regions.by, ',')) {
    for (std::string& name : names_) name = std::string(trim(name));
  }

  std::optional<std::vector<formats::HeightRange>> ranges() {
    if (!have_settings()) return std::nullopt;
    const auto box = compile::design_box(loaded_.design, diagnostics_);
    if (!box || !sample(*box)) return std::nullopt;
    take_borders();
    return cut(*box);
  }

 private:
  void report(const std::string& message, const Phrase& hint) {
    diagnostics_.error(Code::option, {loaded_.source, 0, 0}, message, hint);
  }

  bool have_settings() {
    for (const std::string& name : names_) {
      const formats::SlicerKey* row = formats::slicer_key_of(name);
      if (row && !key_of(*row).empty()) continue;
      report("ranges of heights of " + std::string(formats::program_of(choices_.flavour)) + " have no setting for \"" +
                 name + '"',
             "leave " + spelled::option("--height-ranges") + " out");
      return false;
    }
    return true;
  }

  std::string key_of(const formats::SlicerKey& row) const {
    return formats::key_in(choices_.flavour, row.prusa.empty() ? row.bambu : row.prusa);
  }

  bool sample(const Box& box) {
    compile::SampleQuery query;
    query.inside = true;
    query.attributes = names_;
    const auto sampler = compile::Sampler::build(loaded_.design, query, diagnostics_);
    if (!sampler) return false;
    for (int n = 0; n < planes; ++n)
      if (!sample_plane(*sampler, box, box.lo.z + box.size().z * (n + 0.5) / planes)) return false;
    return !planes_.empty();
  }

  // Adds a plane, unless nothing is inside. Returns false, and reports it, if a value varies across the plane.
  bool sample_plane(const compile::Sampler& sampler, const Box& box, double z) {
    std::vector<Vec3> points;
    for (int j = 0; j < samples_across; ++j)
      for (int i = 0; i < samples_across; ++i)
        points.push_back({box.lo.x + box.size().x * (i + 0.5) / samples_across,
                          box.lo.y + box.size().y * (j + 0.5) / samples_across, z});
    std::vector<std::vector<double>> columns(names_.size() + 1, std::vector<double>(points.size()));
    std::vector<double*> to;
    for (auto& column : columns) to.push_back(column.data());
    sampler.sample(points, to, choices_.work.threads, stop_);
    Plane plane{z, {}};
    for (size_t n = 0; n < names_.size(); ++n) {
      std::optional<size_t> first;
      for (size_t p = 0; p < points.size(); ++p) {
        if (columns[0][p] <= 0) continue;
        if (!first) first = p;
        const double there = columns[n + 1][*first], here = columns[n + 1][p];
        if (std::abs(here - there) > 1e-6 * std::max(1.0, std::abs(there)))
          return refuse(names_[n], points[*first], there, points[p], here);
      }
      if (!first) return true;
      plane.values.push_back(columns[n + 1][*first]);
    }
    planes_.push_back(std::move(plane));
    return true;
  }

  bool refuse(const std::string& name, Vec3 first, double there, Vec3 second, double here) {
    const auto place = [](Vec3 p) {
      return "(" + format_rounded(p.x, 4) + ", " + format_rounded(p.y, 4) + ", " + format_rounded(p.z, 4) + ")";
    };
    report('"' + name + "\" does not vary by height alone: it is " + format_rounded(there, 4) + " at " + place(first) +
               " and " + format_rounded(here, 4) + " at " + place(second),
           "leave " + spelled::option("--height-ranges") + " out: bands become bodies");
    return false;
  }

  void take_borders() {
    for (size_t n = 0; n < names_.size(); ++n) {
      Interval range(planes_[0].values[n]);
      for (const Plane& plane : planes_) range = hull(range, plane.values[n]);
      ends_.push_back(range);
      borders_.push_back(choices_.regions.borders);
      const int bands = choices_.regions.borders.empty() ? bands_over(range, n) : 0;
      for (int band = 1; band < bands; ++band)
        borders_.back().push_back(range.lo + (range.hi - range.lo) * band / bands);
    }
  }

  int bands_over(Interval range, size_t attribute) const {
    constexpr int usual_bands = 4;
    const double within = choices_.regions.within_of(attribute);
    if (within > 0) return compile::fewest_bands(range, within);
    return choices_.regions.bands > 0 ? choices_.regions.bands : usual_bands;
  }

  size_t band_of(size_t attribute, double value) const {
    return static_cast<size_t>(std::ranges::upper_bound(borders_[attribute], value) - borders_[attribute].begin());
  }

  std::vector<size_t> bands_of(const Plane& plane) const {
    std::vector<size_t> bands;
    for (size_t n = 0; n < names_.size(); ++n) bands.push_back(band_of(n, plane.values[n]));
    return bands;
  }

  // Returns the height between two planes at which the first value that changes its band crosses the border.
  double crossing(const Plane& below, const Plane& above) const {
    for (size_t n = 0; n < names_.size(); ++n) {
      const double from = below.values[n], to = above.values[n];
      const size_t a = band_of(n, from), b = band_of(n, to);
      if (a == b) continue;
      const double border = borders_[n][b > a ? a : a - 1];
      return below.z + (above.z - below.z) * std::clamp((border - from) / (to - from), 0.0, 1.0);
    }
    return (below.z + above.z) / 2;
  }

  formats::Settings settings_of(const std::vector<size_t>& bands) const {
    formats::Settings settings;
    for (size_t n = 0; n < names_.size(); ++n) {
      const std::vector<double>& borders = borders_[n];
      const double lo = bands[n] == 0 ? ends_[n].lo : borders[bands[n] - 1];
      const double hi = bands[n] == borders.size() ? ends_[n].hi : borders[bands[n]];
      const std::string key = key_of(*formats::slicer_key_of(names_[n]));
      settings.emplace_back(key, setting_of_band(names_[n], key, choices_.flavour, (lo + hi) / 2));
    }
    return settings;
  }

  std::vector<formats::HeightRange> cut(const Box& box) const {
    std::vector<formats::HeightRange> ranges;
    double from = 0;
    for (size_t n = 0; n < planes_.size(); ++n) {
      const std::vector<size_t> bands = bands_of(planes_[n]);
      if (n + 1 < planes_.size() && bands_of(planes_[n + 1]) == bands) continue;
      const double end = n + 1 < planes_.size() ? crossing(planes_[n], planes_[n + 1]) : box.hi.z;
      const double to = parse_number(format_rounded(end - box.lo.z, 6)).value_or(end - box.lo.z);
      ranges.push_back({from, to, settings_of(bands)});
      from = to;
    }
    return ranges;
  }

  const compile::Loaded& loaded_;
  const compile::MeshChoices& choices_;
  Diagnostics& diagnostics_;
  const StopFlag* stop_;
  std::vector<std::string> names_;
  std::vector<Plane> planes_;
  std::vector<std::vector<double>> borders_;  // of each attribute
  std::vector<Interval> ends_;
};

}  // namespace

std::optional<std::vector<formats::HeightRange>> height_bands(const compile::Loaded& loaded,
                                                              const compile::MeshChoices& choices,
                                                              Diagnostics& diagnostics, const StopFlag* stop) {
  return HeightSurvey(loaded, choices, diagnostics, stop).ranges();
}

}  // namespace ombre::jobs
