#include "design/design.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::design {
namespace {

// Versions of the design file. Value nodes need version 2; other designs are written as version 1.
constexpr double version_without_values = 1, version_with_values = 2;

using NodeName = std::function<std::string(const Node&)>;

Data node_parameters(const Node& node, bool for_hash, const NodeName& name) {
  DataMembers members;
  for (size_t i = 0; i < node.type().parameters.size(); ++i) {
    Data value = node.type().get(node, i, for_hash);
    members.emplace_back(node.type().parameters[i].name, node.values().empty() ? value : with_names(value, name));
  }
  return Data(std::move(members));
}

Data vector_data(Vec3 v) { return Data(DataList{Data(v.x), Data(v.y), Data(v.z)}); }

Data sampling_data(const Sampling& sampling) {
  DataList voxel;
  for (const Pitch& pitch : sampling.pitch) voxel.emplace_back(pitch.text());
  return Data(DataMembers{
      {"min", vector_data(sampling.box.lo)}, {"max", vector_data(sampling.box.hi)}, {"voxel", Data(std::move(voxel))}});
}

// Assigns ids to nodes in the order in which they are first needed.
std::map<const Node*, std::string> node_ids(const std::vector<const Node*>& nodes) {
  std::map<const Node*, std::string> ids;
  for (const Node* node : nodes) ids.emplace(node, "n" + std::to_string(ids.size() + 1));
  return ids;
}

}  // namespace

std::vector<NodePtr> Design::roots() const {
  std::vector<NodePtr> roots;
  for (const Part& part : parts) roots.push_back(part.solid);
  return roots;
}

std::optional<JobScale> Design::scale() const {
  if (job_scale || !sampling) return job_scale;
  return JobScale(Vec3{sampling->pitch[0].mm(), sampling->pitch[1].mm(), sampling->pitch[2].mm()});
}

std::optional<StageLattice> Design::lattice() const {
  if (job_lattice || !sampling) return job_lattice;
  return StageLattice{sampling->box.lo, sampling->pitch};
}

Design for_job(Design design, const JobScale& scale) {
  design.job_scale = scale;
  return design;
}

Design for_lattice(Design design, const StageLattice& lattice) {
  design.job_lattice = lattice;
  const auto& pitch = lattice.pitch;
  return for_job(std::move(design), Vec3{pitch[0].mm(), pitch[1].mm(), pitch[2].mm()});
}

Data to_data(const Design& design) {
  const auto nodes = topological(design.roots());
  const auto ids = node_ids(nodes);
  const auto id_of = [&](const Node& node) { return ids.at(&node); };
  const bool has_values = std::ranges::any_of(nodes, [](const Node* node) { return !node->values().empty(); });
  DataList node_list, part_list;
  for (const Node* node : nodes) {
    DataMembers entry{{"id", Data(ids.at(node))},
                      {"type", Data(node->type().name)},
                      {"parameters", node_parameters(*node, false, id_of)}};
    if (!node->inputs().empty()) {
      DataList inputs;
      for (const NodePtr& input : node->inputs()) inputs.emplace_back(ids.at(input.get()));
      entry.emplace_back("inputs", Data(std::move(inputs)));
    }
    node_list.emplace_back(std::move(entry));
  }
  for (const Part& part : design.parts)
    part_list.emplace_back(DataMembers{{"name", Data(part.name)}, {"node", Data(ids.at(part.solid.get()))}});

  DataMembers members{{"format", Data("ombre-design")},
                      {"version", Data(has_values ? version_with_values : version_without_values)}};
  members.push_back(design.materials.to_data().members()->front());
  if (design.sampling) members.emplace_back("sampling", sampling_data(*design.sampling));
  members.emplace_back("nodes", Data(std::move(node_list)));
  members.emplace_back("parts", Data(std::move(part_list)));
  return Data(std::move(members));
}

namespace {

// Hashes nodes by their types, parameters and the hashes of their inputs, so that equal sub-designs have equal hashes.
class NodeHasher {
 public:
  explicit NodeHasher(const std::vector<NodePtr>& roots) {
    const std::vector<const Node*> nodes = topological(roots);
    for (const NodePtr& root : roots) shared_[root.get()];
    for (const Node* node : nodes) {
      for (const NodePtr& input : node->inputs())
        if (input.use_count() > 1) shared_[input.get()];
      for (const NodePtr& value : node->values()) shared_[value.get()];
    }
    for (const Node* node : nodes) add(*node);
  }

  Hash of_root(const NodePtr& root) const { return shared_.at(root.get()); }

 private:
  void add(const Node& node) {
    const auto name = [&](const Node& value) { return shared_.at(&value).hex(); };
    std::string text = node.type().name + print_json_line(node_parameters(node, true, name));
    const auto inputs = node.inputs();
    const auto is_single = [&](const NodePtr& input) { return !shared_.contains(input.get()); };
    auto single = waiting_.end() - std::count_if(inputs.begin(), inputs.end(), is_single);
    const auto first_single = single;
    for (const NodePtr& input : inputs) {
      const auto known = shared_.find(input.get());
      text += (known != shared_.end() ? known->second : *single++).hex();
    }
    waiting_.erase(first_single, waiting_.end());
    const Hash made = hash_bytes(text);
    if (const auto known = shared_.find(&node); known != shared_.end())
      known->second = made;
    else
      waiting_.push_back(made);
  }

  std::unordered_map<const Node*, Hash> shared_;
  // Hashes of nodes that are an input of exactly one node, which is hashed after all its inputs.
  std::vector<Hash> waiting_;
};

}  // namespace

Hash hash(const Design& design) {
  const std::vector<NodePtr> roots = design.roots();
  const NodeHasher hashes(roots);
  DataList parts;
  for (const Part& part : design.parts)
    parts.emplace_back(DataList{Data(part.name), Data(hashes.of_root(part.solid).hex())});
  DataMembers members{{"version", Data(version_without_values)},
                      {"materials", design.materials.to_data()},
                      {"parts", Data(std::move(parts))}};
  if (design.sampling) members.emplace_back("sampling", sampling_data(*design.sampling));
  return hash_bytes(print_json_line(Data(std::move(members))));
}

namespace {

bool holds_host_object(const Data& data) {
  if (const DataList* list = data.list()) return std::any_of(list->begin(), list->end(), holds_host_object);
  return data.host_object() && !is_value(data);
}

bool has_host_function(const Node& node) {
  for (size_t i = 0; i < node.type().parameters.size(); ++i)
    if (holds_host_object(node.type().get(node, i, false))) return true;
  return false;
}

}  // namespace

const Node* find_host_function(const Design& design) {
  for (const Node* node : topological(design.roots()))
    if (has_host_function(*node)) return node;
  return nullptr;
}

namespace {

// Checks that each attribute has a single type. A number and a colour of the same name could not be written into one
// grid.
bool check_attributes(const Design& design, Diagnostics& diagnostics) {
  bool good = true;
  std::map<std::string, ValueType> known;
  for (const Node* node : topological(design.roots())) {
    const auto declared = node->declares();
    if (!declared) continue;
    const ValueType first = known.try_emplace(declared->name, declared->type).first->second;
    if (first == declared->type) continue;
    diagnostics.error(Code::twice, node->where(),
                      "the attribute \"" + declared->name + "\" is a " + std::string(name(declared->type)) +
                          " here, and a " + std::string(name(first)) + " elsewhere in the design",
                      "give one of them another name", {{"name", declared->name}});
    good = false;
  }
  return good;
}

bool check_cells(const Design& design, Diagnostics& diagnostics) {
  bool good = true;
  for (const Part& part : design.parts) {
    const Node* user = part.solid.get();
    if (!user->uses_cell()) continue;
    const auto uses_cell = [](const NodePtr& other) { return other->uses_cell(); };
    for (;;) {
      const auto below = user->dependencies();
      const auto next = std::ranges::find_if(below, uses_cell);
      if (next == below.end()) break;
      user = next->get();
    }
    diagnostics.error(Code::unknown_variable, user->where(),
                      user->type().name + " uses the index of a cell (ci, cj, ck), and nothing repeats it",
                      "put it into " + spelled::around("tile"), {{"name", "ci"}});
    good = false;
  }
  return good;
}

}  // namespace

bool check_design(const Design& design, Diagnostics& diagnostics) {
  const bool cells = check_cells(design, diagnostics);
  return check_attributes(design, diagnostics) && cells;
}

namespace {

class TreePrinter {
 public:
  std::string text;

  void print(const Node& node, size_t indent) {
    text.append(indent, ' ');
    text += node.type().name + "(" + parameters(node) + ")";
    if (node.type().is_solid()) text += "  [" + std::string(name(node.metric().kind)) + "]";
    const bool has_number = !node.dependencies().empty() || !node.type().is_solid();
    if (!numbers_.try_emplace(&node, numbers_.size() + 1).second && has_number) {
      text += "  as above, #" + std::to_string(numbers_.at(&node)) + "\n";
      return;
    }
    if (has_number) text += "  #" + std::to_string(numbers_.at(&node));
    text += '\n';
    for (const NodePtr& other : node.dependencies()) print(*other, indent + 2);
  }

 private:
  static std::string parameters(const Node& node) {
    std::string list;
    for (size_t i = 0; i < node.type().parameters.size(); ++i) {
      const ParameterInfo& parameter = node.type().parameters[i];
      const Data value = with_names(node.type().get(node, i, false), [](const Node& n) { return n.type().name; });
      if (value == parameter.default_value) continue;
      list += (list.empty() ? "" : ", ") + parameter.name + "=" + print_json_line(value);
    }
    return list;
  }

  std::map<const Node*, size_t> numbers_;
};

}  // namespace

std::string to_tree(const Design& design) {
  TreePrinter printer;
  if (design.sampling) {
    const auto& [box, pitch] = *design.sampling;
    printer.text += "sampling " + print_json_line(vector_data(box.lo)) + " to " + print_json_line(vector_data(box.hi)) +
                    " mm at " + pitch[0].text() + ", " + pitch[1].text() + ", " + pitch[2].text() + " mm\n";
  }
  for (const Part& part : design.parts) {
    printer.text += "part \"" + part.name + "\"\n";
    printer.print(*part.solid, 2);
  }
  return printer.text;
}

}  // namespace ombre::design
