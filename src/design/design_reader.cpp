// Reads design files. Nodes may refer to each other in any order, but not in a circle.
#include <algorithm>
#include <unordered_map>

#include "base/text/record.h"
#include "base/text/text.h"
#include "design/design.h"

namespace ombre::design {
namespace {

struct Entry {
  const Data* data = nullptr;
  NodePtr node;
  enum class State : uint8_t { unseen, open, done } state = State::unseen;
  std::vector<const Data*> uses = {};  // its references to nodes, once it is open
  size_t uses_made = 0;                // number of references whose nodes are made
};

class DesignReader {
 public:
  DesignReader(const Data& data, const Registry& registry, SourceLoader* loader, Diagnostics& diagnostics)
      : data_(data), registry_(registry), loader_(loader), diagnostics_(diagnostics) {}

  std::optional<Design> run() {
    const size_t errors_before = diagnostics_.error_count();
    if (!check_header()) return std::nullopt;
    const auto materials = MaterialTable::read(data_, diagnostics_);
    if (!materials) return std::nullopt;
    design_.materials = *materials;
    if (const Data* sampling = data_.find("sampling")) read_sampling(*sampling);
    index_nodes();
    read_parts();
    if (diagnostics_.error_count() > errors_before) return std::nullopt;
    return std::move(design_);
  }

 private:
  void error(const Data& at, std::string message, Phrase hint = {}, Code code = Code::design_file,
             CodeValues values = {}) {
    diagnostics_.error(code, at.where, std::move(message), std::move(hint), std::move(values));
  }

  bool check_header() {
    const Data* format = data_.find("format");
    if (!format || !format->string() || *format->string() != "ombre-design") {
      error(format ? *format : data_, "this is not a design file: \"format\" should be \"ombre-design\"");
      return false;
    }
    const Data* version = data_.find("version");
    if (!version || !version->number() || (*version->number() != 1 && *version->number() != 2)) {
      error(version ? *version : data_, "this design file has a version that is not known here",
            "expected \"version\": 1 or 2");
      return false;
    }
    may_have_values_ = *version->number() >= 2;
    members_.has_only(data_, "a design", {"format", "version", "materials", "sampling", "nodes", "parts"});
    return true;
  }

  void read_sampling(const Data& data) {
    const Reader reader{design_.materials, diagnostics_, loader_, data.where, "sampling", ""};
    Sampling sampling;
    if (!members_.has_only(data, "the sampling", {"min", "max", "voxel"})) return;
    const Data *lo = data.find("min"), *hi = data.find("max"), *voxel = data.find("voxel");
    if (!lo || !hi || !voxel) return error(data, "expected an object with min, max and voxel");
    if (!read(*lo, unit::mm, sampling.box.lo, reader) || !read(*hi, unit::mm, sampling.box.hi, reader)) return;
    if (!voxel->list() || voxel->list()->size() != 3) return error(*voxel, "expected three voxel sizes in mm");
    for (size_t axis = 0; axis < 3; ++axis) {
      const Data& size = (*voxel->list())[axis];
      const auto pitch = size.string()   ? Pitch::parse(*size.string())
                         : size.number() ? Pitch::from_mm(*size.number())
                                         : std::nullopt;
      if (!pitch)
        return error(size, "expected a voxel size in mm such as 0.1 or \"25.4/600\", found " + describe(size));
      sampling.pitch[axis] = *pitch;
      const int i = static_cast<int>(axis);
      if (!(sampling.box.lo[i] < sampling.box.hi[i]))
        return error(*hi, "the box is empty: max must be greater than min on each axis");
    }
    design_.sampling = sampling;
  }

  void index_nodes() {
    const Data* nodes = data_.find("nodes");
    if (!nodes || !nodes->list()) return error(nodes ? *nodes : data_, "expected a list \"nodes\"");
    for (const Data& entry : *nodes->list()) {
      const Data* id = entry.find("id");
      if (!id || !id->string()) {
        error(entry, "every node needs an \"id\", a text");
        continue;
      }
      if (!entries_.try_emplace(*id->string(), Entry{&entry, nullptr, Entry::State::unseen}).second)
        error(*id, "two nodes have the id \"" + *id->string() + "\"");
      ids_.push_back(*id->string());
    }
  }

  void read_parts() {
    const Data* parts = data_.find("parts");
    if (!parts || !parts->list() || parts->list()->empty())
      return error(parts ? *parts : data_, "expected a list \"parts\" with at least one part");
    for (const Data& entry : *parts->list()) {
      if (!members_.has_only(entry, "a part", {"name", "node"})) continue;
      const Data *name = entry.find("name"), *node = entry.find("node");
      if (!name || !name->string() || !node || !node->string()) {
        error(entry, "every part needs a \"name\" and a \"node\"");
        continue;
      }
      const NodePtr solid = resolve(*node);
      if (!solid) continue;
      for (const Part& other : design_.parts)
        if (other.name == *name->string()) error(*name, "there are two parts with the name \"" + other.name + "\"");
      if (!solid->type().is_solid()) error(*node, "a part must be a solid, " + solid->type().name + " is not");
      design_.parts.push_back({*name->string(), solid});
    }
  }

  // Traverses depth first with an explicit stack, since files may nest to any depth before that is reported as an
  // error.
  NodePtr resolve(const Data& reference) {
    std::vector<const Data*> stack{&reference};
    while (!stack.empty()) {
      const Data& wanted = *stack.back();
      const auto found = wanted.string() ? entries_.find(*wanted.string()) : entries_.end();
      if (found == entries_.end()) {
        error(wanted,
              wanted.string() ? "there is no node with the id \"" + *wanted.string() + "\""
                              : "expected the id of a node, a text",
              wanted.string() ? did_you_mean(*wanted.string(), ids_) : "");
        return nullptr;
      }
      Entry& entry = found->second;
      if (entry.state == Entry::State::done) {
        if (!entry.node) return nullptr;  // an error was reported already
        stack.pop_back();
        continue;
      }
      entry.state = Entry::State::open;
      const Data* pending = nullptr;
      if (!find_pending(entry, pending)) return nullptr;
      if (pending) {
        stack.push_back(pending);
        continue;
      }
      entry.node = make(entry);
      entry.state = Entry::State::done;
      if (!entry.node) return nullptr;
      stack.pop_back();
    }
    return entries_.at(*reference.string()).node;
  }

  // Finds the first node among the inputs and in the parameters that is not made yet. Returns false if the references
  // form a circle.
  bool find_pending(Entry& entry, const Data*& pending) {
    if (entry.uses.empty() && !find_uses(entry)) return false;
    for (; entry.uses_made < entry.uses.size(); ++entry.uses_made) {
      const Data& used = *entry.uses[entry.uses_made];
      const auto found = used.string() ? entries_.find(*used.string()) : entries_.end();
      if (found != entries_.end() && found->second.state == Entry::State::open) {
        error(used, "the node \"" + *used.string() + "\" is, through its inputs, an input of itself");
        return false;
      }
      if (found == entries_.end() || found->second.state == Entry::State::unseen || !found->second.node) {
        pending = &used;
        return true;
      }
    }
    return true;
  }

  bool find_uses(Entry& entry) {
    if (const Data* parameters = entry.data->find("parameters"))
      if (!find_values(*parameters, entry.uses)) return false;
    const Data* inputs = entry.data->find("inputs");
    if (!inputs) return true;
    if (inputs->list())
      for (const Data& input : *inputs->list()) entry.uses.push_back(&input);
    else
      error(*inputs, "expected a list of node ids");
    return inputs->list() != nullptr;
  }

  // Collects references such as {"from": "n3", "output": "value"} and, to solids, {"from": "n2"}.
  bool find_values(const Data& data, std::vector<const Data*>& uses) {
    if (const DataList* list = data.list())
      return std::ranges::all_of(*list, [&](const Data& element) { return find_values(element, uses); });
    if (!data.members()) return true;
    for (const auto& [key, value] : *data.members()) {
      if (key == "from") uses.push_back(&value);
      if ((key == "from" || key == "formula") && !may_have_values_) {
        error(data, "values of nodes are new in version 2 of design files", "write \"version\": 2");
        return false;
      }
      if (!find_values(value, uses)) return false;
    }
    return true;
  }

  // Replaces ids by nodes.
  Data with_nodes(const Data& data) const {
    if (const DataList* list = data.list()) {
      DataList result;
      for (const Data& element : *list) result.push_back(with_nodes(element));
      return {std::move(result), data.where};
    }
    if (!data.members()) return data;
    DataMembers result;
    for (const auto& [key, value] : *data.members()) {
      if (key != "from") {
        result.emplace_back(key, with_nodes(value));
        continue;
      }
      const HostObjectPtr object = std::make_shared<NodeObject>(entries_.at(*value.string()).node);
      result.emplace_back(key, Data(object, value.where));
    }
    return {std::move(result), data.where};
  }

  NodePtr make(const Entry& entry) {
    const Data* type_name = entry.data->find("type");
    if (!type_name || !type_name->string()) {
      error(*entry.data, "this node has no \"type\"");
      return nullptr;
    }
    members_.has_only(*entry.data, "a node", {"id", "type", "parameters", "inputs"});
    const NodeType* type = registry_.find(*type_name->string());
    if (!type) {
      error(*type_name, "there is no node \"" + *type_name->string() + "\"",
            did_you_mean(*type_name->string(), registry_.names()), Code::unknown_node,
            {{"node", *type_name->string()},
             {"similar", closest_name(*type_name->string(), registry_.names()).value_or("")}});
      return nullptr;
    }
    std::vector<NamedValue> values;
    if (!read_parameters(*entry.data, *type, values)) return nullptr;
    std::vector<NodePtr> inputs;
    if (const Data* list = entry.data->find("inputs")) {
      for (const Data& input : *list->list()) inputs.push_back(entries_.at(*input.string()).node);
      if (inputs.empty() && type->inputs.least == 1) inputs = {make_nothing(*type, type_name->where)};
    }
    return make_node(*type, values, std::move(inputs),
                     {design_.materials, diagnostics_, loader_, type_name->where, "", ""});
  }

  bool read_parameters(const Data& entry, const NodeType& type, std::vector<NamedValue>& values) {
    const Data* parameters = entry.find("parameters");
    if (!parameters) return true;
    if (!parameters->members()) {
      error(*parameters, "expected an object with the parameters of " + type.name);
      return false;
    }
    for (const auto& [key, value] : *parameters->members()) {
      const int index = type.parameter(key);
      if (index < 0) {
        error(value, type.name + " has no parameter \"" + key + "\"", did_you_mean(key, type.parameter_names()),
              Code::unknown_parameter,
              {{"node", type.name},
               {"parameter", key},
               {"similar", closest_name(key, type.parameter_names()).value_or("")}});
        return false;
      }
      if (!value.is_null())
        values.push_back({&type.parameters[static_cast<size_t>(index)], may_have_values_ ? with_nodes(value) : value});
    }
    return true;
  }

  const Data& data_;
  const Registry& registry_;
  SourceLoader* loader_;
  Diagnostics& diagnostics_;
  const MemberReader members_{diagnostics_, Code::design_file};
  Design design_;
  std::unordered_map<std::string, Entry> entries_;
  std::vector<std::string> ids_;
  bool may_have_values_ = false;
};

}  // namespace

std::optional<Design> read_design(const Data& data, const Registry& registry, SourceLoader* loader,
                                  Diagnostics& diagnostics) {
  if (!data.members()) {
    diagnostics.error(Code::design_file, data.where, "a design file holds an object, found " + describe(data));
    return std::nullopt;
  }
  return DesignReader(data, registry, loader, diagnostics).run();
}

}  // namespace ombre::design
