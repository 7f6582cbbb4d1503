#include "design_objects.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <unordered_set>

#include "base/text/json.h"
#include "base/text/text.h"
#include "host_function.h"
#include "jobs/slice/slice_request.h"
#include "load/library_folders.h"
#include "load/library_operators.h"
#include "load/load.h"
#include "load/node_registry.h"
#include "python_data.h"
#include "questions/build.h"

namespace ombre::python {
namespace {

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

template <class F>
void each_function(const Data& data, const F& f) {
  if (const DataList* list = data.list())
    for (const Data& element : *list) each_function(element, f);
  if (const auto function = std::dynamic_pointer_cast<const HostFunction>(data.host_object())) f(*function);
}

// Raises the exception of a function of the node or of those below it; `path` leads to the node.
void raise_below(const design::Node& node, const std::string& path, std::unordered_set<const design::Node*>& seen) {
  if (!seen.insert(&node).second) return;
  std::string here = path;
  here.append(" > ").append(node.type().name);
  for (size_t i = 0; i < node.type().parameters.size(); ++i)
    each_function(node.type().get(node, i, false), [&](const HostFunction& f) { f.raise_failure(here); });
  for (const design::NodePtr& other : node.dependencies()) raise_below(*other, here, seen);
}

py::tuple tuple_of(Vec3 v) { return py::make_tuple(v.x, v.y, v.z); }

compile::SampleQuery query_for(const std::string& question, const design::Design& design) {
  compile::SampleQuery query;
  if (question == "inside") query.inside = true;
  if (question == "distance") query.distance = true;
  if (question == "material") query.inside = query.fractions = true;
  if (question == "all") query = {true, true, true, false, compile::all_attribute_parts(design)};
  if (question.starts_with("attribute ")) query.attributes = compile::attribute_parts(design, question.substr(10));
  return query;
}

const char* name(compile::Sampler::Column::Kind kind) {
  constexpr const char* names[] = {"inside", "distance", "fraction", "attribute", "part", "check"};
  return names[static_cast<size_t>(kind)];
}

// Returns [(kind, name, values)], with as many values as points.
py::list sample(DesignHandle& handle, const Points& points, const std::string& question, int threads) {
  if (points.ndim() != 2 || points.shape(1) != 3) throw py::value_error("points have the shape (N, 3), mm");
  const std::shared_ptr<const compile::Sampler> sampler = handle.sampler(question);
  std::vector<py::array_t<double>> arrays;
  std::vector<double*> columns;
  for (size_t c = 0; c < sampler->columns().size(); ++c) {
    arrays.emplace_back(points.shape(0));
    columns.push_back(arrays.back().mutable_data());
  }
  const auto* const first = reinterpret_cast<const Vec3*>(points.data());
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  bool has_failed = false;
  {
    const py::gil_scoped_release unlocked;
    try {
      sampler->sample({first, static_cast<size_t>(points.shape(0))}, columns, threads);
    } catch (const HostFailure&) {
      has_failed = true;
    }
  }
  if (has_failed) handle.raise_failures();
  py::list result;
  for (size_t c = 0; c < arrays.size(); ++c)
    result.append(py::make_tuple(name(sampler->columns()[c].kind), sampler->columns()[c].name, arrays[c]));
  return result;
}

// Refuses a NumPy whose arrays this build cannot read; its values would silently be wrong.
void check_numpy() {
  const Points twice = py::module_::import("numpy").attr("arange")(6.0).attr("reshape")(2, 3);
  py::array_t<double> made(2);
  bool fits = twice.itemsize() == sizeof(double) && twice.size() == 6 && made.strides(0) == sizeof(double);
  for (py::ssize_t n = 0; fits && n < 6; ++n) fits = twice.data()[n] == static_cast<double>(n);
  if (fits) return;
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  throw py::import_error("this ombre was not built for NumPy " + version +
                         ": install another with pip install 'numpy>=1.22,<3', or build ombre again");
}

FactoryPtr make_factory(const CachePtr& cache, const std::string& path) {
  Diagnostics diagnostics;
  auto materials = compile::load_materials(path, diagnostics);
  raise_errors(diagnostics);
  return std::make_shared<compile::NodeFactory>(std::move(*materials), cache);
}

compile::NodeFactory::Arguments arguments_of(const py::tuple& positional, const py::dict& named,
                                             const SourceRange& where, const std::string& callee) {
  compile::NodeFactory::Arguments arguments;
  for (const py::handle value : positional) arguments.emplace_back("", to_data(value, where, callee));
  for (const auto& [key, value] : named) {
    auto parameter = key.cast<std::string>();
    Data data = to_data(value, where, parameter);
    arguments.emplace_back(std::move(parameter), std::move(data));
  }
  return arguments;
}

std::vector<design::NodePtr> nodes_of(const std::vector<NodeHandle>& inputs, const FactoryPtr& factory,
                                      const std::string& callee) {
  std::vector<design::NodePtr> nodes;
  for (const NodeHandle& input : inputs) {
    if (&input.factory->materials().all() != &factory->materials().all())
      throw py::value_error(callee + ": its inputs were made with other materials; give all of them the same");
    nodes.push_back(input.node);
  }
  return nodes;
}

NodeHandle make_node(const FactoryPtr& factory, const std::string& type, const py::tuple& positional,
                     const py::dict& named, const std::vector<NodeHandle>& inputs,
                     const std::optional<std::pair<std::string, int>>& place) {
  const SourceRange where = place ? line_of(place->first, place->second) : call_site();
  compile::NodeFactory::Arguments arguments = arguments_of(positional, named, where, type);
  std::vector<design::NodePtr> nodes = nodes_of(inputs, factory, type);
  Diagnostics diagnostics;
  design::NodePtr node = factory->make(type, std::move(arguments), std::move(nodes), where, diagnostics);
  raise_errors(diagnostics);
  return {std::move(node), factory};
}

// Returns {"from": node, "output": name}.
py::tuple output_of(const Data& data, const FactoryPtr& factory) {
  const auto object = std::dynamic_pointer_cast<const design::NodeObject>(data.find("from")->host_object());
  return py::make_tuple(NodeHandle{object->node(), factory}, *data.find("output")->string());
}

// Returns a parameter; expressions of outputs become expressions of Python, and mixtures values.
py::object parameter(const Data& data, const FactoryPtr& factory) {
  if (const DataList* list = data.list()) {
    py::list result;
    for (const Data& element : *list) result.append(parameter(element, factory));
    return result;
  }
  if (!design::is_value(data)) return to_python(data);
  if (const Data* from = data.find("from"); from && !data.find("output")) {  // refers to a solid
    const auto object = std::dynamic_pointer_cast<const design::NodeObject>(from->host_object());
    return py::module_::import("ombre._solid").attr("wrap")(NodeHandle{object->node(), factory});
  }
  const py::module_ values = py::module_::import("ombre._values");
  if (design::is_mixture(data)) return values.attr("from_node")(*output_of(data, factory));
  py::dict outputs;
  const Data* formula = data.find("formula");
  if (!formula) outputs["v"] = output_of(data, factory);
  for (const auto& [name, value] : formula ? *data.find("with")->members() : DataMembers{})
    outputs[py::str(name)] = output_of(value, factory);
  return values.attr("from_parameter")(formula ? *formula->string() : std::string(), outputs);
}

// Returns the value of a function of a library; members of an object are those of a SimpleNamespace.
py::object function_result(const Data& data, const FactoryPtr& factory) {
  if (const DataList* list = data.list()) {
    py::list result;
    for (const Data& element : *list) result.append(function_result(element, factory));
    return result;
  }
  if (const auto node = std::dynamic_pointer_cast<const design::NodeObject>(data.host_object())) {
    const bool is_solid = node->node()->type().is_solid();
    const py::object convert = is_solid ? py::module_::import("ombre._solid").attr("wrap")
                                        : py::module_::import("ombre._values").attr("from_node");
    return convert(NodeHandle{node->node(), factory});
  }
  if (const auto formula = std::dynamic_pointer_cast<const design::FormulaObject>(data.host_object()))
    return parameter(design::write_formula(formula->expression()), factory);
  const Data* from = data.find("from");
  if ((from && from->host_object()) || (data.find("formula") && data.find("with"))) return parameter(data, factory);
  if (!data.members()) return to_python(data);
  py::dict members;
  for (const auto& [name, member] : *data.members()) members[py::str(name)] = function_result(member, factory);
  return py::module_::import("types").attr("SimpleNamespace")(**members);
}

// Calls a module or function of a library, and returns a node or a value.
py::object call_operator(const FactoryPtr& factory, const std::string& library, const std::string& name, bool is_module,
                         const py::tuple& positional, const py::dict& named, const std::vector<NodeHandle>& inputs) {
  const SourceRange where = call_site();
  lang::HostCall call{library, name, is_module, arguments_of(positional, named, where, name),
                      nodes_of(inputs, factory, name)};
  Diagnostics diagnostics;
  const auto result = factory->call(call, where, diagnostics);
  raise_errors(diagnostics);
  if (!is_module) return function_result(result->value, factory);
  return py::module_::import("ombre._solid").attr("wrap")(NodeHandle{result->solid, factory});
}

// Returns the descriptions of the operators in the libraries of these folders.
py::list operators(const std::vector<std::string>& folders) {
  py::list result;
  for (const compile::Operator& op : compile::operators_in(folders))
    result.append(to_python(compile::describe_operator(op)));
  return result;
}

py::dict parameters(const NodeHandle& handle) {
  const design::NodeType& type = handle.node->type();
  py::dict result;
  for (size_t i = 0; i < type.parameters.size(); ++i)
    result[py::str(type.parameters[i].name)] = parameter(type.get(*handle.node, i, false), handle.factory);
  return result;
}

// Returns (name, form, letters of the parts) of each output that the node gives.
py::list outputs(const NodeHandle& handle) {
  py::list result;
  for (size_t i = 0; i < handle.node->type().outputs.size(); ++i) {
    const design::OutputInfo& info = handle.node->type().outputs[i];
    if (handle.node->gives(i))
      result.append(py::make_tuple(info.name, std::string(name(info.type.form)), std::string(info.type.parts)));
  }
  return result;
}

// Returns the value of an output that is a constant.
py::object constant(const NodeHandle& handle, const std::string& output) {
  return to_python(handle.node->constant(handle.node->type().output(output).value()));
}

// True if the solid, or a solid inside it, has the output, which varies in space.
bool has_output(const NodeHandle& handle, const std::string& output) {
  const design::OutputType* type = handle.node->type().is_solid() ? handle.node->output_type(output) : nullptr;
  return type && type->form == design::OutputForm::numbers;
}

// True if the node itself has the output, which is a constant.
bool has_constant(const NodeHandle& handle, const std::string& output) {
  const auto number = handle.node->type().output(output);
  return number && handle.node->gives(*number) &&
         handle.node->type().outputs[*number].type.form == design::OutputForm::constant;
}

std::vector<NodeHandle> inputs(const NodeHandle& handle) {
  std::vector<NodeHandle> result;
  for (const design::NodePtr& input : handle.node->inputs()) result.push_back({input, handle.factory});
  return result;
}

py::list materials_list(const design::MaterialTable& table) {
  py::list list;
  for (const design::Material& material : table.all()) {
    py::dict entry;
    entry["name"] = material.name;
    entry["id"] = static_cast<int>(material.id);
    entry["colour"] = py::make_tuple(material.colour[0], material.colour[1], material.colour[2], material.colour[3]);
    entry["properties"] = to_python(material.properties);
    list.append(entry);
  }
  return list;
}

std::array<Pitch, 3> read_pitches(const std::vector<std::string>& texts) {
  std::array<Pitch, 3> pitches;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto pitch = Pitch::parse(texts.at(axis));
    if (!pitch) throw py::value_error("\"" + texts[axis] + "\" is not a voxel size in mm; write for example \"0.1\"");
    pitches[axis] = *pitch;
  }
  return pitches;
}

using PartList = std::vector<std::pair<std::string, NodeHandle>>;

std::unique_ptr<DesignHandle> make_design(const PartList& parts,
                                          const std::optional<std::vector<std::array<double, 3>>>& box,
                                          const std::vector<std::string>& voxel) {
  if (parts.empty()) throw py::value_error("a design has at least one part");
  const FactoryPtr factory = parts[0].second.factory;
  design::Design design{factory->materials(), {}, std::nullopt};
  for (const auto& [part_name, handle] : parts) {
    if (&handle.factory->materials().all() != &factory->materials().all())
      throw py::value_error("the parts were made with different materials; give all of them the same");
    for (const design::Part& other : design.parts)
      if (other.name == part_name) throw py::value_error("there are two parts with the name \"" + part_name + "\"");
    design.parts.push_back({part_name, handle.node});
  }
  if (box) {
    const auto corner = [&](size_t i) { return Vec3{(*box)[i][0], (*box)[i][1], (*box)[i][2]}; };
    design.sampling = design::Sampling{{corner(0), corner(1)}, read_pitches(voxel)};
  }
  Diagnostics diagnostics;
  design::check_design(design, diagnostics);
  raise_errors(diagnostics);
  const SourceRange where = design.parts[0].solid->where();
  const SourcePtr source = where.source ? where.source : make_source("design", "");
  auto loaded = std::make_shared<const compile::Loaded>(compile::Loaded{source->name(), source, std::move(design)});
  return std::make_unique<DesignHandle>(std::move(loaded), factory);
}

// Loads a design; `text`, if given, replaces that of the file.
std::unique_ptr<DesignHandle> load(const CachePtr& cache, const std::string& path, const std::string& materials,
                                   const std::vector<std::string>& definitions, const std::optional<std::string>& text,
                                   const std::vector<std::string>& material_map) {
  Diagnostics diagnostics;
  compile::LoadOptions options;
  options.materials = materials;
  options.definitions = definitions;
  options.material_map = material_map;
  options.cache = cache.get();
  compile::LoadedPtr loaded;
  {
    const py::gil_scoped_release unlocked;
    loaded =
        text ? compile::load_text(*text, path, options, diagnostics) : compile::load_design(path, options, diagnostics);
  }
  raise_errors(diagnostics);
  return std::make_unique<DesignHandle>(loaded,
                                        std::make_shared<compile::NodeFactory>(loaded->design.materials, cache));
}

py::dict about(sources::SourceCache& cache) {
  py::dict result;
  result["bytes"] = cache.bytes();
  result["most_bytes"] = cache.most_bytes();
  result["file_reads"] = cache.files().reads();
  return result;
}

std::unique_ptr<DesignHandle> from_json(const CachePtr& cache, const std::string& text) {
  const SourcePtr source = make_source("design.json", text);
  Diagnostics diagnostics;
  compile::DesignSources loader(*cache);
  std::optional<design::Design> design;
  if (const auto data = parse_json(source, diagnostics))
    design = design::read_design(*data, compile::node_registry(), &loader, diagnostics);
  if (design) design::check_design(*design, diagnostics);
  raise_errors(diagnostics);
  const auto factory = std::make_shared<compile::NodeFactory>(design->materials, cache);
  auto loaded = std::make_shared<const compile::Loaded>(compile::Loaded{"design.json", source, std::move(*design)});
  return std::make_unique<DesignHandle>(std::move(loaded), factory);
}

std::string to_json(const DesignHandle& handle) {
  if (const design::Node* node = design::find_host_function(handle.design())) {
    Diagnostics diagnostics;
    diagnostics.error(Code::parameters, node->where(),
                      node->type().name + " has a Python function, so the design can be neither saved, copied to " +
                          "another process nor resumed: nothing tells what the function is",
                      "write it as an expression", {{"node", node->type().name}});
    raise_errors(diagnostics);
  }
  return print_json(design::to_data(handle.design()));
}

py::tuple bounds(const DesignHandle& handle) {
  Diagnostics diagnostics;
  const auto box = compile::design_box(handle.design(), diagnostics);
  raise_errors(diagnostics);
  return py::make_tuple(tuple_of(box->lo), tuple_of(box->hi));
}

py::object sampling(const DesignHandle& handle) {
  if (!handle.design().sampling) return py::none();
  const auto& [box, pitch] = *handle.design().sampling;
  return py::make_tuple(tuple_of(box.lo), tuple_of(box.hi),
                        py::make_tuple(pitch[0].text(), pitch[1].text(), pitch[2].text()));
}

py::object place(const NodeHandle& handle) {
  const SourceRange& where = handle.node->where();
  if (!where.source) return py::none();
  return py::make_tuple(where.source->name(), where.source->place(where.begin).line);
}

}  // namespace

DesignHandle::DesignHandle(compile::LoadedPtr loaded, FactoryPtr factory)
    : loaded_(std::move(loaded)), factory_(std::move(factory)) {}

std::shared_ptr<const compile::Sampler> DesignHandle::sampler(const std::string& question) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto known = samplers_.find(question); known != samplers_.end()) return known->second;
  }
  // The sampler is built without the lock, since it may call functions of Python. If several threads build one, the
  // first counts.
  Diagnostics diagnostics;
  const compile::SampleQuery query = query_for(question, design());
  std::optional<compile::Sampler> built;
  try {
    const py::gil_scoped_release unlocked;  // released, since threads may call functions of Python
    built = compile::Sampler::build(design(), query, diagnostics);
  } catch (const HostFailure&) {
    raise_failures();
    throw;
  }
  raise_errors(diagnostics);
  auto sampler = std::make_shared<const compile::Sampler>(std::move(*built));
  const std::scoped_lock lock(mutex_);
  return samplers_.emplace(question, std::move(sampler)).first->second;
}

void DesignHandle::raise_failures() const {
  std::unordered_set<const design::Node*> seen;
  for (const design::Part& part : design().parts) raise_below(*part.solid, part.name, seen);
}

void add_designs(py::module_& module, const CachePtr& cache) {
  py::class_<compile::NodeFactory, FactoryPtr>(module, "Factory", "Makes nodes that name one table of materials.")
      .def(py::init([cache](const std::string& path) { return make_factory(cache, path); }), py::arg("path"))
      .def("make", &make_node, py::arg("type"), py::arg("positional"), py::arg("named"), py::arg("inputs"),
           py::arg("place") = py::none())
      .def("call", &call_operator, py::arg("library"), py::arg("name"), py::arg("is_module"), py::arg("positional"),
           py::arg("named"), py::arg("inputs"))
      .def_property_readonly("materials", [](const FactoryPtr& f) { return materials_list(f->materials()); });
  py::class_<NodeHandle>(module, "Node", "A node of a design; never changes.")
      .def_property_readonly("type", [](const NodeHandle& h) { return h.node->type().name; })
      .def_property_readonly("metric", [](const NodeHandle& h) { return std::string(name(h.node->metric().kind)); })
      .def_property_readonly("parameters", &parameters)
      .def_property_readonly("inputs", &inputs)
      .def_property_readonly("outputs", &outputs)
      .def("constant", &constant)
      .def("has_output", &has_output)
      .def("has_constant", &has_constant)
      .def("names_materials_of",
           [](const NodeHandle& h, const FactoryPtr& factory) {
             return &h.factory->materials().all() == &factory->materials().all();
           })
      .def_property_readonly("factory", [](const NodeHandle& h) { return h.factory; })
      .def_property_readonly("place", &place)
      .def_property_readonly("address", [](const NodeHandle& h) { return reinterpret_cast<uintptr_t>(h.node.get()); });
  py::class_<DesignHandle>(module, "Design", "Parts, materials, perhaps a box to sample; never changes.")
      .def(py::init(&make_design), py::arg("parts"), py::arg("box") = py::none(),
           py::arg("voxel") = std::vector<std::string>{})
      .def_static(
          "load",
          [cache](const std::string& path, const std::string& materials, const std::vector<std::string>& definitions,
                  const std::optional<std::string>& text, const std::vector<std::string>& material_map) {
            return load(cache, path, materials, definitions, text, material_map);
          },
          py::arg("path"), py::arg("materials") = "", py::arg("definitions") = std::vector<std::string>{},
          py::arg("text") = py::none(), py::arg("material_map") = std::vector<std::string>{})
      .def_static("from_json", [cache](const std::string& text) { return from_json(cache, text); })
      .def("to_json", &to_json)
      .def("tree", [](const DesignHandle& h) { return design::to_tree(h.design()); })
      .def("hash", [](const DesignHandle& h) { return design::hash(h.design()).hex(); })
      .def_property_readonly("bounds", &bounds)
      .def_property_readonly("sampling", &sampling)
      .def_property_readonly("attributes", [](const DesignHandle& h) { return compile::attribute_names(h.design()); })
      .def_property_readonly("materials", [](const DesignHandle& h) { return materials_list(h.design().materials); })
      .def_property_readonly("factory", &DesignHandle::factory)
      .def_property_readonly("parts",
                             [](const DesignHandle& h) {
                               PartList parts;
                               for (const design::Part& part : h.design().parts)
                                 parts.emplace_back(part.name, NodeHandle{part.solid, h.factory()});
                               return parts;
                             })
      .def("sample", &sample, py::arg("points"), py::arg("question"), py::arg("threads") = 0);
  module.def("check_numpy", &check_numpy);
  module.def("operators", [] { return operators(compile::library_folders()); });
  module.def("own_operators", [] { return operators(compile::own_library_folders()); });
  module.def("source_memory", [cache] { return about(*cache); });
  module.def("set_source_memory", [cache](size_t bytes) { cache->set_most_bytes(bytes); });
}

}  // namespace ombre::python
