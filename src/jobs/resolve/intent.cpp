#include "jobs/resolve/intent.h"

#include <algorithm>
#include <cmath>

#include "base/math/math.h"
#include "design/attributes.h"
#include "load/ink_step.h"
#include "questions/design_stages.h"
#include "questions/question.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using calibration::Calibration;
using calibration::CalibrationPtr;
using Kind = Sampler::Column::Kind;

constexpr double most_points = 1e6;
constexpr size_t points_at_once = size_t{1} << 18;
constexpr double rounding = 1e-9;  // as a share of the ends of a reach

constexpr size_t no_column = static_cast<size_t>(-1);

using Values = std::vector<std::vector<double>>;  // of the sampler's columns

// The columns of the sampler that a calibration reads. The fraction of an input is that of all materials of its list.
struct ReadColumns {
  std::vector<std::vector<size_t>> inputs;  // no column for a usual value
  std::vector<size_t> rest;

  static double sum(const std::vector<size_t>& columns, const Values& values, size_t point) {
    double total = 0;
    for (const size_t column : columns) total += values[column][point];
    return total;
  }

  // Returns the inputs at a point, or nothing if it has other materials.
  std::optional<std::vector<double>> at(const Calibration& calibration, const Values& values, size_t point) const {
    std::vector<double> found = calibration.usual();
    double fractions = calibration.has_fractions() ? sum(rest, values, point) : 1;
    for (size_t n = 0; n < found.size(); ++n) {
      const bool is_fraction = calibration.inputs[n].is_fraction();
      if (is_fraction || !inputs[n].empty()) found[n] = sum(inputs[n], values, point);
      if (is_fraction) fractions += found[n];
    }
    return fractions > 1 - 1e-6 ? std::optional(found) : std::nullopt;
  }
};

// True if the calibration gives the attribute in the unit that it has in the design.
bool has_unit(const Calibration& calibration, const design::AttributeDeclaration& declared) {
  return declared.unit.empty() || declared.unit == calibration.unit;
}

bool is_within(double value, const Interval& reach) {
  return value >= reach.lo - rounding * std::abs(reach.lo) && value <= reach.hi + rounding * std::abs(reach.hi);
}

// An intent while it is summed.
struct Sum {
  Intent intent;
  size_t wanted = 0;           // a column of the design as it is written
  size_t setting = no_column;  // of a setting: a column of the resolved design
  CalibrationPtr by;
  ReadColumns columns;
  std::optional<Interval> reach;                    // of what is requested
  std::vector<std::pair<size_t, Interval>> places;  // of columns that say where in a reach what is requested lies
  uint64_t out_of_reach = 0;
  double spread = 0;
  double worst = -1;
  bool has_spread = true, is_known = true;

  bool is_reached(double value, const Values& values, size_t point) const {
    return (!reach || is_within(value, *reach)) && std::ranges::all_of(places, [&](const auto& place) {
             return is_within(values[place.first][point], place.second);
           });
  }

  // Returns false if the wanted value is out of reach.
  bool take(double requested, const Values& values, size_t point, const Vec3& place) {
    const bool is_there = is_reached(requested, values, point);
    if (!is_there) ++out_of_reach;
    intent.mean_wanted += requested;
    if (intent.is_setting) add(requested, values[setting][point], std::nullopt, place);
    if (!by || !is_known) return is_there;
    const auto at = columns.at(*by, values, point);
    is_known = at.has_value();
    if (at) add(requested, by->value(*at), by->spread(*at), place);
    return is_there;
  }

  void add(double requested, double given, const std::optional<double>& expected, const Vec3& place) {
    const double miss = std::abs(given - requested);
    intent.mean_given += given;
    intent.mean_miss += miss;
    has_spread = has_spread && expected;
    spread += expected.value_or(0);
    if (!(miss > worst)) return;
    worst = miss;
    intent.worst_wanted = requested;
    intent.worst_given = given;
    intent.worst_mm = place;
  }

  Intent finished(uint64_t points) {
    const auto count = static_cast<double>(std::max<uint64_t>(points, 1));
    intent.mean_wanted /= count;
    intent.mean_given /= count;
    intent.mean_miss /= count;
    if (reach || !places.empty()) intent.share_out_of_reach = static_cast<double>(out_of_reach) / count;
    if (!is_known) intent.by.clear();  // some of the part has other materials
    if (has_spread && by && is_known) intent.spread = spread / count;
    return intent;
  }
};

class IntentSurvey {
 public:
  IntentSurvey(const design::Design& design, const IntentQuery& query, const voxel::Lattice& lattice)
      : design_as_written_(design), query_(query), design_(query.resolution.loaded->design) {
    report_.lattice = lattice;
  }

  std::optional<IntentReport> run(Diagnostics& diagnostics) {
    const auto requested = sampler_of(design_as_written_, false, diagnostics);
    const auto sampler = requested ? sampler_of(design_, true, diagnostics) : std::nullopt;
    if (!sampler) return std::nullopt;
    requested_columns_ = requested->columns();
    columns_ = sampler->columns();
    add_sums();
    add_colours();
    sample_all(*requested, *sampler);
    for (Sum& sum : sums_) report_.intents.push_back(sum.finished(report_.points));
    for (ColourSurvey& survey : colours_) report_.colours.push_back(survey.finished());
    return std::move(report_);
  }

 private:
  std::optional<Sampler> sampler_of(const design::Design& design, bool with_fractions, Diagnostics& diagnostics) const {
    const design::Design staged =
        with_stages(design::for_lattice(design, {report_.lattice.origin, report_.lattice.pitch}), query_.loan);
    SampleQuery samples;
    samples.inside = true;
    samples.fractions = with_fractions;
    for (const design::AttributeDeclaration& declared : declared_attributes(design))
      if (declared.type == design::ValueType::number || is_colour(declared))
        std::ranges::copy(parts_of(declared), std::back_inserter(samples.attributes));
    return Sampler::build(staged, samples, diagnostics);
  }

  static size_t column_among(const std::vector<Sampler::Column>& columns, Kind kind, const std::string& name) {
    const auto found = std::ranges::find_if(
        columns, [&](const Sampler::Column& column) { return column.kind == kind && column.name == name; });
    return found == columns.end() ? no_column : static_cast<size_t>(found - columns.begin());
  }
  size_t column(Kind kind, const std::string& name) const { return column_among(columns_, kind, name); }

  bool has_fractions() const {
    return names_materials(design_as_written_) ||
           std::ranges::any_of(query_.resolution.steps,
                               [](const ResolvedStep& step) { return step.step.to() == calibration::fractions; });
  }

  // Returns the columns of all materials of a list. One that no voxel can have has none.
  std::vector<size_t> columns_of(const std::vector<std::string>& materials) const {
    std::vector<size_t> found;
    for (const std::string& name : materials)
      if (const design::Material* material = design_.materials.find(name))
        if (const size_t its = column(Kind::fraction, material->name); its != no_column) found.push_back(its);
    return found;
  }

  // Returns the columns that the calibration reads, or nothing if the design does not have them all.
  std::optional<ReadColumns> columns_of(const Calibration& calibration, bool knows_fractions) const {
    if (calibration.has_fractions() && !knows_fractions) return std::nullopt;
    ReadColumns columns{{}, columns_of(calibration.rest)};
    for (const calibration::Input& input : calibration.inputs) {
      if (input.is_fraction()) {
        columns.inputs.push_back(columns_of(input.materials));
        continue;
      }
      const size_t attribute = column(Kind::attribute, input.attribute);
      if (attribute == no_column && !input.usual) return std::nullopt;
      columns.inputs.emplace_back();
      if (attribute != no_column) columns.inputs.back().push_back(attribute);
    }
    return columns;
  }

  void add_sums() {
    const bool knows_fractions = has_fractions();
    for (const design::AttributeDeclaration& declared : declared_attributes(design_as_written_)) {
      if (declared.type != design::ValueType::number) continue;
      const size_t first = sums_.size();
      Sum sum;
      sum.intent.attribute = declared.name;
      sum.intent.unit = declared.unit;
      sum.wanted = column_among(requested_columns_, Kind::attribute, declared.name);
      add_reaches(sum, query_.resolution.steps);
      add_reaches(sum, query_.resolution.agreeing);
      for (const CalibrationPtr& calibration : query_.calibrations) {
        const auto columns = calibration->property == declared.name && has_unit(*calibration, declared)
                                 ? columns_of(*calibration, knows_fractions)
                                 : std::nullopt;
        if (!columns) continue;
        sums_.push_back(sum);
        sums_.back().by = calibration;
        sums_.back().columns = *columns;
        sums_.back().intent.by = calibration->name;
      }
      if (sums_.size() > first) continue;
      sum.intent.is_setting = std::ranges::find(query_.needs, declared.name) != query_.needs.end();
      sum.setting = column(Kind::attribute, declared.name);
      sums_.push_back(sum);
    }
  }

  // Adds what steps reach of an attribute.
  void add_reaches(Sum& sum, const std::vector<ResolvedStep>& steps) const {
    for (const ResolvedStep& step : steps) {
      const size_t place = column(Kind::attribute, step.place_in_reach);
      if (step.is_placed(sum.intent.attribute) && place != no_column)
        sum.places.emplace_back(place, Interval(1, 2));
      else if (step.attribute == sum.intent.attribute && !step.inks)
        sum.reach = step.reach;
      for (const ReadAttribute& other : step.others)
        if (other.attribute == sum.intent.attribute && !step.joint) sum.reach = other.reach;
    }
  }

  void add_colours() {
    for (const CalibrationPtr& calibration : query_.calibrations) {
      if (!calibration->inks || !has_fractions()) continue;
      own_.push_back(for_colours_of(design_as_written_, calibration));
      if (auto survey = ColourSurvey::of(*own_.back(), columns_, design_.materials))
        colours_.push_back(std::move(*survey));
    }
    if (!colours_.empty()) return;
    for (const design::AttributeDeclaration& declared : declared_attributes(design_as_written_))
      if (is_colour(declared)) report_.unknown_colours.push_back(declared.name);
  }

  void sample_all(const Sampler& requested, const Sampler& sampler) {
    const auto& count = report_.lattice.count;
    report_.flags.reserve(report_.lattice.voxels());
    std::vector<Vec3> points;
    for (int64_t k = 0; k < count[2]; ++k)
      for (int64_t j = 0; j < count[1]; ++j) {
        for (int64_t i = 0; i < count[0]; ++i) points.push_back(report_.lattice.center(i, j, k));
        if (points.size() >= points_at_once) take(requested, sampler, points);
      }
    take(requested, sampler, points);
  }

  Values values_of(const Sampler& sampler, const std::vector<Vec3>& points) const {
    Values values(sampler.columns().size(), std::vector<double>(points.size()));
    std::vector<double*> columns;
    for (auto& column : values) columns.push_back(column.data());
    sampler.sample(points, columns, query_.loan.threads, query_.loan.stop);
    return values;
  }

  void take(const Sampler& requested, const Sampler& sampler, std::vector<Vec3>& points) {
    const Values wanted = values_of(requested, points), values = values_of(sampler, points);
    for (size_t point = 0; point < points.size(); ++point) {
      const bool is_inside = values[0][point] != 0;
      bool is_reached = true;
      for (size_t n = 0; n < sums_.size() && is_inside; ++n)
        is_reached = sums_[n].take(wanted[sums_[n].wanted][point], values, point, points[point]) && is_reached;
      if (is_inside) ++report_.points;
      report_.flags.push_back(static_cast<uint8_t>(!is_inside ? 0 : is_reached ? 1 : 2));
    }
    take_colours(values, points);
    points.clear();
  }

  void take_colours(const Values& values, const std::vector<Vec3>& points) {
    if (colours_.empty()) return;
    std::vector<uint8_t> flags;
    for (const double inside : values[0]) flags.push_back(inside != 0 ? 1 : 0);
    for (ColourSurvey& survey : colours_) survey.take(values, points, query_.loan.threads, flags);
    report_.colour_flags.insert(report_.colour_flags.end(), flags.begin(), flags.end());
  }

  const design::Design& design_as_written_;
  const IntentQuery& query_;
  const design::Design& design_;
  IntentReport report_;
  std::vector<Sampler::Column> requested_columns_, columns_;
  std::vector<Sum> sums_;
  std::vector<CalibrationPtr> own_;  // of the colours
  std::vector<ColourSurvey> colours_;
};

}  // namespace

voxel::Lattice coarse_lattice(const voxel::Lattice& job) {
  const Vec3 size = job.box().size(), voxel = job.voxel_mm();
  const double spacing = math::pow(size.x * size.y * size.z / most_points, 1.0 / 3);
  voxel::Lattice coarse = job;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto step = static_cast<int64_t>(std::max(1.0, std::ceil(spacing / voxel[static_cast<int>(axis)])));
    const Pitch& pitch = job.pitch[axis];
    coarse.pitch[axis] = Pitch::from_ratio(pitch.numerator * step, pitch.denominator).value_or(pitch);
    const int n = static_cast<int>(axis);
    coarse.count[axis] = voxel::voxels_along(size[n], coarse.pitch[axis]);
    coarse.origin[n] -= (coarse.pitch[axis].times(static_cast<double>(coarse.count[axis])) - size[n]) / 2;
  }
  return coarse;
}

std::optional<IntentReport> survey_intent(const design::Design& design, const IntentQuery& query,
                                          const voxel::Lattice& lattice, Diagnostics& diagnostics) {
  return IntentSurvey(design, query, lattice).run(diagnostics);
}

}  // namespace ombre::compile
