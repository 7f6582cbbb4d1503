// `ombre probe` evaluates a design at single points.
#include <memory>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/probe/probe.h"
#include "jobs/probe/probe_choices.h"

namespace ombre::jobs {
namespace {

using compile::ProbeChoices;

DataMembers to_members(const std::vector<std::pair<std::string, double>>& values) {
  DataMembers members;
  for (const auto& [name, value] : values) members.emplace_back(name, Data(value));
  return members;
}

std::string for_people(const compile::ProbeResult& result) {
  std::string text = format_point(result.point, 6) + ": " + (result.inside ? "inside" : "outside") +
                     ", g = " + format_rounded(result.distance, 6) + " mm";
  for (const auto& [name, fraction] : result.composition) text += ", " + name + " " + format_rounded(fraction, 6);
  for (const auto& [name, value] : result.attributes) text += ", " + name + " = " + format_rounded(value, 6);
  if (!result.parts.empty()) text += "; in " + join(result.parts, ", ");
  return text + "\n";
}

int probe(const ProbeChoices& a, Session& session) {
  Diagnostics diagnostics;
  const auto loaded = load_design(a.design, session, diagnostics);
  const auto results = loaded ? compile::probe(*loaded, a.points, diagnostics) : std::nullopt;
  session.events.diagnose(diagnostics);
  if (!results) return wrong_input;
  for (const compile::ProbeResult& result : *results) {
    if (!session.events.wants_data()) {
      session.events.print(for_people(result));
      continue;
    }
    DataList parts;
    for (const std::string& part : result.parts) parts.emplace_back(part);
    session.events.event("point",
                         {{"at", Data(DataList{Data(result.point.x), Data(result.point.y), Data(result.point.z)})},
                          {"inside", Data(result.inside)},
                          {"distance_mm", Data(result.distance)},
                          {"composition", Data(to_members(result.composition))},
                          {"attributes", Data(to_members(result.attributes))},
                          {"parts", Data(std::move(parts))}});
  }
  return done;
}

}  // namespace

JobKind probe_kind() {
  return job_kind<ProbeChoices>("probe", "Say what a design is at single points: distance, materials, attributes",
                                "Example:\n  ombre probe part.vcad --at 0,0,2.5 --at 1,0,2.5\n", probe);
}

}  // namespace ombre::jobs
