#include "lang/vcad/scad_words.h"

#include <algorithm>

#include "base/text/text.h"
#include "lang/vcad/legacy_forms.h"
#include "lang/vcad/scad_tree.h"

namespace ombre::lang {
namespace {

using design::NodePtr;
using design::NodeType;

// True for solids except `part`; parts are made by the script language itself.
bool is_own_word(const NodeType& type) { return type.is_solid() && type.name != "part"; }

void give_children(Invocation& call, const std::vector<NodePtr>& children) {
  for (const NodePtr& child : children) {
    call.children.push_back(child);
    call.group_ends.push_back(call.children.size());
  }
}

}  // namespace

ScadWords::ScadWords(const design::Registry& registry, const design::MaterialTable& materials,
                     design::SourceLoader* loader, std::string script)
    : registry_(registry),
      materials_(materials),
      loader_(loader),
      script_(std::move(script)),
      vocabulary_(registry, materials, loader) {}

bool ScadWords::makes_solid(std::string_view word) const {
  const NodeType* type = registry_.find(node_name(word));
  return type && is_own_word(*type);
}

bool ScadWords::gives_value(std::string_view word) const { return vocabulary_.gives_value(word); }

std::vector<std::string> ScadWords::names() const {
  std::vector<std::string> names;
  for (const auto& type : registry_.types())
    if (is_own_word(*type)) names.push_back(type->name);
  return names;
}

std::optional<Value> ScadWords::value(Invocation call, Diagnostics& diagnostics, Meter& meter) {
  return vocabulary_.value(std::move(call), diagnostics, meter);
}

std::shared_ptr<const void> ScadWords::make(Invocation call, const std::vector<solids::TreePtr>& children,
                                            Diagnostics& diagnostics) {
  const NodeType& type = *registry_.find(node_name(call.name));
  WordSolids solids = type.inputs.most == 1 ? made_for_parts(call, children, diagnostics)
                                            : made_of_all(std::move(call), children, diagnostics);
  if (diagnostics.has_errors()) return nullptr;
  std::erase_if(solids, [](const WordSolid& solid) { return solid.node->is_nothing(); });
  return std::make_shared<const WordSolids>(std::move(solids));
}

WordSolids ScadWords::made_for_parts(const Invocation& call, const std::vector<solids::TreePtr>& children,
                                     Diagnostics& diagnostics) {
  const auto made = [&](const std::vector<NodePtr>& inputs) {
    Invocation own = call;
    give_children(own, inputs);
    return std::static_pointer_cast<const design::Node>(vocabulary_.make(std::move(own), diagnostics));
  };
  WordSolids solids = ScadTreeReader(registry_, materials_, loader_, script_, diagnostics).group(children);
  if (diagnostics.has_errors()) return {};
  if (solids.empty()) solids.push_back({"", nullptr});
  for (WordSolid& solid : solids) {
    solid.node = made(solid.node ? std::vector{solid.node} : std::vector<NodePtr>{});
    if (!solid.node) return {};
  }
  return solids;
}

WordSolids ScadWords::made_of_all(Invocation call, const std::vector<solids::TreePtr>& children,
                                  Diagnostics& diagnostics) {
  const NodeType& type = *registry_.find(node_name(call.name));
  ScadTreeReader reader(registry_, materials_, loader_, script_, diagnostics);
  std::vector<NodePtr> inputs;
  std::string part;
  for (const solids::TreePtr& child : children) {
    const WordSolids solids = reader.group({child});
    if (diagnostics.has_errors()) return {};
    if (!solids.empty() && part.empty()) part = solids.front().part;
    NodePtr node = reader.joined(solids, child->where);
    inputs.push_back(node ? node : design::make_nothing(type, child->where));
  }
  give_children(call, inputs);
  auto node = std::static_pointer_cast<const design::Node>(vocabulary_.make(std::move(call), diagnostics));
  return node ? WordSolids{{part, std::move(node)}} : WordSolids{};
}

std::optional<design::Design> ScadWords::finish(const solids::TreePtr& tree, const SourceRange& whole,
                                                Diagnostics& diagnostics) {
  ScadTreeReader reader(registry_, materials_, loader_, script_, diagnostics);
  const WordSolids solids = reader.group({tree});
  if (diagnostics.has_errors()) return std::nullopt;
  design::Design design{materials_, {}, {}};
  for (const WordSolid& solid : solids)
    if (!solid.node->is_nothing())
      design.parts.push_back({solid.part.empty() ? std::string(design::nameless_part) : solid.part, solid.node});
  if (!design.parts.empty()) return design;
  diagnostics.error(Code::nothing_inside, whole, "the script makes no solid");
  return std::nullopt;
}

}  // namespace ombre::lang
