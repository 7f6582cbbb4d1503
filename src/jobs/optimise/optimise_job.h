// Evaluates designs with other values of their variables.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jobs/optimise/optimise_study.h"
#include "optimise/search.h"

namespace ombre::compile {

// The measures of a design, or the reason why there are none.
struct Measured {
  std::vector<double> values;  // in the order of the measures
  std::string failure;         // empty if the values are known
  double solve_bytes = 0;
};

using LoadWith = std::function<LoadedPtr(const LoadOptions& options, Diagnostics& diagnostics)>;

// Loads a design with given values and measures it. The plan's options apply, except for the size of bricks.
// Diagnostics become the failure. Throws Cancelled, and Error for files.
class DesignMeter {
 public:
  DesignMeter(const OptimiseStudy& study, LoadWith load, LoadOptions options, PlanOptions plan)
      : study_(study), load_(std::move(load)), options_(std::move(options)), plan_(std::move(plan)) {}

  // `values` are those of the study's variables.
  Measured measure(const std::vector<double>& values, int threads, const StopFlag* stop) const;

 private:
  const OptimiseStudy& study_;
  LoadWith load_;
  LoadOptions options_;
  PlanOptions plan_;
};

// Returns "name=value" for each variable.
std::vector<std::string> definitions_of(const OptimiseStudy& study, const std::vector<double>& values);

// Adds a diagnostic for each variable of the study that the script does not assign.
void check_variables(const OptimiseStudy& study, const SourcePtr& script, Diagnostics& diagnostics);

// Plans the bricks of a design.
std::optional<BrickPlan> plan_bricks(const LoadedPtr& loaded, const ModelChoice& choice, PlanOptions options,
                                     Diagnostics& diagnostics);

// Returns a point's values of the variables: within their ranges, and whole numbers if the study says so.
std::vector<double> values_at(const OptimiseStudy& study, const optimise::Point& point);
// Returns the values that a search minimises, and how far limits are exceeded, in units of the limit, or of 1 if that
// is 0.
optimise::Outcome outcome_of(const OptimiseStudy& study, const Measured& measured);

}  // namespace ombre::compile
