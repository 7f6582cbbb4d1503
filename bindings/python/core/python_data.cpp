#include "python_data.h"

#include <map>

#include <pybind11/stl.h>

#include "design/outputs.h"
#include "design_objects.h"
#include "host_function.h"

namespace ombre::python {
namespace {

// The package folder. Like the texts of files below, it is guarded by the interpreter's lock.
std::string& package_folder() {
  static std::string folder;
  return folder;
}

bool is_own_file(const std::string& file) {
  return !package_folder().empty() && file.compare(0, package_folder().size(), package_folder()) == 0;
}

// Returns the text of a file of Python code, which messages quote. linecache also knows the cells of notebooks.
SourcePtr read_source(const std::string& file) {
  std::string text;
  for (const py::handle line : py::module_::import("linecache").attr("getlines")(file)) text += py::str(line);
  return make_source(file, std::move(text));
}

SourcePtr source_of(const std::string& file) {
  static auto* const known = new std::map<std::string, SourcePtr>();  // exists as long as the process
  if (const auto found = known->find(file); found != known->end()) return found->second;
  const SourcePtr read = read_source(file);  // other threads may run meanwhile, and read it, too
  return known->try_emplace(file, read).first->second;
}

SourceRange line_range(const SourcePtr& source, int number) {
  std::string_view line = source->line(number);
  const size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {source, 0, 0};
  line.remove_prefix(first);
  const auto begin = static_cast<uint32_t>(line.data() - source->text().data());
  return {source, begin, static_cast<uint32_t>(begin + line.size())};
}

DataList list_of(const py::handle& values, const SourceRange& where, const std::string& what) {
  DataList list;
  for (const py::handle element : values) list.push_back(to_data(element, where, what));
  return list;
}

// number_of and text_of raise OverflowError and UnicodeEncodeError.
double number_of(const py::handle& value) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred()) throw py::error_already_set();
  return number;
}

std::string text_of(const py::handle& value) {
  Py_ssize_t size = 0;
  const char* text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (!text) throw py::error_already_set();
  return {text, static_cast<size_t>(size)};
}

bool has(const py::handle& value, const char* name) { return py::hasattr(value, name); }

HostObjectPtr node_object(const py::handle& node) {
  return std::make_shared<design::NodeObject>(node.cast<const NodeHandle&>().node);
}

// Returns the data of an expression that holds outputs of nodes.
Data formula_of(const py::handle& expression, const SourceRange& where) {
  DataMembers with;
  for (const auto& [name, value] : expression.attr("_ombre_values_").cast<py::dict>()) {
    const auto [node, output] = value.cast<std::pair<py::object, std::string>>();
    with.emplace_back(name.cast<std::string>(),
                      Data(DataMembers{{"from", {node_object(node), where}}, {"output", {output, where}}}, where));
  }
  return {DataMembers{{"formula", {expression.attr("_ombre_text_").cast<std::string>(), where}},
                      {"with", {std::move(with), where}}},
          where};
}

}  // namespace

Data to_data(const py::handle& value, const SourceRange& where, const std::string& what) {
  if (value.is_none()) return {};
  if (py::isinstance<py::bool_>(value)) return {value.cast<bool>(), where};
  if (py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value)) return {number_of(value), where};
  if (py::isinstance<py::str>(value)) return {text_of(value), where};
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return {list_of(value, where, what), where};
  if (has(value, "_ombre_output_")) {
    const auto [node, output] = value.attr("_ombre_output_").cast<std::pair<py::object, std::string>>();
    return {DataMembers{{"from", {node_object(node), where}}, {"output", {output, where}}}, where};
  }
  if (has(value, "_ombre_node_")) return {node_object(value.attr("_ombre_node_")), where};
  if (has(value, "_ombre_values_") && py::len(value.attr("_ombre_values_")) > 0) return formula_of(value, where);
  if (has(value, "_ombre_text_")) return {value.attr("_ombre_text_").cast<std::string>(), where};
  if (has(value, "_ombre_function_")) {
    const HostObjectPtr function = std::make_shared<HostFunction>(value.attr("_ombre_function_"), where);
    return {function, where};
  }
  if (has(value, "tolist")) return to_data(value.attr("tolist")(), where, what);  // arrays and scalars of NumPy
  if (has(value, "__fspath__")) return {py::str(value.attr("__fspath__")()).cast<std::string>(), where};
  throw py::type_error(what + ": expected a number, a text, a list of these, an expression or a function, found " +
                       py::str(py::type::of(value).attr("__name__")).cast<std::string>());
}

py::dict to_python(const DataMembers& members) {
  py::dict dict;
  for (const auto& [name, value] : members) dict[py::str(name)] = to_python(value);
  return dict;
}

py::object to_python(const Data& data) {
  if (const bool* b = data.boolean()) return py::bool_(*b);
  if (const double* n = data.number()) return py::float_(*n);
  if (const std::string* s = data.string()) return py::str(*s);
  if (const DataMembers* members = data.members()) return to_python(*members);
  if (const auto function = std::dynamic_pointer_cast<const HostFunction>(data.host_object()))
    return function->callable();
  const DataList* list = data.list();
  if (!list) return py::none();
  py::list result;
  for (const Data& element : *list) result.append(to_python(element));
  return result;
}

SourceRange call_site() {
  auto* frame = reinterpret_cast<PyObject*>(PyThreadState_GetFrame(PyThreadState_Get()));
  auto held = py::reinterpret_steal<py::object>(frame);
  while (held) {
    auto* const here = reinterpret_cast<PyFrameObject*>(held.ptr());
    const auto code = py::reinterpret_steal<py::object>(reinterpret_cast<PyObject*>(PyFrame_GetCode(here)));
    const auto file = code.attr("co_filename").cast<std::string>();
    if (!is_own_file(file)) return line_range(source_of(file), PyFrame_GetLineNumber(here));
    held = py::reinterpret_steal<py::object>(reinterpret_cast<PyObject*>(PyFrame_GetBack(here)));
  }
  return {};
}

SourceRange line_of(const std::string& file, int number) { return line_range(source_of(file), number); }

void set_package_folder(const std::string& folder) { package_folder() = folder; }

py::list to_python(const Diagnostics& diagnostics) {
  py::list list;
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    py::dict entry;
    entry["severity"] = std::string(name_of(diagnostic.severity));
    entry["message"] = diagnostic.message;
    entry["hint"] = hint_of(diagnostic, FrontEnd::python);
    entry["code"] = std::string(name_of(diagnostic.code));
    py::dict values;
    for (const auto& [name, value] : diagnostic.values) values[py::str(name)] = value;
    entry["values"] = values;
    if (diagnostic.where.source) {
      const Place place = diagnostic.where.source->place(diagnostic.where.begin);
      entry["file"] = diagnostic.where.source->name();
      entry["line"] = place.line;
      entry["column"] = place.column;
    }
    entry["text"] = to_text(diagnostic, FrontEnd::python);
    list.append(entry);
  }
  return list;
}

py::object package_member(const char* name) { return py::module_::import("ombre._errors").attr(name); }

void raise_errors(const Diagnostics& diagnostics) {
  if (diagnostics.list().empty()) return;
  package_member("report")(to_python(diagnostics));
}

}  // namespace ombre::python
