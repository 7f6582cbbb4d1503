#include "jobs/resolve/cure_survey.h"

#include <algorithm>
#include <cmath>

#include "base/math/math.h"
#include "questions/design_stages.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using calibration::Calibration;

constexpr double most_cure_points = 4e6;
constexpr size_t columns_at_once = size_t{1} << 18;
constexpr double cure_rounding = 1e-9;  // of a layer's height

// The light in all columns, layer by layer from the top.
class Light {
 public:
  Light(const Calibration& curve, const voxel::Lattice& lattice)
      : curve_(curve.constants),
        lattice_(lattice),
        layer_mm_(lattice.pitch[2].mm()),
        falls_to_(math::exp(-layer_mm_ / curve_.penetration)),
        columns_(static_cast<size_t>(lattice.count[0] * lattice.count[1])),
        doses_(columns_, 0),
        below_part_(columns_, 0) {
    report_.by = curve.name;
    report_.layer_mm = report_.least_depth = layer_mm_;
  }

  void take_layer(int64_t k, const double* inside, const double* dose) {
    for (size_t n = 0; n < columns_; ++n) {
      const bool is_part = inside[n] != 0;
      const double at_top = doses_[n] + (is_part ? std::max(0.0, dose[n]) : 0);
      const double cured = depth(at_top);
      is_part ? take_part(n, k, cured) : take_void(n, k, cured);
      doses_[n] = at_top * falls_to_;
    }
  }

  CureReport finished() {
    const Vec3 voxel = lattice_.voxel_mm();
    const double area = voxel.x * voxel.y;
    report_.under_mm3 = under_ * area;
    report_.over_mm3 = over_ * area;
    if (part_ > 0) report_.under_share = under_ / part_;
    return report_;
  }

 private:
  // Returns the depth below the top of a layer, at most its height, at which the critical dose arrives.
  double depth(double dose) const {
    if (dose <= curve_.critical) return 0;
    return std::min(layer_mm_, curve_.penetration * math::log(dose / curve_.critical));
  }

  Vec3 place(size_t n, int64_t k) const {
    const auto width = static_cast<size_t>(lattice_.count[0]);
    return lattice_.center(static_cast<int64_t>(n % width), static_cast<int64_t>(n / width), k);
  }

  void take_part(size_t n, int64_t k, double cured) {
    part_ += layer_mm_;
    below_part_[n] = 0;
    if (cured >= layer_mm_ * (1 - cure_rounding)) return;
    under_ += layer_mm_ - cured;
    if (!(cured < report_.least_depth)) return;
    report_.least_depth = cured;
    report_.least_mm = place(n, k);
  }

  void take_void(size_t n, int64_t k, double cured) {
    if (cured <= 0) return;
    over_ += cured;
    below_part_[n] += cured;
    if (!(below_part_[n] > report_.deepest)) return;
    report_.deepest = below_part_[n];
    report_.deepest_mm = place(n, k);
  }

  const calibration::Constants& curve_;
  const voxel::Lattice& lattice_;
  double layer_mm_, falls_to_;
  size_t columns_;
  std::vector<double> doses_;               // that come through the bottom of the last layer
  std::vector<double> below_part_;          // cured length below the part
  double part_ = 0, under_ = 0, over_ = 0;  // lengths along all columns
  CureReport report_;
};

}  // namespace

const Calibration* working_curve_among(const std::vector<calibration::CalibrationPtr>& calibrations) {
  const auto found = std::ranges::find_if(calibrations, [](const calibration::CalibrationPtr& calibration) {
    return calibration->interpolant == calibration::Interpolant::working_curve &&
           calibration->property == "cure_depth" && calibration->inputs.front().attribute == "dose";
  });
  return found == calibrations.end() ? nullptr : found->get();
}

voxel::Lattice columns_of(const voxel::Lattice& job) {
  voxel::Lattice columns = job;
  const double step = std::ceil(std::sqrt(std::max(1.0, static_cast<double>(job.voxels()) / most_cure_points)));
  for (size_t axis = 0; axis < 2; ++axis) {
    const Pitch& pitch = job.pitch[axis];
    columns.pitch[axis] =
        Pitch::from_ratio(pitch.numerator * static_cast<int64_t>(step), pitch.denominator).value_or(pitch);
    columns.count[axis] = voxel::voxels_along(job.box().size()[static_cast<int>(axis)], columns.pitch[axis]);
  }
  return columns;
}

std::optional<CureReport> survey_cure(const design::Design& design, const Calibration& curve,
                                      const voxel::Lattice& lattice, const StageLoan& loan, Diagnostics& diagnostics) {
  const design::Design staged = with_stages(design::for_lattice(design, {lattice.origin, lattice.pitch}), loan);
  SampleQuery query;
  query.inside = true;
  query.attributes = {"dose"};
  const auto sampler = Sampler::build(staged, query, diagnostics);
  if (!sampler) return std::nullopt;
  Light light(curve, lattice);
  const auto in_layer = static_cast<size_t>(lattice.count[0] * lattice.count[1]);
  const auto at_once = static_cast<int64_t>(std::max<size_t>(1, columns_at_once / in_layer));
  for (int64_t end = lattice.count[2]; end > 0; end -= at_once) {
    std::vector<Vec3> points;
    for (int64_t k = end - 1; k >= std::max<int64_t>(0, end - at_once); --k)
      for (int64_t j = 0; j < lattice.count[1]; ++j)
        for (int64_t i = 0; i < lattice.count[0]; ++i) points.push_back(lattice.center(i, j, k));
    std::vector<double> inside(points.size()), dose(points.size());
    const std::array<double*, 2> columns{inside.data(), dose.data()};
    sampler->sample(points, columns, loan.threads, loan.stop);
    for (size_t n = 0; n < points.size(); n += in_layer)
      light.take_layer(end - 1 - static_cast<int64_t>(n / in_layer), inside.data() + n, dose.data() + n);
  }
  return light.finished();
}

}  // namespace ombre::compile
