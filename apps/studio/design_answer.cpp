#include "studio/design_answer.h"

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "base/text/text.h"
#include "design/outputs.h"
#include "design/ports/places.h"
#include "jobs/picture/design_scene.h"
#include "lang/openscad/customizer.h"
#include "questions/question.h"

namespace ombre::studio {
namespace {

constexpr size_t most_nodes = 3000;

// True if the node evaluates its inputs, or the value that it reads, at other points than its own.
bool evaluates_elsewhere(const design::Node& node) {
  constexpr std::array<std::string_view, 3> categories{"transforms", "warps", "maps"};
  return std::ranges::find(categories, node.type().category) != categories.end() || node.type().name == "at";
}

class NodeLister {
 public:
  NodeLister(const design::Design& design, const SourcePtr& source)
      : nodes_(listed_nodes(design)), source_(source), offsets_(source->text()) {
    for (size_t n = 0; n < nodes_.size(); ++n) numbers_.emplace(nodes_[n], n);
    for (const design::Part& part : design.parts) frames_.emplace(part.solid.get(), Affine());
    // Nodes come before those that are first found below them.
    for (const design::Node* node : nodes_) add_frames_below(*node);
  }

  DataList list() const {
    DataList list;
    for (size_t n = 0; n < nodes_.size(); ++n) list.emplace_back(describe_one(*nodes_[n], n));
    return list;
  }
  DataList numbers(const std::vector<design::NodePtr>& nodes) const { return numbers(std::span(nodes)); }
  // Returns what statements make that are no calls of nodes: where they begin, and the numbers of their solids. Of
  // expressions, where they stand, and the numbers of their values.
  DataList made(const ScriptResults& results) const {
    DataList list;
    for (const auto& [begin, solids] : results.solids())
      if (DataList found = numbers(solids); found.size() == solids.size())
        list.emplace_back(DataMembers{{"from", offsets_.at(begin)}, {"nodes", std::move(found)}});
    for (size_t n = 0; n < results.values().size(); ++n) {
      const SourceRange& expression = results.values()[n].expression;
      list.emplace_back(DataMembers{
          {"from", offsets_.at(expression.begin)}, {"to", offsets_.at(expression.end)}, {"value", number(n)}});
    }
    return list;
  }

 private:
  DataList numbers(std::span<const design::NodePtr> nodes) const {
    DataList list;
    for (const design::NodePtr& node : nodes)
      if (const auto known = numbers_.find(node.get()); known != numbers_.end())
        list.emplace_back(number(known->second));
    return list;
  }

  // Returns a node's ports, to which nodes are connected: the solids that it takes, and the parameters that contain
  // nodes.
  DataList ports(const design::Node& node) const {
    DataList ports;
    const auto add = [&](const std::string& name, std::string_view type, DataList edges) {
      if (edges.empty()) return;
      ports.emplace_back(DataMembers{{"name", name}, {"type", std::string(type)}, {"from", std::move(edges)}});
    };
    DataList solids;
    for (const design::NodePtr& input : node.inputs()) add_edge(*input, "", solids);
    add(node.type().inputs.most == 1 ? "solid" : "solids", "solid", std::move(solids));
    if (node.values().empty()) return ports;
    const auto& parameters = node.type().parameters;
    for (size_t n = 0; n < parameters.size(); ++n) {
      DataList edges;
      add_edges(node.type().get(node, n, false), "", edges);
      add(parameters[n].name, parameters[n].text.kind, std::move(edges));
    }
    return ports;
  }

  // Adds an edge from each node in a parameter's data; `output` is the output that the data names.
  void add_edges(const Data& data, const std::string& output, DataList& edges) const {
    if (const auto object = std::dynamic_pointer_cast<const design::NodeObject>(data.host_object()))
      return add_edge(*object->node(), output, edges);
    if (const DataList* list = data.list())
      for (const Data& element : *list) add_edges(element, "", edges);
    if (!data.members()) return;
    const Data* named = data.find("output");
    for (const auto& [name, member] : *data.members())
      add_edges(member, name == "from" && named && named->string() ? *named->string() : "", edges);
  }

  void add_edge(const design::Node& from, const std::string& output, DataList& edges) const {
    const auto known = numbers_.find(&from);
    if (known == numbers_.end()) return;
    DataMembers edge{{"node", number(known->second)}};
    if (!output.empty()) edge.emplace_back("output", output);
    if (const Data added(std::move(edge)); std::ranges::find(edges, added) == edges.end()) edges.push_back(added);
  }

  void add_frames_below(const design::Node& node) {
    const std::optional<Affine> here = frames_.at(&node);
    std::optional<Affine> of_inputs = here, of_values = here;
    if (evaluates_elsewhere(node)) {
      const auto map = here ? design::here_from_input(node) : std::nullopt;
      of_inputs = map ? std::optional(*here * *map) : std::nullopt;
      if (node.inputs().empty()) of_values = std::nullopt;
    }
    for (const design::NodePtr& input : node.inputs()) frames_.emplace(input.get(), of_inputs);
    for (const design::NodePtr& value : node.values()) frames_.emplace(value.get(), of_values);
  }

  // Returns the rows of the map from the node's space to the design's where it is first used; null if there is no
  // affine one.
  Data frame(const design::Node& node) const {
    const std::optional<Affine>& frame = frames_.at(&node);
    return frame ? design::write(*frame, false) : Data();
  }

  DataMembers describe_one(const design::Node& node, size_t id) const {
    DataMembers members{{"id", number(id)}, {"category", node.type().category}, {"ports", ports(node)}};
    static const Data own = design::write(Affine(), false);
    if (Data rows = frame(node); !(rows == own)) members.emplace_back("frame", std::move(rows));
    const DataMembers call = describe_call(node, source_, offsets_);
    members.insert(members.end(), call.begin(), call.end());
    return members;
  }

  std::vector<const design::Node*> nodes_;
  const SourcePtr& source_;
  PageOffsets offsets_;
  std::unordered_map<const design::Node*, size_t> numbers_;
  std::unordered_map<const design::Node*, std::optional<Affine>> frames_;
};

DataMembers describe_material(const design::Material& material) {
  DataList colour;
  for (const uint8_t channel : material.colour) colour.emplace_back(number(channel));
  DataMembers members{{"name", material.name}, {"id", number(material.id)}, {"colour", std::move(colour)}};
  for (const auto& [name, value] : material.properties)
    if (name == "density") members.emplace_back(name, value);
  return members;
}

DataList describe_materials(const OpenDesign& open) {
  const design::Design& design = open.loaded->design;
  Diagnostics ignored;
  const auto used = compile::materials_within(design, open.bounds, 0, ignored, &open.memory);
  DataList list;
  for (const design::Material& material : design.materials.all())
    if (material.id > 0 && (!used || std::ranges::find(*used, material.id) != used->end()))
      list.emplace_back(describe_material(material));
  return list;
}

// Returns the comment after a value in a .vcad script, such as "// mm, of the plate"; comments that state a range do
// not count.
std::string remark_behind(const SourceText& source, const SourceRange& value) {
  const Place place = source.place(value.end);
  const std::string_view line = source.line(place.line);
  const size_t begin = line.find("//", line.find(';'));
  if (begin == std::string_view::npos) return "";
  const std::string_view comment = trim(line.substr(begin + 2));
  return comment.starts_with('[') ? "" : std::string(comment);
}

}  // namespace

std::vector<const design::Node*> listed_nodes(const design::Design& design) {
  std::vector<const design::Node*> nodes;
  std::unordered_set<const design::Node*> known;
  const auto add = [&](const design::NodePtr& node) {
    if (known.insert(node.get()).second) nodes.push_back(node.get());
  };
  for (const design::Part& part : design.parts) add(part.solid);
  for (size_t n = 0; n < nodes.size(); ++n)
    for (const design::NodePtr& node : nodes[n]->dependencies())
      if (nodes.size() < most_nodes) add(node);
  return nodes;
}

DataMembers describe_call(const design::Node& node, const SourcePtr& page_text, const PageOffsets& offsets) {
  DataMembers members{{"type", node.type().name}};
  const SourceRange& where = node.where();
  if (where.begin == where.end) return members;  // no call, as for a script's union of everything that it shows
  if (!where.source || where.source->name() != page_text->name()) return members;
  members.emplace_back("from", offsets.at(where.begin));
  members.emplace_back("to", offsets.at(where.end));
  members.emplace_back("line", number(where.source->place(where.begin).line));
  return members;
}

std::set<std::string> design_files(const design::Design& design) {
  std::vector<design::NodePtr> roots;
  for (const design::Part& part : design.parts) roots.push_back(part.solid);
  std::set<std::string> files;
  for (const design::Node* node : design::topological(roots)) {
    const auto& parameters = node->type().parameters;
    for (size_t n = 0; n < parameters.size(); ++n) {
      if (parameters[n].text.kind != "file") continue;
      const Data path = node->type().get(*node, n, false);
      if (path.string() && !path.string()->empty()) files.insert(*path.string());
    }
  }
  return files;
}

DataList list_of(Vec3 v) { return {v.x, v.y, v.z}; }

DataList describe_variables(const SourcePtr& source) {
  const PageOffsets offsets(source->text());
  DataList list;
  for (lang::openscad::Parameter& parameter : lang::openscad::parameters_of(source)) {
    if (parameter.section == "Hidden") continue;
    if (const std::string remark = remark_behind(*source, parameter.value.where); !remark.empty())
      parameter.description = remark;
    Data data = lang::openscad::to_data(parameter);
    auto& members = std::get<DataMembers>(data.value);
    members.emplace_back("from", offsets.at(parameter.value.where.begin));
    members.emplace_back("to", offsets.at(parameter.value.where.end));
    list.push_back(std::move(data));
  }
  return list;
}

DataMembers describe_design(const OpenDesign& open, const SourcePtr& page_text) {
  const design::Design& design = open.loaded->design;
  DataList parts, attributes;
  for (const design::Part& part : design.parts) parts.emplace_back(part.name);
  for (const design::AttributeDeclaration& declared : compile::declared_attributes(design))
    attributes.emplace_back(DataMembers{
        {"name", declared.name}, {"type", std::string(design::name(declared.type))}, {"unit", declared.unit}});
  const NodeLister lister(design, page_text);
  return {{"design", open.handle},
          {"bounds_mm", DataList{list_of(open.bounds.lo), list_of(open.bounds.hi)}},
          {"materials", describe_materials(open)},
          {"parts", std::move(parts)},
          {"attributes", std::move(attributes)},
          {"part_nodes", lister.numbers(design.roots())},
          {"nodes", lister.list()},
          {"made", lister.made(open.results)}};
}

}  // namespace ombre::studio
