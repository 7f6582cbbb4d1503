#include "jobs/optimise/topology_study.h"

#include "base/text/record.h"

namespace ombre::compile {
namespace {

// The place is that of a load of the study, the direction its force.
Record<TopologyStudy> goal_record() {
  using L = fea::Load;
  const Record<L> load("a displacement of a topology",
                       {field::value("on", &L::on, fea::read_selection).required(fea::selection_help),
                        field::value("direction", &L::force_n, fea::read_direction)
                            .required("write along what it is measured, for example \"direction\": [0, 0, -1]")});
  return Record<TopologyStudy>("a displacement of a topology",
                               {field::choice("goal", &TopologyStudy::is_greatest, {"least", "greatest"})})
      .with(&TopologyStudy::goal, load);
}

void read_goal(TopologyStudy& study, const Data& data, const MemberReader& reader) {
  goal_record().read(data, study, reader);
}

void read_topology(TopologyStudy& study, const Data& data, const MemberReader& reader) {
  using O = optimise::TopologyOptions;
  constexpr double longest_mm = 1e6;
  const Record<O> options(
      "a topology",
      {field::number("volume_fraction", &O::volume_fraction, {0.01, 1}).required(),
       field::number("radius", &O::radius_mm, {0, longest_mm}), field::number("penalty", &O::penalty, {1, 10}),
       field::whole("steps", &O::steps, 1, 100'000), field::number("move", &O::move, {0.001, 1}),
       field::number("projection", &O::projection, {0, 1000}), field::number("change", &O::change, {1e-6, 1})});
  study.options.radius_mm = 0;
  Record<TopologyStudy>("a topology", {field::special("displacement", read_goal)})
      .with(&TopologyStudy::options, options)
      .read(data, study, reader);
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
  const Record<TopologyStudy> record =
      Record<TopologyStudy>("a study of topology", {field::special("topology", read_topology).required()})
          .with(&TopologyStudy::model, model_record(Solves::often));
  TopologyStudy study;
  if (!record.read(data, study, MemberReader(diagnostics, Code::study_value))) return std::nullopt;
  study.model.sections.fill = FeaRequest::Fill::centre;  // densities are those of whole bricks
  check_conditions(study.model.fea, *data.find("fea"), diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return study;
}

}  // namespace ombre::compile
