#include "lang/vcad/scad_tree.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "design/nearest_material.h"
#include "design/source_loader.h"
#include "lang/openscad/csg_text.h"
#include "lang/openscad/script_evaluator.h"
#include "solids/colour_bytes.h"

namespace ombre::lang {
namespace {

using design::NamedValue;
using design::NodePtr;
using design::NodeType;
using design::Reader;
using solids::Semantics;
using solids::Tree;
using solids::TreePtr;

const design::ParameterInfo* parameter_of(const NodeType& type, std::string_view name) {
  return &type.parameters[static_cast<size_t>(type.parameter(name))];
}

Data matrix_of(const Affine& map) {
  DataList rows;
  for (int row = 0; row < 3; ++row) {
    const Vec3 r = map.rows[static_cast<size_t>(row)];
    rows.emplace_back(DataList{Data(r.x), Data(r.y), Data(r.z), Data(map.offset[row])});
  }
  rows.emplace_back(DataList{Data(0.0), Data(0.0), Data(0.0), Data(1.0)});
  return {std::move(rows)};
}

// Returns the name of the call at that position: "hull".
std::string called_name(const SourceRange& where) {
  if (!where.source) return "this";
  std::string name;
  for (uint32_t at = where.begin; at < where.end; ++at) {
    const char c = where.source->text()[at];
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
      name += c;
    else if (!name.empty())
      break;
  }
  return name;
}

bool matches(const std::string& a, const std::string& b, Semantics semantics) {
  return semantics == Semantics::permissive || a == b;
}

// Returns the names of parts, each once, in the order of the solids. With permissive semantics, all solids belong to
// the first part.
std::vector<std::string> parts_of(const WordSolids& all, Semantics semantics) {
  std::vector<std::string> parts;
  for (const WordSolid& solid : all)
    if (parts.empty() || (semantics != Semantics::permissive && std::ranges::find(parts, solid.part) == parts.end()))
      parts.push_back(solid.part);
  return parts;
}

WordSolids of_part(const WordSolids& all, const std::string& part, Semantics semantics) {
  WordSolids own;
  for (const WordSolid& solid : all)
    if (matches(solid.part, part, semantics)) own.push_back(solid);
  return own;
}

}  // namespace

bool ScadTreeReader::has_words(const Tree& tree) {
  if (std::holds_alternative<solids::Word>(tree.operation)) return true;
  const auto known = has_words_.find(&tree);
  if (known != has_words_.end()) return known->second;
  const bool found = std::ranges::any_of(tree.children, [&](const TreePtr& child) { return has_words(*child); });
  return has_words_[&tree] = found;
}

Reader ScadTreeReader::reader(const SourceRange& where, const char* type) const {
  return {materials_, diagnostics_, loader_, where, type, ""};
}

NodePtr ScadTreeReader::make(const char* type, const std::vector<NamedValue>& values, std::vector<NodePtr> inputs,
                             const SourceRange& where) {
  return design::make_node(*registry_.find(type), values, std::move(inputs), reader(where, type));
}

NodePtr ScadTreeReader::joined(const WordSolids& solids, const SourceRange& where) {
  std::vector<NodePtr> nodes;
  for (const WordSolid& solid : solids) nodes.push_back(solid.node);
  if (nodes.size() < 2) return nodes.empty() ? nullptr : nodes[0];
  return make("union", {}, std::move(nodes), where);
}

WordSolids ScadTreeReader::by_part(const WordSolids& solids, const SourceRange& where) {
  WordSolids result;
  for (const std::string& part : parts_of(solids, Semantics::standard))
    if (NodePtr node = joined(of_part(solids, part, Semantics::standard), where)) result.push_back({part, node});
  return result;
}

// Adjacent trees without words become one leaf.
WordSolids ScadTreeReader::group(const std::vector<TreePtr>& trees) {
  WordSolids all;
  std::vector<TreePtr> plain;
  const auto add = [&](WordSolids solids) {
    all.insert(all.end(), std::make_move_iterator(solids.begin()), std::make_move_iterator(solids.end()));
  };
  const auto add_plain = [&] {
    if (!plain.empty()) add(leaf(plain));
    plain.clear();
  };
  for (const TreePtr& tree : trees) {
    if (tree->background) continue;
    if (!has_words(*tree)) {
      plain.push_back(tree);
      continue;
    }
    add_plain();
    add(solids_of(tree));
  }
  add_plain();
  return by_part(all, trees.empty() ? SourceRange{} : trees.front()->where);
}

WordSolids ScadTreeReader::leaf(const std::vector<TreePtr>& trees) {
  Tree whole;
  whole.children = trees;
  const std::string text = openscad::csg_text(whole, openscad::folder_of(script_), openscad::CsgForm::exact);
  const Reader at = reader(trees.front()->where, "scad");
  if (!loader_) {
    diagnostics_.error(at.where, "OpenSCAD solids cannot be made here");
    return {};
  }
  design::ScadRequest request;
  request.file.path = script_;
  request.script = text;
  request.material = {&materials_.first()};
  const auto made = loader_->source(request, at);
  if (!made) return {};
  Diagnostics repeated;  // messages about the text were reported with the first request
  const Reader again{materials_, repeated, loader_, at.where, "scad", ""};
  WordSolids solids;
  for (const std::string& part : made->part_names) {
    const bool is_all = made->part_names.size() == 1;
    if (NodePtr node = leaf_node(text, is_all ? "" : design::part_word(part), again)) solids.push_back({part, node});
  }
  if (repeated.has_errors()) diagnostics_.add_all(repeated);
  return solids;
}

NodePtr ScadTreeReader::leaf_node(const std::string& text, const std::string& part, const Reader& at) {
  const NodeType& type = *registry_.find("scad");
  std::vector<NamedValue> values{{parameter_of(type, "path"), Data(script_)},
                                 {parameter_of(type, "script"), Data(text)}};
  if (!part.empty()) values.push_back({parameter_of(type, "part"), Data(part)});
  return design::make_node(type, values, {}, at);
}

WordSolids ScadTreeReader::solids_of(const TreePtr& pointer) {
  const Tree& tree = *pointer;
  if (tree.background) return {};
  if (!has_words(tree)) return leaf({pointer});
  if (const auto* word = std::get_if<solids::Word>(&tree.operation))
    return *std::static_pointer_cast<const WordSolids>(word->solid);
  if (std::holds_alternative<solids::Group>(tree.operation)) return group(tree.children);
  if (std::holds_alternative<solids::Union>(tree.operation)) return united(tree);
  if (std::holds_alternative<solids::Difference>(tree.operation)) return difference(tree);
  if (std::holds_alternative<solids::Intersection>(tree.operation)) return intersection(tree);
  if (const auto* transform = std::get_if<solids::Transform>(&tree.operation))
    return with(tree, "matrix", "matrix", matrix_of(transform->parent_from_child));
  if (const auto* material = std::get_if<solids::SetMaterial>(&tree.operation))
    return with(tree, "material", "materials", Data(material->name));
  if (const auto* colour = std::get_if<solids::SetColour>(&tree.operation)) {
    if (colour->colour[0] < 0) return group(tree.children);  // sets only the opacity
    return with(tree, "material", "materials",
                Data(design::nearest_material(solids::bytes_of(colour->colour), materials_).name));
  }
  if (const auto* part = std::get_if<solids::SetPart>(&tree.operation)) {
    WordSolids solids = group(tree.children);
    for (WordSolid& solid : solids) solid.part = part->name;
    return by_part(solids, tree.where);
  }
  return needs_polyhedra(tree);
}

WordSolids ScadTreeReader::needs_polyhedra(const Tree& tree) {
  const std::string name = called_name(tree.where);
  diagnostics_.error(Code::inputs, tree.where, name + "() works on polyhedra, and a solid of use <ombre> stands in it",
                     "use " + name + "() first, and give the word what it makes", {{"node", name}});
  return {};
}

WordSolids ScadTreeReader::with(const Tree& tree, const char* type, const char* parameter, const Data& value) {
  WordSolids solids = group(tree.children);
  const std::vector<NamedValue> values{{parameter_of(*registry_.find(type), parameter), value}};
  for (WordSolid& solid : solids) solid.node = make(type, values, {solid.node}, tree.where);
  std::erase_if(solids, [](const WordSolid& solid) { return !solid.node; });
  return solids;
}

WordSolids ScadTreeReader::united(const Tree& tree) {
  WordSolids all = group(tree.children);
  if (tree.semantics != Semantics::permissive || all.empty()) return all;
  NodePtr node = joined(all, tree.where);
  return node ? WordSolids{{all.front().part, node}} : WordSolids{};
}

// Subtracts all following children from each part of the first child.
WordSolids ScadTreeReader::difference(const Tree& tree) {
  const auto first = std::ranges::find_if(tree.children, [](const TreePtr& child) { return !child->background; });
  if (first == tree.children.end()) return {};
  WordSolids solids = group({*first});
  const WordSolids others = group({first + 1, tree.children.end()});
  for (WordSolid& solid : solids) {
    const bool is_strict = tree.semantics == Semantics::strict;
    const NodePtr taken = joined(is_strict ? of_part(others, solid.part, tree.semantics) : others, tree.where);
    if (taken) solid.node = make("difference", {}, {solid.node, taken}, tree.where);
  }
  std::erase_if(solids, [](const WordSolid& solid) { return !solid.node; });
  return solids;
}

// Intersects, for each part, all children that have that part.
WordSolids ScadTreeReader::intersection(const Tree& tree) {
  std::vector<WordSolids> children;
  WordSolids all;
  for (const TreePtr& child : tree.children) {
    if (child->background) continue;
    children.push_back(group({child}));
    all.insert(all.end(), children.back().begin(), children.back().end());
  }
  WordSolids result;
  for (const std::string& part : parts_of(all, tree.semantics)) {
    std::vector<NodePtr> members;
    for (const WordSolids& child : children)
      if (NodePtr member = joined(of_part(child, part, tree.semantics), tree.where)) members.push_back(member);
    NodePtr node = members.size() == 1 ? members[0] : make("intersection", {}, std::move(members), tree.where);
    if (node) result.push_back({part, node});
  }
  return result;
}

}  // namespace ombre::lang
