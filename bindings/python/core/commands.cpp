// The command line inside of Python.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <thread>

#include "base/progress.h"
#include "data.h"
#include "designs.h"
#include "expr/expression.h"
#include "ombre/command_line.h"

namespace ombre::python {
namespace {

constexpr auto signal_interval = std::chrono::milliseconds(20);

std::vector<const char*> pointers(const std::vector<std::string>& arguments) {
  std::vector<const char*> list{"ombre"};
  for (const std::string& argument : arguments) list.push_back(argument.c_str());
  return list;
}

// A command on a thread of its own; its events are taken on the thread that waits for it.
class RunningCommand {
 public:
  RunningCommand(std::vector<std::string> arguments, compile::LoadedPtr design)
      : arguments_(std::move(arguments)), design_(std::move(design)) {}

  // Waits for the end, and hands events over as they come. Raises what `on_event` raises, and KeyboardInterrupt,
  // once the command has stopped in good order.
  int run(const py::object& on_event) {
    std::thread worker([this] { work(); });
    std::unique_ptr<py::error_already_set> raised;
    bool running = true;
    while (running) {
      std::deque<DataMembers> events;
      {
        const py::gil_scoped_release unlocked;
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, signal_interval, [&] { return is_done_ || !events_.empty(); });
        events.swap(events_);
        running = !is_done_ || !events_.empty();
      }
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!raised && !on_event.is_none())
          for (const DataMembers& event : events) on_event(to_python(event));
      } catch (const py::error_already_set& error) {
        if (!raised) raised = std::make_unique<py::error_already_set>(error);
        stop_.request();
      }
    }
    {
      const py::gil_scoped_release unlocked;
      worker.join();
    }
    if (raised) throw std::move(*raised);
    return code_;
  }

  const std::string& data() const { return data_; }

 private:
  void work() {
    cli::Host host;
    host.stop = &stop_;
    host.on_event = [this](const DataMembers& event) {
      const std::scoped_lock lock(mutex_);
      events_.push_back(event);
      changed_.notify_one();
    };
    host.on_data = [this](const std::string& text) { data_ += text; };
    if (design_) host.load = [this](const std::string&, const compile::LoadOptions&, Diagnostics&) { return design_; };
    const auto list = pointers(arguments_);
    code_ = cli::run(static_cast<int>(list.size()), list.data(), host);
    const std::scoped_lock lock(mutex_);
    is_done_ = true;
    changed_.notify_one();
  }

  std::vector<std::string> arguments_;
  compile::LoadedPtr design_;
  StopFlag stop_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<DataMembers> events_;  // not yet handed over
  bool is_done_ = false;
  std::string data_;
  int code_ = 0;
};

// (exit code, what would go to stdout); a design in memory stands for the argument that names one.
py::tuple run_command(const std::vector<std::string>& arguments, DesignHandle* design, const py::object& on_event) {
  RunningCommand command(arguments, design ? design->loaded() : nullptr);
  const int code = command.run(on_event);
  if (code != cli::done && design) design->raise_failures();
  return py::make_tuple(code, py::bytes(command.data()));
}

// The whole command line, on this process's own streams. `load_script` gives the design of a .py file, or None once
// it told what is wrong.
int run_main(const std::vector<std::string>& arguments, const py::function& load_script) {
  cli::Host host;
  py::object script_design = py::none();
  host.load = [&](const std::string& path, const compile::LoadOptions& options, Diagnostics& diagnostics) {
    if (!path.ends_with(".py")) return compile::load_design(path, options, diagnostics);
    const py::gil_scoped_acquire lock;
    script_design = load_script(path, options.materials, options.definitions);
    if (!script_design.is_none()) return script_design.cast<DesignHandle&>().loaded();
    diagnostics.error({}, path + " gives no design");
    return compile::LoadedPtr();
  };
  const auto list = pointers(arguments);
  int code = 0;
  {
    const py::gil_scoped_release unlocked;
    code = cli::run(static_cast<int>(list.size()), list.data(), host);
  }
  if (code != cli::done && !script_design.is_none()) script_design.cast<DesignHandle&>().raise_failures();
  return code;
}

}  // namespace

void add_commands(py::module_& module) {
  module.def("run_command", &run_command, py::arg("arguments"), py::arg("design") = nullptr,
             py::arg("on_event") = py::none());
  module.def("run_main", &run_main);
  module.def("commands", [] { return to_python(cli::describe_commands()); });
  module.def("functions", [] {
    py::list list;
    for (const expr::FunctionInfo& function : expr::function_table())
      list.append(
          py::make_tuple(std::string(function.name), std::string(function.arguments), std::string(function.meaning)));
    return list;
  });
  module.def("coordinates", &expr::coordinate_names);
}

}  // namespace ombre::python
