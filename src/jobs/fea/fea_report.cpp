#include "jobs/fea/fea_report.h"

#include <algorithm>

#include "base/math/point_text.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "fea/solve/mesh_elastic.h"
#include "fea/solve/node_matrix.h"
#include "jobs/common/events.h"

namespace ombre::jobs {
namespace {

Data triple(Vec3 v) { return DataList{v.x, v.y, v.z}; }

std::string element_text(const fea::MeshView& mesh) {
  if (const fea::Bricks* bricks = mesh.bricks())
    return counted(mesh.count(), "brick") + " of " + format_rounded(bricks->size_mm.x) + " x " +
           format_rounded(bricks->size_mm.y) + " x " + format_rounded(bricks->size_mm.z) + " mm";
  return format_count(mesh.count()) + " tetrahedra " + mesh.shape().name;
}

void tell_quality(const Events& events, const compile::TetraModel& made) {
  const fea::MeshQuality& quality = made.quality;
  events.say("edges of " + format_rounded(quality.mean_edge_mm, 3) + " mm on average; dihedral angles from " +
             format_rounded(quality.least_dihedral, 3) + " to " + format_rounded(quality.most_dihedral, 4) +
             " degrees, aspect at most " + format_rounded(quality.worst_aspect, 3) + ", " +
             format_count(quality.inverted) + " inverted" +
             (made.surface_mm3 > 0 ? "; the surface has " + format_rounded(made.surface_mm3, 6) + " mm3" : ""));
  events.event("quality", {{"mean_edge_mm", quality.mean_edge_mm},
                           {"least_dihedral_degrees", quality.least_dihedral},
                           {"most_dihedral_degrees", quality.most_dihedral},
                           {"worst_aspect", quality.worst_aspect},
                           {"inverted", static_cast<double>(quality.inverted)},
                           {"surface_mm3", made.surface_mm3}});
}

std::string solved_text(const compile::FeaChoices& a, size_t iterations, bool is_direct, double seconds) {
  const std::string way = !a.has_own_solver() ? "by CalculiX in "
                          : is_direct         ? "by a factorisation and " + counted(iterations, "iteration") + " in "
                          : iterations == 0   ? "directly in "
                                              : "in " + counted(iterations, "iteration") + " and ";
  return "solved " + way + format_rounded(seconds, 3) + " s";
}

// The greatest of some values, with its index.
struct Greatest {
  size_t number = 0;
  double value = 0;

  explicit Greatest(const std::vector<double>& values)
      : number(static_cast<size_t>(std::ranges::max_element(values) - values.begin())), value(values[number]) {}
};

std::vector<double> von_mises_of(const std::vector<std::array<double, 6>>& stresses) {
  std::vector<double> values;
  for (const auto& stress : stresses) values.push_back(fea::von_mises(stress));
  return values;
}

void tell_solution(const compile::FeaChoices& a, const Events& events, const fea::MeshView& mesh,
                   const fea::Solution& solution, const fea::Stresses& stresses, double seconds) {
  size_t far = 0;
  for (size_t n = 0; n < solution.displacement_mm.size(); ++n)
    if (length(solution.displacement_mm[n]) > length(solution.displacement_mm[far])) far = n;
  const Greatest middle(von_mises_of(solution.stress_mpa)), points(stresses.greatest_at_points_mpa),
      nodes(von_mises_of(stresses.at_nodes_mpa));
  Vec3 reaction;
  for (const fea::Prescribed& here : solution.reactions_n) reaction[here.axis] += here.value;
  const Vec3 u = solution.displacement_mm[far];
  events.say(solved_text(a, solution.iterations, solution.direct.has_value(), seconds));
  events.say("moves by at most " + format_rounded(length(u)) + " mm, " + format_point(u) + " at " +
             format_point(mesh.node(far)));
  const auto stress_text = [](const Greatest& greatest, Vec3 place) {
    return format_rounded(greatest.value) + " MPa, at " + format_point(place);
  };
  events.say("von Mises stress at most " + stress_text(middle, mesh.centroid(middle.number)) +
             ", in the middle of an element");
  events.say("  at an integration point at most " + stress_text(points, mesh.centroid(points.number)) +
             "; at a node, averaged within a material, " + stress_text(nodes, mesh.node(nodes.number)));
  events.say("the supports hold with " + format_point(reaction, 5) + " N; strain energy " +
             format_rounded(solution.energy_mj, 5) + " mJ");
  events.event("solution", {{"iterations", static_cast<double>(solution.iterations)},
                            {"residual", solution.residual},
                            {"seconds", seconds},
                            {"greatest_displacement_mm", triple(u)},
                            {"greatest_displacement_at_mm", triple(mesh.node(far))},
                            {"greatest_von_mises_mpa", middle.value},
                            {"greatest_von_mises_at_mm", triple(mesh.centroid(middle.number))},
                            {"greatest_von_mises_at_points_mpa", points.value},
                            {"greatest_von_mises_at_points_at_mm", triple(mesh.centroid(points.number))},
                            {"greatest_von_mises_at_nodes_mpa", nodes.value},
                            {"greatest_von_mises_at_nodes_at_mm", triple(mesh.node(nodes.number))},
                            {"reaction_n", triple(reaction)},
                            {"strain_energy_mj", solution.energy_mj}});
}

void tell_conduction(const compile::FeaChoices& a, const Events& events, const Case& here, const fea::Conduction& found,
                     double seconds) {
  const fea::PhysicsWords& words = fea::words_of(here.conditions.physics);
  const fea::ModelView model = here.view();
  const auto [least, most] = std::ranges::minmax_element(found.value);
  std::vector<double> flux;
  for (const Vec3& v : found.flux) flux.push_back(length(v));
  const auto strong = static_cast<size_t>(std::ranges::max_element(flux) - flux.begin());
  double enters = 0, leaves = found.lost_w;
  const auto add = [&](double flow) { flow > 0 ? enters += flow : leaves -= flow; };
  for (const fea::Prescribed& flow : found.flows) add(flow.value);
  for (const fea::Prescribed& flow : here.conditions.forces) add(flow.value);
  const std::string flow_unit = " " + words.flow.unit, of_flow = to_lower(words.flow.unit);
  events.say(solved_text(a, found.iterations, found.direct.has_value(), seconds));
  events.say(words.potential.name + "s from " + format_rounded(*least) + " to " + format_rounded(*most) + " " +
             words.potential.unit + ", the latter at " +
             format_point(model.mesh.node(static_cast<size_t>(most - found.value.begin()))));
  events.say(words.flux.name + " at most " + format_rounded(flux[strong]) + flow_unit + "/mm2, at " +
             format_point(model.mesh.centroid(strong)));
  events.say(format_rounded(enters, 5) + flow_unit + " enter, " + format_rounded(leaves, 5) + flow_unit + " leave");
  events.event("solution", {{"iterations", static_cast<double>(found.iterations)},
                            {"residual", found.residual},
                            {"seconds", seconds},
                            {"least_" + words.potential.member, *least},
                            {"greatest_" + words.potential.member, *most},
                            {"greatest_" + words.flux_event, flux[strong]},
                            {"enters_" + of_flow, enters},
                            {"leaves_" + of_flow, leaves}});
}

}  // namespace

double Case::solve_bytes() const {
  const fea::ModelView model = view();
  if (const fea::Bricks* bricks = model.mesh.bricks())
    return is_mechanics() ? fea::solve_bytes(*bricks) : fea::conduct_bytes(*bricks);
  return fea::system_bytes(model.mesh, is_mechanics() ? 3 : 1);
}

std::string counted(size_t count, const std::string& what) {
  return format_count(count) + " " + what + (count == 1 ? "" : "s");
}

void tell_model(const Events& events, const Case& here) {
  const fea::ModelView model = here.view();
  const double bytes = here.solve_bytes(), volume = model.mesh.total_volume_mm3();
  events.say(element_text(model.mesh) + ", " + format_count(model.mesh.node_count()) + " nodes, " +
             counted(model.sections.size(), "section") + ", " + format_rounded(volume, 6) +
             " mm3; solving takes about " + format_bytes(bytes));
  DataList sections;
  for (const fea::Section& section : model.sections) {
    if (here.is_mechanics())
      sections.push_back(DataMembers{{"name", section.name},
                                     {"modulus_mpa", section.elastic.modulus_mpa},
                                     {"poissons_ratio", section.elastic.poissons_ratio}});
    else
      sections.push_back(DataMembers{{"name", section.name}, {"conductivity", section.conductivity}});
  }
  events.event("model", {{here.tetrahedra() ? "tetrahedra" : "bricks", static_cast<double>(model.mesh.count())},
                         {"nodes", static_cast<double>(model.mesh.node_count())},
                         {"sections", sections},
                         {"volume_mm3", volume},
                         {"memory_bytes", bytes}});
  if (here.tetrahedra()) tell_quality(events, *here.tetrahedra());
}

void tell_factorisation(const Events& events, const fea::DirectUse& use) {
  events.say("factorising the equations: about " + format_rounded(use.operations, 2) + " operations and " +
             format_bytes(use.memory_bytes) + " more" +
             (use.disk_bytes > 0 ? ", with " + format_bytes(use.disk_bytes) + " on disk" : ""));
  events.event("factorisation",
               {{"operations", use.operations}, {"memory_bytes", use.memory_bytes}, {"disk_bytes", use.disk_bytes}});
}

void tell_results(const compile::FeaChoices& a, const Events& events, const Case& here,
                  const compile::FeaResults& results, double seconds) {
  if (results.solution) tell_solution(a, events, here.view().mesh, *results.solution, *results.stresses, seconds);
  if (results.conduction) tell_conduction(a, events, here, *results.conduction, seconds);
}

}  // namespace ombre::jobs
