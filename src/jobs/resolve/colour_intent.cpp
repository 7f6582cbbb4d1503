#include "jobs/resolve/colour_intent.h"

#include <algorithm>
#include <numeric>

#include "ink/ink_table.h"
#include "load/ink_step.h"

namespace ombre::compile {
namespace {

using calibration::Calibration;
using Kind = Sampler::Column::Kind;
using Columns = std::vector<Sampler::Column>;

std::optional<size_t> column_called(const Columns& columns, Kind kind, const std::string& name) {
  const auto found = std::ranges::find_if(
      columns, [&](const Sampler::Column& column) { return column.kind == kind && column.name == name; });
  return found == columns.end() ? std::nullopt : std::optional(static_cast<size_t>(found - columns.begin()));
}

// Returns the columns of all materials of a list; those that no voxel has have none.
std::vector<size_t> fractions_of(const Columns& columns, const std::vector<std::string>& names,
                                 const design::MaterialTable& materials) {
  std::vector<size_t> found;
  for (const std::string& name : names)
    if (const design::Material* material = materials.find(name))
      if (const auto column = column_called(columns, Kind::fraction, material->name)) found.push_back(*column);
  return found;
}

double sum_of(const std::vector<size_t>& columns, const std::vector<std::vector<double>>& values, size_t point) {
  double sum = 0;
  for (const size_t column : columns) sum += values[column][point];
  return sum;
}

}  // namespace

std::optional<ColourSurvey> ColourSurvey::of(const Calibration& calibration, const Columns& columns,
                                             const design::MaterialTable& materials) {
  ColourSurvey survey;
  survey.calibration_ = &calibration;
  const bool has_alpha = calibration.property == calibration::colour_with_alpha;
  for (size_t n = 0; n < 3; ++n) {
    const auto column = column_called(columns, Kind::attribute,
                                      calibration.property + '.' + std::string(1, (has_alpha ? "rgb" : "xyz")[n]));
    if (!column) return std::nullopt;
    survey.colour_[n] = *column;
  }
  for (const calibration::Input& input : calibration.inputs)
    survey.inks_.push_back(fractions_of(columns, input.materials, materials));
  survey.rest_ = fractions_of(columns, calibration.rest, materials);
  survey.clear_ = fractions_of(columns, calibration.inks->clear, materials);
  survey.profile_ = profile_of(*calibration.inks);
  survey.intent_.attribute = calibration.property;
  survey.intent_.by = calibration.name;
  survey.intent_.intent = ink::intent_names()[static_cast<size_t>(calibration.inks->intent)];
  return survey;
}

void ColourSurvey::take(const std::vector<std::vector<double>>& values, const std::vector<Vec3>& places, int threads,
                        std::vector<uint8_t>& flags) {
  std::vector<Vec3> srgb, kept_places;
  std::vector<double> shares;
  std::vector<size_t> points;
  for (size_t n = 0; n < places.size(); ++n) {
    if (flags[n] == 0) continue;
    const double clear = sum_of(clear_, values, n), opaque = 1 - clear;
    double total = clear + sum_of(rest_, values, n);
    std::vector<double> of_point;
    for (const auto& ink : inks_) of_point.push_back(sum_of(ink, values, n));
    total += std::accumulate(of_point.begin(), of_point.end(), 0.0);
    if (!(total > 1 - 1e-6)) intent_.knows_materials = false;
    if (!(total > 1 - 1e-6) || opaque < 1e-6) continue;  // no ink is seen
    for (const double share : of_point) shares.push_back(share / opaque);
    Vec3 colour;
    for (int axis = 0; axis < 3; ++axis)
      colour[axis] = std::clamp(values[colour_[static_cast<size_t>(axis)]][n], 0.0, 1.0);
    srgb.push_back(colour);
    kept_places.push_back(places[n]);
    points.push_back(n);
  }
  if (srgb.empty()) return;
  compare(srgb, shares, kept_places, threads);

  // A colour that the inks show comes back by way of their shares.
  const size_t inks = inks_.size();
  std::vector<double> nearest = shares_of(profile_, {ink::Intent::relative, false}, srgb, threads);
  ink::divide_above_one(nearest, inks);
  const auto reached = colours_of(profile_, ink::Intent::relative, nearest, threads);
  for (size_t n = 0; n < srgb.size(); ++n) {
    if (ink::ciede2000(ink::lab_of_srgb(srgb[n]), reached[n]) <= gamut_tolerance) continue;
    flags[points[n]] = 2;
    ++out_of_gamut_;
  }
  const auto requested = shares_of(profile_, *calibration_->inks, srgb, threads);
  for (size_t n = 0; n < requested.size(); n += inks)
    if (std::accumulate(requested.begin() + static_cast<ptrdiff_t>(n),
                        requested.begin() + static_cast<ptrdiff_t>(n + inks), 0.0) > 1 + 1e-3)
      ++divided_;
}

void ColourSurvey::compare(const std::vector<Vec3>& srgb, const std::vector<double>& shares,
                           const std::vector<Vec3>& places, int threads) {
  const auto given = colours_of(profile_, calibration_->inks->intent, shares, threads);
  for (size_t n = 0; n < srgb.size(); ++n) {
    const ink::Lab wanted = ink::lab_of_srgb(srgb[n]);
    const double difference = ink::ciede2000(wanted, given[n]);
    sum_ += difference;
    differences_.push_back(static_cast<float>(difference));
    if (!(difference > intent_.worst) && intent_.points > 0) continue;
    intent_.worst = difference;
    intent_.worst_mm = places[n];
    intent_.worst_srgb = srgb[n];
    intent_.worst_wanted = wanted;
    intent_.worst_given = given[n];
    intent_.points = differences_.size();
  }
}

ColourIntent ColourSurvey::finished() {
  intent_.points = differences_.size();
  if (differences_.empty()) return intent_;
  const auto count = static_cast<double>(differences_.size());
  intent_.mean = sum_ / count;
  const auto at = differences_.begin() + static_cast<ptrdiff_t>((differences_.size() - 1) * 95 / 100);
  std::ranges::nth_element(differences_, at);
  intent_.most_of_95_percent = static_cast<double>(*at);
  intent_.share_out_of_gamut = static_cast<double>(out_of_gamut_) / count;
  intent_.share_divided = static_cast<double>(divided_) / count;
  return intent_;
}

}  // namespace ombre::compile
