// Small pictures of the nodes of a design, and of the values of expressions in its script: solids from a corner, values
// as colours on the slice through the middle of the design. They are cached by the hash of the node and everything
// below it, so that an edit only renders changed nodes again.
#include "design/outputs.h"
#include "formats/images/png.h"
#include "jobs/picture/picture.h"
#include "load/node_registry.h"
#include "studio/design_answer.h"
#include "studio/views.h"

namespace ombre::studio {
namespace {

constexpr int64_t most_thumbnail = 256;  // pixels
constexpr double most_seconds = 2;       // time limit of one thumbnail, because others wait
constexpr const char* view = "iso";

constexpr const char* shown_value = "value";

// Returns a design that consists only of the solid.
compile::Loaded alone(const compile::Loaded& loaded, design::NodePtr solid) {
  design::Design design;
  design.materials = loaded.design.materials;
  design.parts = {{"", std::move(solid)}};
  return {loaded.path, loaded.source, std::move(design)};
}

design::NodePtr make(const char* name, const design::Design& design,
                     const std::vector<std::pair<const char*, Data>>& arguments, std::vector<design::NodePtr> inputs) {
  const design::NodeType& type = *compile::node_registry().find(name);
  std::vector<design::NamedValue> values;
  for (const auto& [parameter, data] : arguments)
    values.push_back({&type.parameters[static_cast<size_t>(type.parameter(parameter))], data});
  Diagnostics diagnostics;
  const design::Reader reader{design.materials, diagnostics, nullptr, {}, type.name, ""};
  auto node = design::make_node(type, values, std::move(inputs), reader);
  if (!node) throw design_error(diagnostics);
  return node;
}

// Returns a block around the design, made of the mixture, or with the value as an attribute.
design::NodePtr block_of(const OpenDesign& open, const Data& value) {
  const design::Design& design = open.loaded->design;
  const Vec3 size = open.bounds.size(), middle = open.bounds.center();
  const bool is_mixture = design::is_mixture(value);
  std::vector<std::pair<const char*, Data>> arguments{{"size", list_of(size)}};
  if (is_mixture) arguments.emplace_back("material", value);
  const auto block = make("translate", design, {{"by", list_of(middle)}}, {make("rectprism", design, arguments, {})});
  return is_mixture ? block : make("attribute", design, {{"name", shown_value}, {"value", value}}, {block});
}

compile::Loaded shown_solids(const OpenDesign& open, const std::vector<design::NodePtr>& solids,
                             compile::PictureRequest& picture) {
  picture.view = *render::named_view(view);
  return alone(*open.loaded, solids.size() == 1 ? solids.front() : make("union", open.loaded->design, {}, solids));
}

// Refuses what only exists in the cells of a tile.
design::NodePtr without_cell(design::NodePtr node) {
  if (node->uses_cell()) throw RequestError("unsupported", "the value depends on the cell that repeats it");
  return node;
}

compile::Loaded shown_value_of(const OpenDesign& open, const Data& value, compile::PictureRequest& picture) {
  picture.slice = compile::SliceView{2, open.bounds.center().z};
  if (!design::is_mixture(value)) picture.by = shown_value;
  return alone(*open.loaded, without_cell(block_of(open, value)));
}

bool is_solid(const OpenDesign& open, const Data& value) {
  Diagnostics ignored;
  std::vector<design::NodePtr> held;
  const design::Reader reader{open.loaded->design.materials, ignored, nullptr, {}, "", "", nullptr, &held};
  return design::read_solid(value, reader).has_value();
}

Data data_of(design::NodePtr node) {
  return Data(HostObjectPtr(std::make_shared<design::NodeObject>(std::move(node))));
}

design::NodePtr not_held(const design::Node& node) { return {design::NodePtr(), &node}; }

// Returns the design for the thumbnail of several solids together, or of one node.
compile::Loaded shown_nodes(const OpenDesign& open, const std::vector<const design::Node*>& nodes,
                            compile::PictureRequest& picture) {
  if (!nodes.front()->type().is_solid()) return shown_value_of(open, data_of(not_held(*nodes.front())), picture);
  std::vector<design::NodePtr> solids;
  for (const design::Node* one : nodes) solids.push_back(not_held(*one));
  return shown_solids(open, solids, picture);
}

// Returns the node of a request, or its nodes, which are solids then.
std::vector<const design::Node*> nodes_of(const OpenDesign& design, const Request& request) {
  const std::vector<const design::Node*> known = listed_nodes(design.loaded->design);
  const auto node_of = [&](const Request& one) {
    const design::Node& node =
        *known[static_cast<size_t>(one.whole("node", 0, static_cast<int64_t>(known.size()) - 1))];
    if (node.uses_cell()) throw RequestError("unsupported", node.type().name + " depends on the cell that repeats it");
    return &node;
  };
  if (!request.body.find("nodes")) return {node_of(request)};
  std::vector<const design::Node*> nodes;
  const DataList* list = request.body.find("nodes")->list();
  if (!list || list->empty()) throw RequestError("request", "\"nodes\" is a list of numbers of solids");
  for (const Data& one : *list) {
    nodes.push_back(node_of({request.id, request.what, request.lane, Data(DataMembers{{"node", one}})}));
    if (!nodes.back()->type().is_solid()) throw RequestError("request", "\"nodes\" are solids");
  }
  return nodes;
}

// Returns the design for the thumbnail of what a request names: a node, solids together, or the value of an expression.
// It must not outlive the nodes of the whole design.
compile::Loaded shown(const OpenDesign& open, const Request& request, compile::PictureRequest& picture) {
  if (!request.body.find("value")) return shown_nodes(open, nodes_of(open, request), picture);
  const auto& values = open.results.values();
  if (values.empty()) throw RequestError("request", "the design has no values of expressions to show");
  const int64_t n = request.whole("value", 0, static_cast<int64_t>(values.size()) - 1);
  const Data& value = values[static_cast<size_t>(n)].value;
  if (!is_solid(open, value)) return shown_value_of(open, value, picture);
  return shown_solids(open, {without_cell(make("solid_of", open.loaded->design, {{"solid", value}}, {}))}, picture);
}

std::string made_now(const compile::Loaded& loaded, const compile::PictureRequest& picture, const StopFlag& stop) {
  std::string png;
  Diagnostics diagnostics;
  const auto take = [&](int, const compile::Picture& made) {
    png = formats::encode_png(static_cast<uint32_t>(picture.width), static_cast<uint32_t>(picture.height), made.rgba);
  };
  if (!compile::take_pictures(loaded, picture, stop, take, diagnostics) || diagnostics.has_errors())
    throw design_error(diagnostics);
  return png;
}

}  // namespace

Answer thumbnail_answer(OpenDesign& design, const Request& request, const StopFlag& cancelled) {
  compile::PictureRequest picture;
  const compile::Loaded loaded = shown(design, request, picture);
  picture.width = request.whole("width", 1, most_thumbnail);
  picture.height = request.whole("height", 1, most_thumbnail);
  picture.samples = 1;
  picture.background.is_transparent = true;
  picture.memory = &design.memory;
  const Hash key = hash_bytes("thumbnail " + design::hash(loaded.design).hex() + ' ' + std::to_string(picture.width) +
                              ' ' + std::to_string(picture.height));
  if (const auto known = design.memory.find(key)) return {{}, *std::static_pointer_cast<const std::string>(known)};
  const StopFlag stop(&cancelled, most_seconds);
  const auto png = std::make_shared<const std::string>(made_now(loaded, picture, stop));
  if (stop.requested()) throw Cancelled();
  design.memory.keep(key, png, png->size());
  return {{}, *png};
}

}  // namespace ombre::studio
