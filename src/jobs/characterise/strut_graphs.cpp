#include "jobs/characterise/strut_graphs.h"

#include "base/text/text.h"
#include "design/registry.h"
#include "nodes/common/struts.h"

namespace ombre::compile {
namespace {

std::vector<GraphStrut> struts_in(const Data& data) {
  const auto point = [](const Data& one) {
    const DataList& numbers = *one.list();
    return Vec3{*numbers[0].number(), *numbers[1].number(), *numbers[2].number()};
  };
  std::vector<GraphStrut> struts;
  for (const Data& one : *data.list()) struts.push_back({point((*one.list())[0]), point((*one.list())[1])});
  return struts;
}

// Struts of a node, and the steps in which they repeat; 0 if they do not.
struct Repeated {
  std::vector<GraphStrut> struts;
  Vec3 period;
  bool knows_lengths = true;
};

std::optional<Repeated> repeated_struts(const design::Node& node) {
  const design::NodeType& type = node.type();
  const auto output = type.output("struts");
  if (!nodes::makes_struts(node) || !output) return std::nullopt;
  const int map = type.parameter("map");
  const bool is_mapped = map >= 0 && !type.get(node, static_cast<size_t>(map), false).is_null();
  Repeated found;
  if (const auto made = nodes::struts_of(node).struts) {
    for (const nodes::StrutShape& strut : made->struts)
      found.struts.push_back({strut.start, strut.end, 0.5 * (strut.start_radius + strut.end_radius)});
    found.period = made->copies ? made->copies->steps : node.traits().cell_size.value_or(Vec3{});
    return found;
  }
  found.struts = struts_in(node.constant(*output));
  found.period = is_mapped ? Vec3{1, 1, 1} : node.traits().cell_size.value_or(Vec3{});
  found.knows_lengths = !is_mapped;
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
  for (const design::Node* node : design::topological(design.roots())) {
    const auto repeated = repeated_struts(*node);
    if (!repeated) continue;
    const SourceRange& where = node->where();
    LatticeGraph& found = all.emplace_back();
    found.node = node->type().name;
    found.line = where.source ? where.source->place(where.begin).line : 0;
    found.graph = graph_of(repeated->struts, repeated->period);
    found.knows_lengths = repeated->knows_lengths;
    if (length(repeated->period) > 0) found.maxwell_of_cell = graph_of(repeated->struts).maxwell();
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
  if (knows_lengths) members.emplace_back("length_mm", graph.length.data());
  if (knows_lengths && graph.slenderness.mean > 0) members.emplace_back("slenderness", graph.slenderness.data());
  return members;
}

std::string LatticeGraph::text() const {
  const auto counted = [](size_t count, const std::string& what) {
    return format_count(count) + ' ' + what + (count == 1 ? "" : "s");
  };
  std::string text = node + (line > 0 ? ", line " + std::to_string(line) : "") + ": " + counted(graph.joints, "joint") +
                     " and " + counted(graph.struts, "strut") + (maxwell_of_cell ? " in each cell; " : "; ");
  std::vector<std::string> degrees;
  for (const auto& [degree, joints] : graph.joints_of_degree)
    degrees.push_back(format_count(degree) + " at " + (joints == graph.joints ? "each" : format_count(joints)));
  text += "struts meet: " + join(degrees, ", ");
  if (knows_lengths) text += "; struts are " + spread_text(graph.length, " mm") + " long";
  if (knows_lengths && graph.slenderness.mean > 0)
    text += ", with a slenderness of " + spread_text(graph.slenderness, "");
  return text + "; Maxwell's number" + (maxwell_of_cell ? " of a cell alone" : "") + " is " +
         std::to_string(maxwell_of_cell.value_or(graph.maxwell()));
}

}  // namespace ombre::compile
