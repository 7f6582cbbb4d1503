#include "jobs/optimise/optimise_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text/text.h"
#include "jobs/optimise/study_reader.h"

namespace ombre::compile {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

struct MeasureName {
  const char *name, *unit;
};
// Names and units of measures, in the order of Measure::Kind.
constexpr std::array<MeasureName, 7> measure_names{{{"volume", "mm3"},
                                                    {"mass", "g"},
                                                    {"share", ""},
                                                    {"displacement", "mm"},
                                                    {"stress", "MPa"},
                                                    {"compliance", "N mm"},
                                                    {"echo", ""}}};

std::vector<std::string> names_of_measures() {
  std::vector<std::string> names;
  for (const MeasureName& measure : measure_names) names.emplace_back(measure.name);
  return names;
}

std::vector<std::string> names_of_methods() {
  std::vector<std::string> names;
  for (const optimise::Method& method : optimise::methods()) names.push_back(method.name);
  return names;
}

std::vector<std::string> with(std::vector<std::string> names, const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

class OptimiseReader {
 public:
  OptimiseReader(const Data& data, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        members_(data, "a study",
                 with({"variables", "objectives", "constraints", "method", "evaluations", "population", "seed",
                       "tolerance", "fill"},
                      model_members),
                 diagnostics) {}

  std::optional<OptimiseStudy> read() {
    if (diagnostics_.has_errors()) return std::nullopt;
    read_variables();
    for (const Data& goal : items("objectives")) study_.objectives.push_back(read_objective(goal));
    for (const Data& limit : items("constraints")) study_.limits.push_back(read_limit(limit));
    if (study_.objectives.empty() && !diagnostics_.has_errors())
      members_.fail(members_.data(), "the study has no objectives",
                    R"(write for example "objectives": [{"minimise": "mass"}])");
    if (!diagnostics_.has_errors()) read_search();
    if (!diagnostics_.has_errors() && needs_bricks()) study_.model = read_model_choice(members_, diagnostics_);
    if (!diagnostics_.has_errors() && study_.needs_solution()) check_loads();
    if (diagnostics_.has_errors()) return std::nullopt;
    return std::move(study_);
  }

 private:
  DataList items(const char* name) {
    const Data* const found = members_.find(name);
    if (!found) return {};
    if (const DataList* list = found->list()) return *list;
    members_.fail(*found, std::string("\"").append(name).append("\" is a list, in square brackets"));
    return {};
  }

  void read_variables() {
    const Data* const variables = members_.find("variables");
    if (!variables || !variables->members() || variables->members()->empty())
      return members_.fail(variables ? *variables : members_.data(), "the study names no variables of the design",
                           R"(write for example "variables": {"width": {"from": 2, "to": 10}})");
    for (const auto& [name, value] : *variables->members()) study_.variables.push_back(read_variable(name, value));
  }

  DesignVariable read_variable(const std::string& name, const Data& data) {
    StudyMembers members(data, "a variable", {"from", "to", "start", "whole"}, diagnostics_);
    DesignVariable variable{name, 0, 0, 0, false, data.where};
    if (!data.members()) return variable;
    variable.low = members.number("from", std::nullopt, -unbounded, unbounded);
    variable.high = members.number("to", std::nullopt, -unbounded, unbounded);
    if (diagnostics_.has_errors()) return variable;
    variable.is_whole = members.boolean("whole", false);
    if (variable.is_whole) {
      variable.low = std::ceil(variable.low);
      variable.high = std::floor(variable.high);
    }
    if (!(variable.low < variable.high))
      members.fail(data, "the range of \"" + name + "\" is empty", "let \"from\" be less than \"to\"");
    else
      variable.start = members.number("start", (variable.low + variable.high) / 2, variable.low, variable.high);
    return variable;
  }

  Measure read_measure(const Data& data, const std::string& key, StudyMembers& members) {
    Measure measure;
    measure.where = data.where;
    const std::vector<std::string> names = names_of_measures();
    const std::string name = members.text(key, std::nullopt);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      if (diagnostics_.has_errors()) return measure;
      const std::string slip = did_you_mean(name, names);
      members.fail(*members.find(key), "there is no measure \"" + name + "\"",
                   slip.empty() ? "the measures are " + join(names, ", ") : slip);
      return measure;
    }
    measure.kind = static_cast<Measure::Kind>(found - names.begin());
    if (measure.kind == Measure::Kind::share) measure.name = members.text("material", std::nullopt);
    if (measure.kind == Measure::Kind::echo) measure.name = members.text("name", std::nullopt);
    const bool has_place = measure.kind == Measure::Kind::displacement || measure.kind == Measure::Kind::stress;
    if (members.has("in") && !has_place) members.fail(*members.find("in"), "only displacement and stress have \"in\"");
    if (members.has("axis") && measure.kind != Measure::Kind::displacement)
      members.fail(*members.find("axis"), "only displacement has \"axis\"");
    measure.in = members.box("in");
    if (members.has("axis")) measure.axis = members.choice("axis", "x", {"x", "y", "z"})[0] - 'x';
    return measure;
  }

  Objective read_objective(const Data& data) {
    StudyMembers members(data, "an objective", {"minimise", "maximise", "material", "name", "axis", "in"},
                         diagnostics_);
    Objective objective;
    if (!data.members()) return objective;
    objective.is_maximised = members.has("maximise");
    if (members.has("minimise") == objective.is_maximised)
      members.fail(data, "an objective has either \"minimise\" or \"maximise\"", R"(write {"minimise": "mass"})");
    else
      objective.measure = read_measure(data, objective.is_maximised ? "maximise" : "minimise", members);
    return objective;
  }

  Limit read_limit(const Data& data) {
    StudyMembers members(data, "a constraint", {"measure", "at_most", "at_least", "material", "name", "axis", "in"},
                         diagnostics_);
    Limit limit;
    if (!data.members()) return limit;
    limit.measure = read_measure(data, "measure", members);
    limit.is_upper = members.has("at_most");
    if (limit.is_upper == members.has("at_least"))
      members.fail(data, "a constraint has either \"at_most\" or \"at_least\"",
                   R"(write {"measure": "displacement", "at_most": 0.5})");
    else
      limit.value = members.number(limit.is_upper ? "at_most" : "at_least", std::nullopt, -unbounded, unbounded);
    return limit;
  }

  void read_search() {
    constexpr double most_evaluations = 1e6, most_seed = 4294967295.0;
    optimise::SearchOptions& search = study_.search;
    const bool has_many = study_.objectives.size() > 1;
    search.method = members_.choice("method", has_many ? "nsga2" : "cobyla", names_of_methods());
    search.evaluations = static_cast<size_t>(members_.number("evaluations", has_many ? 480 : 200, 1, most_evaluations));
    search.population = static_cast<size_t>(members_.number("population", 24, 8, most_evaluations));
    search.seed = static_cast<uint32_t>(members_.number("seed", 0, 0, most_seed));
    search.tolerance = members_.number("tolerance", search.tolerance, 1e-9, 1);
    const Data& at = members_.has("method") ? *members_.find("method") : members_.data();
    const optimise::Method& method = *optimise::find_method(search.method);
    if (has_many && !method.many_objectives)
      members_.fail(at, method.name + " takes one objective, not " + std::to_string(study_.objectives.size()),
                    "choose \"nsga2\", or make some of them constraints");
    if (!has_many && method.many_objectives)
      members_.fail(at, method.name + " takes several objectives, not one", "choose \"cmaes\" or \"cobyla\"");
    if (!study_.limits.empty() && !method.takes_constraints)
      members_.fail(at, method.name + " takes no constraints", "choose \"cobyla\"");
  }

  bool needs_bricks() const { return std::ranges::any_of(study_.measures(), &Measure::needs_bricks); }

  void check_loads() {
    const fea::Study& fea = study_.model->fea;
    const auto moves = [](const fea::Support& support) {
      return std::ranges::any_of(support.displacement_mm, [](const auto& u) { return u && *u != 0; });
    };
    if (!fea.loads.empty() || length(fea.gravity_mm_s2) > 0 || std::ranges::any_of(fea.supports, moves)) return;
    for (const Measure& measure : study_.measures())
      if (measure.needs_solution())
        return diagnostics_.error(Code::study, measure.where, measure.label() + " needs loads, and the study has none",
                                  R"(write into "fea" for example "loads": [{"on": "zmax", "force_n": [0, 0, -10]}])");
  }

  Diagnostics& diagnostics_;
  StudyMembers members_;
  OptimiseStudy study_;
};

}  // namespace

std::string Measure::label() const {
  const MeasureName& known = measure_names[static_cast<size_t>(kind)];
  if (kind == Kind::echo) return name;
  std::string text = known.name;
  if (kind == Kind::share) text += " of " + name;
  if (axis) text += std::string(" ") + static_cast<char>('x' + *axis);
  if (in) text += " in box";
  return *known.unit ? text + " [" + known.unit + "]" : text;
}

std::vector<Measure> OptimiseStudy::measures() const {
  std::vector<Measure> all;
  for (const Objective& objective : objectives) all.push_back(objective.measure);
  for (const Limit& limit : limits) all.push_back(limit.measure);
  return all;
}

bool OptimiseStudy::needs_solution() const { return std::ranges::any_of(measures(), &Measure::needs_solution); }

std::optional<OptimiseStudy> read_optimise_study(const Data& data, Diagnostics& diagnostics) {
  return OptimiseReader(data, diagnostics).read();
}

}  // namespace ombre::compile
