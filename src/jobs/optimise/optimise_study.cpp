#include "jobs/optimise/optimise_study.h"

#include <algorithm>
#include <cmath>

#include "base/text/record.h"
#include "base/text/text.h"

namespace ombre::compile {
namespace {

const char* const variables_help = R"(write for example "variables": {"width": {"from": 2, "to": 10}})";

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

std::optional<Measure::Kind> read_kind(const Data& data, const MemberReader& reader) {
  const auto kind = reader.choice(data, "measure", names_in(measure_names));
  return kind ? std::optional(static_cast<Measure::Kind>(*kind)) : std::nullopt;
}

void check_measure(Measure& measure, const Data& data, const MemberReader& reader) {
  using Kind = Measure::Kind;
  const bool has_place = measure.kind == Kind::displacement || measure.kind == Kind::stress;
  if (measure.in && !has_place) reader.fail(*data.find("in"), "only displacement and stress have \"in\"");
  if (measure.axis && measure.kind != Kind::displacement)
    reader.fail(*data.find("axis"), "only displacement has \"axis\"");
  const std::string named_by = measure.kind == Kind::share ? "material" : measure.kind == Kind::echo ? "name" : "";
  if (named_by.empty()) return;
  if (const Data* name = data.find(named_by))
    measure.name = reader.text(*name, named_by).value_or("");
  else
    reader.fail_missing(data, "this measure", named_by, "write it as a text in quotes");
}

// Its kind stands in one of these members.
Record<Measure> measure_record(const std::string& what, const std::vector<std::string>& kinds) {
  using M = Measure;
  std::vector<Field<M>> fields{field::choice("axis", &M::axis, {"x", "y", "z"}),
                               field::value("in", &M::in, fea::read_box)};
  for (const std::string& kind : kinds) fields.push_back(field::value(kind, &M::kind, read_kind));
  return Record<M>(what, fields)
      .knows({"material", "name"})
      .one_of(kinds, R"(write for example ")" + kinds.front() + R"(": "mass")")
      .checked(check_measure);
}

Record<Objective> objective_record() {
  return Record<Objective>("an objective", {})
      .with(&Objective::measure, measure_record("an objective", {"minimise", "maximise"}))
      .checked([](Objective& objective, const Data& data, const MemberReader&) {
        objective.is_maximised = data.find("maximise") != nullptr;
      });
}

Record<Limit> limit_record() {
  return Record<Limit>("a constraint", {field::number("at_most", &Limit::value),
                                        field::number("at_least", &Limit::value).sets(&Limit::is_upper, false)})
      .one_of({"at_most", "at_least"}, R"(write {"measure": "displacement", "at_most": 0.5})")
      .with(&Limit::measure, measure_record("a constraint", {"measure"}));
}

void check_variable(DesignVariable& variable, const Data& data, const MemberReader& reader) {
  if (variable.is_whole) {
    variable.low = std::ceil(variable.low);
    variable.high = std::floor(variable.high);
  }
  if (!(variable.low < variable.high))
    return reader.fail(data, "the range of \"" + variable.name + "\" is empty", "let \"from\" be less than \"to\"");
  variable.start = (variable.low + variable.high) / 2;
  if (const Data* start = data.find("start"))
    variable.start = reader.number(*start, "start", {variable.low, variable.high}).value_or(variable.start);
}

void read_variables(OptimiseStudy& study, const Data& data, const MemberReader& reader) {
  using V = DesignVariable;
  const Record<V> record =
      Record<V>("a variable", {field::number("from", &V::low).required(), field::number("to", &V::high).required(),
                               field::flag("whole", &V::is_whole)})
          .knows({"start"})
          .checked(check_variable);
  if (!data.members() || data.members()->empty())
    return reader.fail(data, "the study names no variables of the design", variables_help);
  for (const auto& [name, value] : *data.members()) {
    V& variable = study.variables.emplace_back();
    variable.name = name;
    record.read(value, variable, reader);
  }
}

// The methods for as many objectives, in the order of the table.
std::vector<std::string> methods_for(bool has_many, bool has_limits = false) {
  std::vector<std::string> names;
  for (const optimise::Method& method : optimise::methods())
    if (method.many_objectives == has_many && (method.takes_constraints || !has_limits)) names.push_back(method.name);
  return names;
}

Record<optimise::SearchOptions> search_record() {
  using S = optimise::SearchOptions;
  constexpr double most_evaluations = 1e6, most_seed = 4294967295.0;
  std::vector<std::string> names;
  for (const optimise::Method& method : optimise::methods()) names.push_back(method.name);
  return Record<S>(
      "a study",
      {field::choice("method", &S::method, names), field::whole("evaluations", &S::evaluations, 1, most_evaluations),
       field::whole("population", &S::population, 8, most_evaluations), field::whole("seed", &S::seed, 0, most_seed),
       field::number("tolerance", &S::tolerance, {1e-9, 1})});
}

void check_search(OptimiseStudy& study, const Data& data, const MemberReader& reader) {
  optimise::SearchOptions& search = study.search;
  const bool has_many = study.objectives.size() > 1, has_limits = !study.limits.empty();
  const Data* const given = data.find("method");
  if (!given) search.method = methods_for(has_many).front();
  if (!data.find("evaluations")) search.evaluations = has_many ? 480 : 200;
  const optimise::Method& method = *optimise::find_method(search.method);
  const Data& at = given ? *given : data;
  const std::string hint = "choose " + words_text(methods_for(has_many, has_limits));
  if (has_many && !method.many_objectives)
    reader.fail(at, method.name + " takes one objective, not " + std::to_string(study.objectives.size()),
                hint + ", or make some of them constraints");
  if (!has_many && method.many_objectives) reader.fail(at, method.name + " takes several objectives, not one", hint);
  if (has_limits && !method.takes_constraints) reader.fail(at, method.name + " takes no constraints", hint);
}

void check_loads(const OptimiseStudy& study, Diagnostics& diagnostics) {
  const fea::Study& fea = study.model->fea;
  const auto moves = [](const fea::Support& support) {
    return std::ranges::any_of(support.displacement_mm, [](const auto& u) { return u && *u != 0; });
  };
  if (!fea.loads.empty() || length(fea.gravity_mm_s2) > 0 || std::ranges::any_of(fea.supports, moves)) return;
  for (const Measure& measure : study.measures())
    if (measure.needs_solution())
      return diagnostics.error(Code::study, measure.where, measure.label() + " needs loads, and the study has none",
                               R"(write into "fea" for example "loads": [{"on": "zmax", "force_n": [0, 0, -10]}])");
}

void check_study(OptimiseStudy& study, const Data& data, const MemberReader& reader) {
  const size_t before = reader.error_count();
  if (study.objectives.empty())
    return reader.fail(data, "the study has no objectives",
                       R"(write for example "objectives": [{"minimise": "mass"}])");
  check_search(study, data, reader);
  if (reader.error_count() == before && std::ranges::any_of(study.measures(), &Measure::needs_bricks))
    model_record(Solves::once).read_members(data, study.model.emplace(), reader);
  if (reader.error_count() == before && study.needs_solution()) check_loads(study, reader.diagnostics());
}

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
  using S = OptimiseStudy;
  const Record<S> record = Record<S>("a study", {field::special("variables", read_variables).required(variables_help),
                                                 field::objects("objectives", &S::objectives, objective_record()),
                                                 field::objects("constraints", &S::limits, limit_record())})
                               .with(&S::search, search_record())
                               .knows(model_record(Solves::once).names())
                               .checked(check_study);
  OptimiseStudy study;
  if (!record.read(data, study, MemberReader(diagnostics, Code::study_value))) return std::nullopt;
  return study;
}

}  // namespace ombre::compile
