#include "host_function.h"

#include <pybind11/numpy.h>

#include <atomic>

#include "base/text/text.h"
#include "python_data.h"

namespace ombre::python {
namespace {

Hash next_identity() {
  static std::atomic<uint64_t> count{0};
  return hash_bytes("function " + std::to_string(++count));
}

py::array_t<double> coordinates(std::span<const Vec3> points, int axis) {
  py::array_t<double> array(static_cast<py::ssize_t>(points.size()));
  double* to = array.mutable_data();
  for (size_t n = 0; n < points.size(); ++n) to[n] = points[n][axis];
  return array;
}

std::string name_of(const py::object& callable) {
  return py::str(py::getattr(callable, "__name__", py::str("function"))).cast<std::string>();
}

}  // namespace

HostFunction::HostFunction(py::object callable, SourceRange where)
    : callable_(std::move(callable)), where_(std::move(where)), name_(name_of(callable_)), identity_(next_identity()) {}

HostFunction::~HostFunction() {
  if (!Py_IsInitialized()) {  // after Python's end objects cannot be released any more
    callable_.release();
    failure_.release();
    return;
  }
  const py::gil_scoped_acquire lock;
  callable_ = {};
  failure_ = {};
}

double HostFunction::sample(int channel, Vec3 p) const {
  double value = 0;
  sample_all(channel, {&p, 1}, {&value, 1});
  return value;
}

void HostFunction::sample_all(int, std::span<const Vec3> points, std::span<double> values) const {
  if (values.empty()) return;
  const py::gil_scoped_acquire lock;
  const auto fail = [&](const py::object& cause) {
    if (!failure_)
      failure_ =
          package_member("function_failure")(cause, name_, py::make_tuple(points[0].x, points[0].y, points[0].z));
    throw HostFailure();
  };
  try {
    call(points, values);
  } catch (const py::error_already_set& error) {
    fail(error.value());
  } catch (const py::builtin_exception& error) {
    error.set_error();
    fail(py::error_already_set().value());
  }
}

void HostFunction::call(std::span<const Vec3> points, std::span<double> values) const {
  const py::object result = callable_(coordinates(points, 0), coordinates(points, 1), coordinates(points, 2));
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(result);
  if (!numbers) throw py::type_error("the function gave no numbers");
  if (numbers.size() == 1) return std::fill(values.begin(), values.end(), *numbers.data());
  if (numbers.ndim() != 1 || numbers.size() != static_cast<py::ssize_t>(values.size())) {
    const std::string shape = py::str(numbers.attr("shape")).cast<std::string>();
    throw py::value_error("the function gave an array of shape " + shape + " for " + std::to_string(values.size()) +
                          " points; one number for each is needed");
  }
  std::copy_n(numbers.data(), values.size(), values.begin());
}

void HostFunction::raise_failure(const std::string& path) const {
  if (!failure_) return;
  const Place place = where_.source ? where_.source->place(where_.begin) : Place();
  const py::object failure =
      package_member("at_node")(failure_, path, where_.source ? where_.source->name() : "", place.line);
  failure_ = {};
  PyErr_SetObject(py::type::of(failure).ptr(), failure.ptr());
  throw py::error_already_set();
}

}  // namespace ombre::python
