#include "jobs/optimise/optimise_job.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/text.h"
#include "lang/syntax/parser.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

constexpr double gram_per_tonne = 1e6;

// Numbers that a script prints: "cost = 3, size = 2".
class Printed {
 public:
  void take(const std::string& text) {
    for (const std::string& item : split(text, ',')) {
      const size_t equals = item.find('=');
      if (equals == std::string::npos) continue;
      if (const auto value = parse_number(trim(std::string_view(item).substr(equals + 1))))
        values_[std::string(trim(std::string_view(item).substr(0, equals)))] = *value;
    }
  }
  const double* find(const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::string, double> values_;
};

struct Solved {
  fea::Model model;
  fea::Conditions conditions;
  std::optional<fea::Solution> solution;
};

double mass_of(const fea::Model& model) {
  double sum = 0;
  for (size_t n = 0; n < model.bricks.count(); ++n) sum += model.bricks.share(n) * model.elastic(n).density_t_mm3;
  return sum * model.bricks.volume_mm3() * gram_per_tonne;
}

bool lacks_density(const fea::Model& model) {
  return std::ranges::any_of(model.sections,
                             [](const fea::Section& section) { return !(section.elastic.density_t_mm3 > 0); });
}

// Returns the share of a material; nothing if the design lacks the material.
double share_of(const fea::Model& model, const std::string& material) {
  for (const fea::ValueField& field : model.fields) {
    if (to_lower(field.name) != "fraction of " + to_lower(material)) continue;
    double sum = 0;
    for (size_t n = 0; n < model.bricks.count(); ++n)
      sum += model.bricks.share(n) * static_cast<double>(field.values[n]);
    return sum / model.bricks.filled_count();
  }
  return 0;
}

double displacement_of(const Solved& solved, const Measure& measure) {
  double most = -1;
  for (size_t n = 0; n < solved.model.bricks.node_count(); ++n) {
    if (measure.in && !measure.in->contains(solved.model.bricks.node(n))) continue;
    const Vec3 u = solved.solution->displacement_mm[n];
    most = std::max(most, measure.axis ? std::abs(u[*measure.axis]) : length(u));
  }
  return most;
}

double stress_of(const Solved& solved, const Measure& measure) {
  double most = -1;
  for (size_t n = 0; n < solved.model.bricks.count(); ++n)
    if (!measure.in || measure.in->contains(solved.model.bricks.centre_of_fill(n)))
      most = std::max(most, fea::von_mises(solved.solution->stress_mpa[n]));
  return most;
}

double compliance_of(const Solved& solved) {
  double sum = 0;
  for (const fea::Prescribed& force : solved.conditions.forces)
    sum += force.value * solved.solution->displacement_mm[force.node][force.axis];
  return sum;
}

// Returns the first error in one line.
std::string failure_of(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics.list())
    if (diagnostic.severity == Severity::error) return sentence_of(diagnostic);
  return "the design has errors";
}

class Evaluation {
 public:
  Evaluation(const OptimiseStudy& study, const LoadWith& load, LoadOptions options, PlanOptions plan,
             const StopFlag* stop)
      : study_(study), load_(load), options_(std::move(options)), plan_(std::move(plan)), stop_(stop) {}

  Measured run() {
    options_.echo = [&](const std::string& text) { printed_.take(text); };
    loaded_ = load_(options_, diagnostics_);
    if (!loaded_ || diagnostics_.has_errors()) return failed(failure_of(diagnostics_));
    if (study_.model && !solve()) return failed(failure_of(diagnostics_));
    for (const Measure& measure : study_.measures()) {
      const double value = value_of(measure);
      if (!failure_.empty()) return failed(failure_);
      measured_.values.push_back(value);
    }
    return std::move(measured_);
  }

 private:
  Measured failed(const std::string& why) {
    Measured nothing;
    nothing.failure = why;
    return nothing;
  }

  bool solve() {
    const ModelChoice& choice = *study_.model;
    const auto plan = plan_bricks(loaded_, choice, plan_, diagnostics_);
    if (!plan) return false;
    const FeaRequest request = choice.sections.request(plan_.threads);
    auto model = fea_model(loaded_, *plan, choice.fea, request, diagnostics_, nullptr, stop_);
    if (!model) return false;
    solved_.model = std::move(*model);
    if (!study_.needs_solution()) return true;
    auto conditions = fea::conditions_of(choice.fea, solved_.model, diagnostics_);
    if (!conditions) return false;
    solved_.conditions = std::move(*conditions);
    measured_.solve_bytes = fea::solve_bytes(solved_.model.bricks);
    fea::SolveOptions how;
    how.threads = plan_.threads;
    how.solver = choice.solver;
    try {
      solved_.solution = fea::solve(solved_.model, solved_.conditions, how, nullptr, stop_);
    } catch (const Error& error) {  // it did not converge
      diagnostics_.error({loaded_->source, 0, 0}, error.what());
      return false;
    }
    return true;
  }

  double value_of(const Measure& measure) {
    switch (measure.kind) {
      case Measure::Kind::volume:
        return solved_.model.bricks.filled_count() * solved_.model.bricks.volume_mm3();
      case Measure::Kind::mass:
        if (lacks_density(solved_.model))
          failure_ = "the mass is unknown, since a material has no density_kg_m3; write it into the study";
        return mass_of(solved_.model);
      case Measure::Kind::share:
        return share_of(solved_.model, measure.name);
      case Measure::Kind::displacement:
        return found(displacement_of(solved_, measure), measure);
      case Measure::Kind::stress:
        return found(stress_of(solved_, measure), measure);
      case Measure::Kind::compliance:
        return compliance_of(solved_);
      case Measure::Kind::echo:
        break;
    }
    const double* const value = printed_.find(measure.name);
    if (!value)
      failure_ = "the script prints no number named \"" + measure.name + "\"; write echo(" + measure.name + " = ...);";
    return value ? *value : 0;
  }

  double found(double value, const Measure& measure) {
    if (value < 0) failure_ = "nothing of the mesh lies in the box of " + measure.label();
    return value;
  }

  const OptimiseStudy& study_;
  const LoadWith& load_;
  LoadOptions options_;
  PlanOptions plan_;
  const StopFlag* stop_;
  Diagnostics diagnostics_;
  Printed printed_;
  LoadedPtr loaded_;
  Solved solved_;
  Measured measured_;
  std::string failure_;
};

bool has_include(const lang::ast::File& file) {
  return std::ranges::any_of(
      file.statements, [](const auto& statement) { return statement->kind == lang::ast::Statement::Kind::include; });
}

}  // namespace

Measured DesignMeter::measure(const std::vector<double>& values, int threads, const StopFlag* stop) const {
  LoadOptions options = options_;
  for (std::string& definition : definitions_of(study_, values)) options.definitions.push_back(std::move(definition));
  options.stop = stop;
  options.threads = threads;
  PlanOptions plan = plan_;
  plan.stop = stop;
  plan.threads = threads;
  return Evaluation(study_, load_, std::move(options), std::move(plan), stop).run();
}

std::vector<std::string> definitions_of(const OptimiseStudy& study, const std::vector<double>& values) {
  std::vector<std::string> definitions;
  for (size_t n = 0; n < values.size(); ++n)
    definitions.push_back(study.variables[n].name + "=" + format_number(values[n]));
  return definitions;
}

void check_variables(const OptimiseStudy& study, const SourcePtr& script, Diagnostics& diagnostics) {
  Diagnostics ignored;  // loading the script reports them
  const bool is_scad = to_lower(script->name()).ends_with(".scad");
  const lang::ast::File file = lang::parse(script, ignored, is_scad ? lang::Dialect::openscad : lang::Dialect::vcad);
  std::vector<std::string> names;
  for (const auto& statement : file.statements)
    if (statement->kind == lang::ast::Statement::Kind::assign)
      names.push_back(static_cast<const lang::ast::Assign&>(*statement).name.text());
  // Assignments in included files are not visible here, so a script with includes is not checked.
  if (has_include(file)) return;
  for (const DesignVariable& variable : study.variables) {
    if (std::ranges::find(names, variable.name) != names.end()) continue;
    const std::string slip = did_you_mean(variable.name, names);
    diagnostics.error(Code::unknown_variable, variable.where,
                      script->name() + " has no top-level variable \"" + variable.name + "\"",
                      !slip.empty()   ? slip
                      : names.empty() ? "write one at the top of the script: " + variable.name + " = 1;"
                                      : "it has " + join(names, ", "),
                      {{"name", variable.name}});
  }
}

std::optional<BrickPlan> plan_bricks(const LoadedPtr& loaded, const ModelChoice& choice, PlanOptions options,
                                     Diagnostics& diagnostics) {
  options.pitch = choice.cell;
  if (choice.brick_count) {
    const auto box = design_box(loaded->design, diagnostics);
    if (!box) return std::nullopt;
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<size_t>(axis);
      options.pitch[at] = Pitch::from_mm(box->size()[axis] / static_cast<double>((*choice.brick_count)[at]));
    }
  }
  return plan_model(loaded, options, choice.sections.fill, diagnostics);
}

std::vector<double> values_at(const OptimiseStudy& study, const optimise::Point& point) {
  std::vector<double> values;
  for (size_t n = 0; n < point.size(); ++n) {
    const DesignVariable& variable = study.variables[n];
    const double value = variable.low + point[n] * (variable.high - variable.low);
    values.push_back(std::clamp(variable.is_whole ? std::round(value) : value, variable.low, variable.high));
  }
  return values;
}

optimise::Outcome outcome_of(const OptimiseStudy& study, const Measured& measured) {
  optimise::Outcome outcome;
  outcome.failed = !measured.failure.empty();
  if (outcome.failed) return outcome;
  size_t next = 0;
  for (const Objective& objective : study.objectives) {
    const double value = measured.values[next++];
    outcome.objectives.push_back(objective.is_maximised ? -value : value);
  }
  for (const Limit& limit : study.limits) {
    const double beyond = measured.values[next++] - limit.value;
    outcome.excesses.push_back((limit.is_upper ? beyond : -beyond) / (limit.value != 0 ? std::abs(limit.value) : 1));
  }
  return outcome;
}

}  // namespace ombre::compile
