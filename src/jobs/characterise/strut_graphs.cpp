#include "jobs/characterise/strut_graphs.h"

#include <algorithm>
#include <set>

#include "base/text/text.h"
#include "jobs/characterise/strut_places.h"
#include "jobs/mesh/beam_parts.h"
#include "jobs/mesh/strut_frames.h"

namespace ombre::compile {
namespace {

using design::Node;
using nodes::StrutShape;

// Struts of a node, and the steps in which they repeat; 0 if they do not.
struct Struts {
  std::vector<StrutShape> shapes;
  Vec3 period;
  bool knows_radii = true, are_bent = false;
};

// Returns null if there is no such parameter, or it is not given.
Data value_of(const Node& node, std::string_view parameter) {
  const int number = node.type().parameter(parameter);
  return number < 0 ? Data() : node.type().get(node, static_cast<size_t>(number), false);
}

// Returns edges as they are given: two points, or two points and a radius.
std::vector<StrutShape> shapes_of(const Data& edges, double common_radius) {
  const auto point = [](const Data& one) {
    const DataList& numbers = *one.list();
    return Vec3{*numbers[0].number(), *numbers[1].number(), *numbers[2].number()};
  };
  std::vector<StrutShape> shapes;
  for (const Data& one : *edges.list()) {
    const DataList& edge = *one.list();
    const double radius = edge.size() > 2 ? *edge[2].number() : common_radius;
    shapes.push_back({point(edge[0]), point(edge[1]), radius, radius});
  }
  return shapes;
}

// Returns a lattice on a map without the balls, fillets and materials that leave its struts where they are. If
// `radius` is not 0, its struts have that radius.
design::NodePtr plain(const Node& node, double radius, const design::MaterialTable& materials) {
  const design::NodeType& type = node.type();
  std::vector<design::NamedValue> values;
  for (const design::ParameterInfo& parameter : type.parameters) {
    if (parameter.name == "joint" || parameter.name == "blend" || parameter.name == "material") continue;
    const bool is_replaced = parameter.name == "radius" && radius > 0;
    Data data = is_replaced ? Data(radius) : value_of(node, parameter.name);
    if (!data.is_null()) values.push_back({&parameter, std::move(data)});
  }
  Diagnostics none;
  return design::make_node(type, values, {}, {materials, none, nullptr, node.where(), "", ""});
}

// Returns the struts of nodes on maps whose cells are equal boxes.
std::optional<Struts> in_equal_boxes(const Node& node, const design::MaterialTable& materials) {
  for (const double radius : {0.0, 1.0}) {
    const design::NodePtr lattice = plain(node, radius, materials);
    if (!lattice) return std::nullopt;
    if (auto made = nodes::struts_of(*lattice).struts)
      return Struts{std::move(made->struts), made->copies->steps, radius == 0};
  }
  return std::nullopt;
}

std::optional<Struts> struts_of(const Node& node, const design::MaterialTable& materials) {
  const auto output = node.type().output("struts");
  if (!output) return std::nullopt;
  const bool is_mapped = !value_of(node, "map").is_null();
  if (auto found = is_mapped ? in_equal_boxes(node, materials) : std::nullopt) return found;
  Struts found;
  if (auto made = is_mapped ? std::nullopt : nodes::struts_of(node).struts) {
    found.shapes = std::move(made->struts);
  } else {
    const Data radius = value_of(node, "radius");
    found.shapes = shapes_of(node.constant(*output), radius.number() ? *radius.number() : 0);
    found.knows_radii = std::ranges::all_of(found.shapes, [](const StrutShape& one) { return one.start_radius > 0; });
  }
  found.period = is_mapped ? Vec3{1, 1, 1} : node.traits().cell_size.value_or(Vec3{});
  found.are_bent = is_mapped;
  return found;
}

// Returns the greatest radius that a node's struts may have in the box.
double greatest_radius(const Node& node, const design::MaterialTable& materials, const Box& box) {
  const int number = node.type().parameter("radius");
  const design::ParameterInfo& parameter = node.type().parameters[static_cast<size_t>(number)];
  Diagnostics none;
  design::Number radius;
  const design::Reader reader{materials, none, nullptr, node.where(), node.type().name, parameter.name};
  if (!design::read(value_of(node, parameter.name), parameter.domain, radius, reader)) return Box::inf;
  return radius.range(box).hi;
}

// Removes struts that clearly lie outside of the node's region, as beams are removed. Radii that are not known become
// the greatest that is possible.
void leave_out_outside(const Node& node, const design::MaterialTable& materials, Struts& struts) {
  const Data held = value_of(node, "region");
  Diagnostics none;
  const design::NodePtr region = held.is_null() ? nullptr : solid_of(held, materials, node.where(), none);
  if (!region) return;
  BeamSet set{std::move(struts.shapes), formats::LatticeClipping::inside, region};
  const Box box = region->bounds(design::design_space());
  if (!struts.knows_radii) {
    const double greatest = greatest_radius(node, materials, box);
    for (StrutShape& strut : set.struts) strut.start_radius = strut.end_radius = greatest;
  }
  std::erase_if(set.struts, [&](const StrutShape& strut) { return intersect(reach(strut), box).is_empty(); });
  leave_out_clipped(set, materials, 1);
  struts.shapes = std::move(set.struts);
}

// Returns the graph of a node's struts at a place.
LatticeGraph graph_at(const StrutPlace& place, const Struts& struts) {
  LatticeGraph found;
  const SourceRange& where = place.node->where();
  found.node = place.node->type().name;
  found.line = where.source ? where.source->place(where.begin).line : 0;
  // Cells of maps repeat in their own frame, and others in that of a tile, if there is one.
  const bool is_tiled = !(place.steps == Vec3{}) && value_of(*place.node, "map").is_null();
  const Affine mm_from_node = place.mm_from_cell * place.cell_from_node;
  const Affine cell_from_node = is_tiled ? place.cell_from_node : Affine{};
  const Affine mm_from_cell = is_tiled ? place.mm_from_cell : mm_from_node;
  const auto scale = scale_of_similarity(mm_from_node);
  if (struts.are_bent) found.no_lengths = "cells are bent";
  if (found.no_lengths.empty()) found.no_lengths = place.lengths_may_change;
  found.no_slenderness = place.thickness_may_change;
  if (!scale) found.no_slenderness = "the scale is not the same along all axes";
  if (!struts.knows_radii) found.no_slenderness = "radii vary";
  std::vector<GraphStrut> all;
  for (const StrutShape& strut : struts.shapes)
    all.push_back({cell_from_node(strut.start), cell_from_node(strut.end),
                   scale.value_or(0) * 0.5 * (strut.start_radius + strut.end_radius)});
  const Vec3 period = is_tiled ? place.steps : struts.period;
  found.graph = graph_of(all, period, mm_from_cell);
  if (length(period) > 0) found.maxwell_of_cell = graph_of(all).maxwell();
  return found;
}

std::string spread_text(const Spread& spread, const std::string& unit) {
  const auto number = [](double value) { return format_rounded(value, 4); };
  if (spread.greatest - spread.least <= 1e-9 * spread.greatest) return number(spread.mean) + unit;
  return number(spread.least) + " to " + number(spread.greatest) + unit;
}

}  // namespace

std::vector<LatticeGraph> lattice_graphs_of(const design::Design& design) {
  std::vector<LatticeGraph> all;
  std::set<std::pair<const Node*, std::string>> known;  // what was said of nodes
  const Node* last = nullptr;
  std::optional<Struts> struts;
  for (const StrutPlace& place : strut_places(design)) {
    if (place.node != last) {
      last = place.node;
      struts = struts_of(*last, design.materials);
      if (struts) leave_out_outside(*last, design.materials, *struts);
    }
    if (!struts) continue;
    LatticeGraph found = graph_at(place, *struts);
    if (known.emplace(last, found.text()).second) all.push_back(std::move(found));
  }
  return all;
}

DataMembers LatticeGraph::data() const {
  DataMembers degrees;
  for (const auto& [degree, joints] : graph.joints_of_degree)
    degrees.emplace_back(std::to_string(degree), static_cast<double>(joints));
  DataMembers members{{"node", node},
                      {"line", static_cast<double>(line)},
                      {"repeats", maxwell_of_cell.has_value()},
                      {"joints", static_cast<double>(graph.joints)},
                      {"struts", static_cast<double>(graph.struts)},
                      {"joints_of_degree", degrees},
                      {"maxwell", static_cast<double>(maxwell_of_cell.value_or(graph.maxwell()))}};
  if (knows_lengths()) members.emplace_back("length_mm", graph.length.data());
  if (knows_slenderness()) members.emplace_back("slenderness", graph.slenderness.data());
  if (!no_lengths.empty()) members.emplace_back("lengths_left_out", no_lengths);
  if (!no_slenderness.empty()) members.emplace_back("slenderness_left_out", no_slenderness);
  return members;
}

std::string LatticeGraph::text() const {
  const auto counted = [](size_t count, const std::string& what) {
    return format_count(count) + ' ' + what + (count == 1 ? "" : "s");
  };
  std::vector<std::string> parts{node + (line > 0 ? ", line " + std::to_string(line) : "") + ": " +
                                 counted(graph.joints, "joint") + " and " + counted(graph.struts, "strut") +
                                 (maxwell_of_cell ? " in each cell" : "")};
  std::vector<std::string> degrees;
  for (const auto& [degree, joints] : graph.joints_of_degree)
    degrees.push_back(format_count(degree) + " at " + (joints == graph.joints ? "each" : format_count(joints)));
  if (!degrees.empty()) parts.push_back("struts meet: " + join(degrees, ", "));
  if (knows_lengths())
    parts.push_back("struts are " + spread_text(graph.length, " mm") + " long" +
                    (knows_slenderness() ? ", with a slenderness of " + spread_text(graph.slenderness, "") : ""));
  if (!no_lengths.empty())
    parts.push_back("lengths are left out, because " + no_lengths);
  else if (!no_slenderness.empty())
    parts.push_back("slenderness is left out, because " + no_slenderness);
  parts.push_back(std::string("Maxwell's number") + (maxwell_of_cell ? " of a cell alone" : "") + " is " +
                  std::to_string(maxwell_of_cell.value_or(graph.maxwell())));
  return join(parts, "; ");
}

}  // namespace ombre::compile
