#include "lang/vcad/vcad.h"

#include <algorithm>

#include "base/text/text.h"
#include "lang/vcad/facets.h"
#include "lang/vcad/legacy_forms.h"
#include "lang/vcad/node_calls.h"
#include "lang/vcad/openscad.h"

namespace ombre::lang {

using design::NodePtr;
using design::NodeType;
using design::Reader;

namespace {

constexpr std::string_view axes[] = {"x", "y", "z"};

NodePtr solid_of(const Data& data) {
  const auto* object = dynamic_cast<const design::NodeObject*>(data.host_object().get());
  return object && object->node()->type().is_solid() ? object->node() : nullptr;
}

bool is_solid(const Data& data) { return solid_of(data) != nullptr; }

// Removes the solids from the arguments, alone or in lists, and returns them as children of the call: translate([1, 2,
// 3], sphere(5)).
std::vector<NodePtr> take_solids(std::vector<Argument>& arguments) {
  std::vector<NodePtr> solids;
  std::erase_if(arguments, [&](const Argument& argument) {
    if (!argument.name.empty()) return false;
    const DataList* list = argument.value.list();
    if (const NodePtr solid = solid_of(argument.value)) {
      solids.push_back(solid);
      return true;
    }
    if (!list || list->empty() || !std::ranges::all_of(*list, is_solid)) return false;
    for (const Data& element : *list) solids.push_back(solid_of(element));
    return true;
  });
  return solids;
}

// Casts products to nodes, which are all that this vocabulary makes.
std::vector<NodePtr> nodes_of(std::vector<Product> products) {
  std::vector<NodePtr> nodes;
  nodes.reserve(products.size());
  for (Product& product : products) nodes.push_back(std::static_pointer_cast<const design::Node>(std::move(product)));
  return nodes;
}

// Inserts solids as children before those in the braces, each as a separate statement.
void put_first(const std::vector<NodePtr>& solids, Invocation& call) {
  if (solids.empty()) return;
  call.children.insert(call.children.begin(), solids.begin(), solids.end());
  std::vector<size_t> ends;
  for (size_t n = 1; n <= solids.size(); ++n) ends.push_back(n);
  for (const size_t end : call.group_ends) ends.push_back(end + solids.size());
  call.group_ends = std::move(ends);
}

// True if each statement in the braces gives one solid.
bool has_single_children(const Invocation& call) {
  if (call.group_ends.size() != call.children.size()) return false;
  for (size_t n = 0; n < call.group_ends.size(); ++n)
    if (call.group_ends[n] != n + 1) return false;
  return true;
}

}  // namespace

VcadVocabulary::VcadVocabulary(const design::Registry& registry, const design::MaterialTable& materials,
                               design::SourceLoader* loader)
    : registry_(registry), materials_(materials), loader_(loader), maker_{registry, materials} {}

bool VcadVocabulary::knows(std::string_view name) const {
  const NodeType* type = registry_.find(node_name(name));
  return fold_name(name) == "root" || (type && type->is_solid());
}

bool VcadVocabulary::gives_value(std::string_view name) const { return registry_.find(name) != nullptr; }

std::vector<std::string> VcadVocabulary::names() const {
  std::vector<std::string> names = registry_.solid_names();
  names.emplace_back("root");
  return names;
}

std::string VcadVocabulary::hint(std::string_view unknown) const {
  const NodeType* type = registry_.find(unknown);
  if (!type || type->is_solid()) return openscad_module_hint(unknown);
  return type->name + " gives values; use it in an expression: " + type->example;
}

std::optional<Data> VcadVocabulary::constant(std::string_view name) const {
  for (size_t i = 0; i < 3; ++i) {
    if (name != axes[i]) continue;
    DataList direction(3, Data(0.0));
    direction[i] = Data(1.0);
    return Data(std::move(direction));
  }
  if (const design::Material* material = materials_.find(name)) return Data(material->name);
  return std::nullopt;
}

std::vector<std::string> VcadVocabulary::constants() const {
  std::vector<std::string> names = materials_.names();
  names.insert(names.end(), std::begin(axes), std::end(axes));
  return names;
}

Product VcadVocabulary::make(Invocation call, Diagnostics& diagnostics) {
  const size_t errors_before = diagnostics.error_count();
  const NodeType* type = registry_.find(node_name(call.name));
  NodePtr node = fold_name(call.name) == "root" ? make_root(call, diagnostics)
                 : type                         ? make_of_type(*type, call, diagnostics)
                                                : nullptr;
  if (diagnostics.error_count() > errors_before)
    for (const SourceRange& from : call.called_from) diagnostics.note(from, "called from here");
  return node;
}

std::optional<Value> VcadVocabulary::value(Invocation call, Diagnostics& diagnostics, Meter& meter) {
  const NodeType& type = *registry_.find(call.name);
  const Reader reader{materials_, diagnostics, loader_, call.whole, type.name, "", &call.variable};
  std::vector<NodePtr> solids;
  if (type.is_solid()) solids = take_solids(call.arguments);
  const auto values = bound_arguments(type, std::move(call.arguments), reader);
  NodePtr node = values ? known_.first(make_called(type, *values, std::move(solids), registry_, reader)) : nullptr;
  if (node) return type.is_solid() ? solid_value(node, maker_, meter) : value_of(node, maker_, meter);
  for (const SourceRange& from : call.called_from) diagnostics.note(from, "called from here");
  return std::nullopt;
}

std::optional<Value> VcadVocabulary::solid(std::vector<Product> products, const SourceRange& where,
                                           Diagnostics& diagnostics, Meter& meter) {
  const Reader reader{materials_, diagnostics, loader_, where, "union", ""};
  const NodePtr node = products.empty() ? design::make_nothing(*registry_.find("union"), where)
                                        : known_.first(joined(nodes_of(std::move(products)), registry_, reader));
  return node ? std::optional(solid_value(node, maker_, meter)) : std::nullopt;
}

NodePtr VcadVocabulary::make_of_type(const NodeType& type, Invocation& call, Diagnostics& diagnostics) {
  const Reader reader{materials_, diagnostics, loader_, call.whole, type.name, "", &call.variable};
  if (type.inputs.most > 0) put_first(take_solids(call.arguments), call);
  const auto values = bound_arguments(type, std::move(call.arguments), reader);
  if (!values) return nullptr;
  if (call.children.empty() && call.has_wrong_children && type.inputs.least > 0) return nullptr;  // reported already
  const bool is_grouped = type.inputs.grouped && !has_single_children(call);
  std::vector<NodePtr> children = nodes_of(std::move(call.children));
  if (is_grouped) {
    children = groups(type, call, children, reader);
    if (children.empty()) return nullptr;
  }
  if (children.empty() && type.inputs.least == 1 && call.braces != Invocation::Braces::none)
    children = {nothing_inside(type, call, diagnostics)};
  NodePtr node = make_called(type, *values, std::move(children), registry_, reader);
  return known_.first(with_facets(std::move(node), call, registry_, reader));
}

// Makes an empty solid. Loops, modules and conditions may give nothing, but empty braces give a warning, since
// something may have been forgotten.
NodePtr VcadVocabulary::nothing_inside(const NodeType& type, const Invocation& call, Diagnostics& diagnostics) {
  if (call.braces == Invocation::Braces::empty)
    diagnostics.warning(call.whole, type.name + " has nothing inside its braces, and makes nothing",
                        "write " + type.name + "(...) { sphere(5); }");
  return design::make_nothing(type, call.whole);
}

// Joins the solids of each statement, as in OpenSCAD: difference() { for (...) ...; sphere(5); } subtracts the ball
// from everything that the loop makes.
std::vector<NodePtr> VcadVocabulary::groups(const NodeType& type, const Invocation& call,
                                            const std::vector<NodePtr>& children, const Reader& reader) {
  std::vector<NodePtr> result;
  size_t begin = 0;
  for (const size_t end : call.group_ends) {
    const auto first = children.begin() + static_cast<std::ptrdiff_t>(begin),
               last = children.begin() + static_cast<std::ptrdiff_t>(end);
    result.push_back(
        known_.first(begin == end ? design::make_nothing(type, call.whole) : joined({first, last}, registry_, reader)));
    if (!result.back()) return {};
    begin = end;
  }
  return result;
}

NodePtr VcadVocabulary::make_root(Invocation& call, Diagnostics& diagnostics) {
  const auto fail = [&](const SourceRange& where, const std::string& message, const Phrase& hint = {}) {
    diagnostics.error(Code::script, where, message, hint);
    return nullptr;
  };
  if (!call.is_top_level) return fail(call.where, "root stands at the top level of the main file only");
  if (root_where_) return fail(call.where, "there is a root already", "a design has one; put everything inside it");
  root_where_ = call.where;
  static const std::vector<std::string> names{"min", "max", "voxel"};
  const std::string form = "root((minx, miny, minz), (maxx, maxy, maxz), (vx, vy, vz)) { ... }";
  std::array<const Data*, 3> corners{};
  size_t position = 0;
  for (const Argument& argument : call.arguments) {
    const auto at = argument.name.empty() ? names.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(position++, 3))
                                          : std::find(names.begin(), names.end(), argument.name);
    if (at == names.end())
      return fail(argument.value.where.source ? argument.value.where : call.whole, "root takes three arguments",
                  "write " + form);
    corners[static_cast<size_t>(at - names.begin())] = &argument.value;
  }
  if (!corners[0] || !corners[1] || !corners[2])
    return fail(call.whole, "root needs the corners of its box and a voxel size", "write " + form);

  design::Sampling sampling;
  Vec3 voxel;
  const auto read_corner = [&](size_t i, const design::Domain& domain, Vec3& value) {
    return design::read(*corners[i], domain, value, {materials_, diagnostics, loader_, call.whole, "root", names[i]});
  };
  const bool lo = read_corner(0, design::unit::mm, sampling.box.lo),
             hi = read_corner(1, design::unit::mm, sampling.box.hi),
             size = read_corner(2, design::unit::positive_mm, voxel);
  if (!lo || !hi || !size) return nullptr;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(sampling.box.lo[axis] < sampling.box.hi[axis]))
      return fail(corners[1]->where.source ? corners[1]->where : call.whole,
                  "the box of root is empty: max must be greater than min on each axis");
    const auto pitch = Pitch::from_mm(voxel[axis]);
    if (!pitch)
      return fail(corners[2]->where, "the voxel size " + format_number(voxel[axis]) + " mm has too many digits");
    sampling.pitch[static_cast<size_t>(axis)] = *pitch;
  }
  if (call.children.empty()) return nullptr;  // reported as an empty design
  sampling_ = sampling;
  root_children_ = nodes_of(std::move(call.children));
  return root_ = joined(root_children_, registry_, {materials_, diagnostics, loader_, call.whole, "root", ""});
}

std::optional<design::Design> VcadVocabulary::finish(std::vector<Product> products, const SourceRange& whole,
                                                     Diagnostics& diagnostics) {
  const std::vector<NodePtr> top_level = nodes_of(std::move(products));
  known_ = {};  // no more nodes are added, and the table is large
  if (diagnostics.has_errors()) return std::nullopt;
  if (root_where_) {
    for (const NodePtr& beside : top_level)
      if (beside != root_ && !beside->is_nothing())
        diagnostics.error(Code::script, beside->where(), "this stands beside root, which is all that is sampled",
                          "put it inside the braces of root");
    if (diagnostics.has_errors()) return std::nullopt;
  }
  const std::vector<NodePtr>& solids = root_where_ ? root_children_ : top_level;
  if (std::ranges::all_of(solids, [](const NodePtr& solid) { return solid->is_nothing(); })) {
    diagnostics.error(Code::nothing_inside, whole, "the design is empty: nothing in it makes a solid",
                      "write for example sphere(5, \"red\");");
    return std::nullopt;
  }
  design::Design design{materials_, {}, sampling_};
  const Reader reader{materials_, diagnostics, loader_, whole, "", ""};
  std::vector<NodePtr> unnamed;
  for (const NodePtr& solid : solids) {
    if (solid->is_nothing()) continue;
    if (solid->type().name != "part") {
      unnamed.push_back(solid);
      continue;
    }
    const std::string name = *solid->type().get(*solid, 0, false).string();
    for (const design::Part& other : design.parts)
      if (other.name == name)
        diagnostics.error(Code::twice, solid->where(), "there are two parts with the name \"" + name + "\"", {},
                          {{"name", name}});
    design.parts.push_back({name, solid});
  }
  if (!unnamed.empty()) {
    const NodePtr rest = joined(unnamed, registry_, reader);
    if (!rest) return std::nullopt;
    design.parts.insert(design.parts.begin(), {design::nameless_part, rest});
  }
  if (diagnostics.has_errors()) return std::nullopt;
  return design;
}

}  // namespace ombre::lang
