#include "questions/unusable_mixtures.h"

#include <algorithm>
#include <set>
#include <vector>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using Kind = Sampler::Column::Kind;

constexpr size_t points_at_once = size_t{1} << 18;

// The elements with one kind of fault.
struct Spoilt {
  size_t count = 0, first = 0;
  std::set<MaterialId> taken_for;

  void add(size_t element, MaterialId material) {
    if (count++ == 0) first = element;
    taken_for.insert(material);
  }
};

class MixtureSurvey {
 public:
  MixtureSurvey(const design::Design& design, const Sampler& sampler, const ElementDraws& elements)
      : design_(design), sampler_(sampler), elements_(elements), by_check_(sampler.columns().size()) {}

  void run(int threads, const StopFlag* stop) {
    std::vector<std::vector<double>> values(by_check_.size());
    for (size_t begin = 0; begin < elements_.middles.size(); begin += points_at_once) {
      const size_t count = std::min(points_at_once, elements_.middles.size() - begin);
      std::vector<double*> columns;
      for (auto& column : values) {
        column.resize(count);
        columns.push_back(column.data());
      }
      sampler_.sample(elements_.middles.subspan(begin, count), columns, threads, stop);
      for (size_t n = 0; n < count; ++n) check(values, n, begin + n);
    }
  }

  bool report(Diagnostics& diagnostics) const {
    if (all_.count == 0) return true;
    for (size_t c = 0; c < by_check_.size(); ++c)
      if (by_check_[c].count > 0)
        diagnostics.warning(sampler_.columns()[c].where, sampler_.columns()[c].name + " (" + text(by_check_[c]) + ")");
    const SourceRange part = design_.parts[0].solid->where();
    if (unknown_.count > 0) diagnostics.warning(part, "the mixture is no number in " + text(unknown_));
    if (all_.count < inside_) return true;
    diagnostics.error(Code::parameters, part,
                      "the mixture is no number in any of the " + format_count(inside_) + " elements",
                      "look at what its formulas, files and results give inside of the design");
    return false;
  }

 private:
  void check(const std::vector<std::vector<double>>& values, size_t n, size_t element) {
    bool has_check = false;
    double sum = 0;  // sum of fractions
    for (size_t c = 0; c < values.size(); ++c) {
      const Kind kind = sampler_.columns()[c].kind;
      const double value = values[c][n];
      if (kind == Kind::inside && !(value > 0)) return;
      if (kind == Kind::fraction) sum += value;
      if (kind != Kind::check || value == 0) continue;
      by_check_[c].add(element, elements_.drawn[element]);
      has_check = true;
    }
    ++inside_;
    const bool is_unknown = !(sum > 0);
    if (is_unknown && !has_check) unknown_.add(element, elements_.drawn[element]);
    if (is_unknown || has_check) all_.add(element, elements_.drawn[element]);
  }

  std::string text(const Spoilt& spoilt) const {
    std::vector<std::string> names;
    for (const MaterialId id : spoilt.taken_for) names.push_back(design_.materials.find(id)->name);
    return format_count(spoilt.count) + " of " + format_count(elements_.middles.size()) +
           " elements, the first around " + format_point(elements_.middles[spoilt.first]) + "; " +
           (spoilt.count == 1 ? "it is" : "they are") + " of " + join(names, " and ");
  }

  const design::Design& design_;
  const Sampler& sampler_;
  const ElementDraws& elements_;
  std::vector<Spoilt> by_check_;  // elements by the number of the column of the check
  Spoilt unknown_, all_;  // elements whose fractions have no positive sum and that no check names; all faulty elements
  size_t inside_ = 0;
};

}  // namespace

bool check_mixtures(const design::Design& design, const ElementDraws& elements, int threads, const StopFlag* stop,
                    Diagnostics& diagnostics) {
  SampleQuery query;
  query.inside = query.fractions = query.checks = true;
  const auto sampler = Sampler::build(design, query, diagnostics);
  if (!sampler) return false;
  constexpr size_t of_one_material = 2;  // columns: inside, and a fraction that is always 1
  if (sampler->columns().size() == of_one_material) return true;
  MixtureSurvey survey(design, *sampler, elements);
  survey.run(threads, stop);
  return survey.report(diagnostics);
}

}  // namespace ombre::compile
