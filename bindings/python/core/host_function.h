// Functions of Python as field sources. They are slower than expressions, and known only to this process.
#pragma once

#include <pybind11/pybind11.h>

#include "base/system/not_copied.h"
#include "base/text/source_text.h"
#include "program/field_source.h"

namespace ombre::python {

namespace py = pybind11;

class HostFunction : public program::FieldSource, NotCopied {
 public:
  // `callable` takes three arrays of coordinates, mm, and returns an array of as many numbers, or one number.
  HostFunction(py::object callable, SourceRange where);
  ~HostFunction() override;

  const py::object& callable() const { return callable_; }

  std::string name() const override { return name_; }
  Hash content() const override { return identity_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view) const override { return 0; }
  double sample(int channel, Vec3 p) const override;
  // Throws HostFailure if the function fails; its exception is kept for `raise_failure`.
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override;

  // Raises the exception of the function, if it failed, with the path to its node, the place and the point. Needs the
  // interpreter's lock.
  void raise_failure(const std::string& path) const;

 private:
  void call(std::span<const Vec3> points, std::span<double> values) const;

  py::object callable_;
  SourceRange where_;
  std::string name_;
  Hash identity_;  // identity of this object, since the meaning of a function is unknown
  mutable py::object failure_;
};

// An exception that ends a job whose function failed.
struct HostFailure : std::exception {
  const char* what() const noexcept override { return "a function of the design failed"; }
};

}  // namespace ombre::python
