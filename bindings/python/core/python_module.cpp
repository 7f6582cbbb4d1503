// The compiled part of the package `ombre`.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "base/system/progress.h"
#include "base/text/error.h"
#include "design_objects.h"
#include "load/data_folder.h"
#include "python_data.h"
#include "questions/colour_map.h"

namespace ombre::python {

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of ombre; use the package.";
  module.attr("version") = OMBRE_VERSION;
  module.def("set_package_folder", &set_package_folder);
  module.def("data_folder", &compile::data_folder);
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Error& error) {
      PyErr_SetString(package_member("MachineError").ptr(), error.what());
    } catch (const Cancelled&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
  module.def("palettes", [] {
    std::map<std::string, std::vector<std::array<int, 3>>> colours;
    for (const compile::Palette& palette : compile::palettes())
      for (const design::Rgba& colour : palette.colours)
        colours[std::string(palette.name)].push_back({colour[0], colour[1], colour[2]});
    return colours;
  });
  const auto cache = std::make_shared<sources::SourceCache>();
  add_designs(module, cache);
  add_commands(module, cache);
  add_point_sets(module);
}

}  // namespace ombre::python
