#include "jobs/optimise/topology_study.h"

#include <algorithm>

#include "jobs/optimise/study_reader.h"

namespace ombre::compile {
namespace {

// Reads a goal: its place is that of a load, and its direction that of the force.
std::optional<fea::Load> read_goal(const Data& data, bool& is_greatest, Diagnostics& diagnostics) {
  StudyMembers members(data, "a displacement of a topology", {"on", "direction", "goal"}, diagnostics);
  if (!data.members()) return std::nullopt;
  is_greatest = members.choice("goal", "least", {"least", "greatest"}) == "greatest";
  const Data *on = members.find("on"), *direction = members.find("direction");
  if (!direction) {
    members.fail(data, "\"direction\" is missing, along which it is measured", "write for example [0, 0, -1]");
    return std::nullopt;
  }
  DataMembers force{{"force_n", *direction}};
  if (on) force.emplace_back("on", *on);
  Data load(std::move(force));
  load.where = data.where;
  const auto study = fea::read_study(DataMembers{{"loads", DataList{load}}}, diagnostics);
  if (!study) return std::nullopt;
  fea::Load goal = study->loads.front();
  const double size = length(goal.force_n);
  if (!(size > 0)) {
    members.fail(*direction, "a direction without a length", "write for example [0, 0, -1]");
    return std::nullopt;
  }
  goal.force_n = (1 / size) * goal.force_n;
  return goal;
}

void read_topology(const Data& data, optimise::TopologyOptions& options, Diagnostics& diagnostics) {
  constexpr double longest_mm = 1e6;
  StudyMembers members(
      data, "a topology",
      {"volume_fraction", "radius", "penalty", "steps", "move", "change", "projection", "displacement"}, diagnostics);
  if (!data.members()) return;
  options.volume_fraction = members.number("volume_fraction", std::nullopt, 0.01, 1);
  options.radius_mm = members.number("radius", 0, 0, longest_mm);
  options.penalty = members.number("penalty", options.penalty, 1, 10);
  options.steps = static_cast<size_t>(members.number("steps", static_cast<double>(options.steps), 1, 100'000));
  options.move = members.number("move", options.move, 0.001, 1);
  options.projection = members.number("projection", 0, 0, 1000);
  options.change = members.number("change", options.change, 1e-6, 1);
}

void check_conditions(const fea::Study& fea, const Data& at, Diagnostics& diagnostics) {
  if (fea.loads.empty())
    diagnostics.error(Code::study, at.where, "a topology needs loads, and the study has none",
                      R"(write into "fea" for example "loads": [{"on": "zmax", "force_n": [0, 0, -10]}])");
  if (length(fea.gravity_mm_s2) > 0)
    diagnostics.error(Code::study, at.where,
                      "a topology takes no gravity, since weight goes with the densities that it searches for",
                      "leave gravity_mm_s2 out");
  for (const fea::Support& support : fea.supports)
    for (const auto& u : support.displacement_mm)
      if (u && *u != 0)
        return diagnostics.error(Code::study, support.on.where, "a topology takes supports that do not move",
                                 "write \"fix\", and forces as loads");
}

}  // namespace

std::optional<TopologyStudy> read_topology_study(const Data& data, Diagnostics& diagnostics) {
  std::vector<std::string> known = model_members;
  known.insert(known.begin(), "topology");
  StudyMembers members(data, "a study of topology", known, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  TopologyStudy study;
  read_topology(*members.find("topology"), study.options, diagnostics);
  if (const Data* goal = members.find("topology")->find("displacement"))
    study.goal = read_goal(*goal, study.is_greatest, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  auto model = read_model_choice(members, diagnostics);
  if (!model) return std::nullopt;
  study.model = std::move(*model);
  study.model.request.fill = FeaRequest::Fill::centre;  // densities are those of whole bricks
  check_conditions(study.model.fea, *members.find("fea"), diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return study;
}

}  // namespace ombre::compile
