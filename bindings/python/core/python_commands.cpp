// The command line inside of Python.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <thread>

#include "base/system/progress.h"
#include "python_data.h"
#include "design_objects.h"
#include "expr/expression.h"
#include "load/load.h"
#include "ombre/command_line.h"

namespace ombre::python {
namespace {

constexpr auto signal_interval = std::chrono::milliseconds(20);

std::vector<const char*> pointers(const std::vector<std::string>& arguments) {
  std::vector<const char*> list{"ombre"};
  for (const std::string& argument : arguments) list.push_back(argument.c_str());
  return list;
}

// A command on a thread of its own. The thread keeps it, so that it may outlive who waits for it: Python ends threads
// in the middle when it exits.
struct RunningCommand {
  std::vector<std::string> arguments;
  compile::LoadedPtr design;
  CachePtr cache;
  StopFlag stop;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<DataMembers> events;  // not yet handed over
  bool is_done = false;
  std::string data;
  int code = 0;
};

void work(RunningCommand& command) {
  cli::Host host;
  host.stop = &command.stop;
  host.cache = command.cache.get();
  host.front_end = FrontEnd::python;
  host.on_event = [&](const DataMembers& event) {
    const std::scoped_lock lock(command.mutex);
    command.events.push_back(event);
    command.changed.notify_one();
  };
  host.on_data = [&](const std::string& text) { command.data += text; };
  if (command.design)
    host.load = [&](const std::string&, const compile::LoadOptions&, Diagnostics&) { return command.design; };
  const auto list = pointers(command.arguments);
  command.code = cli::run(static_cast<int>(list.size()), list.data(), host);
  const std::scoped_lock lock(command.mutex);
  command.is_done = true;
  command.changed.notify_one();
}

// Stops a command whose end nobody waits for any more.
class StopAtEnd {
 public:
  explicit StopAtEnd(StopFlag& stop) : stop_(stop) {}
  ~StopAtEnd() { stop_.request(); }
  StopAtEnd(const StopAtEnd&) = delete;
  StopAtEnd& operator=(const StopAtEnd&) = delete;

 private:
  StopFlag& stop_;
};

// The events since the last call, waiting for some a little while; false once the command has ended.
bool next_events(RunningCommand& command, std::deque<DataMembers>& events) {
  // Not by a guard: when Python exits it ends this thread in RestoreThread, which no destructor would survive.
  PyThreadState* const state = PyEval_SaveThread();
  bool is_running = true;
  {
    std::unique_lock lock(command.mutex);
    command.changed.wait_for(lock, signal_interval, [&] { return command.is_done || !command.events.empty(); });
    events.swap(command.events);
    is_running = !command.is_done;
  }
  PyEval_RestoreThread(state);
  return is_running;
}

// Waits for the end, and hands events over as they come. Raises what `on_event` raises, and KeyboardInterrupt, once
// the command has stopped in good order.
void wait_for(RunningCommand& command, const py::object& on_event) {
  const StopAtEnd stop_at_end(command.stop);
  std::unique_ptr<py::error_already_set> raised;
  for (bool running = true; running;) {
    std::deque<DataMembers> events;
    running = next_events(command, events);
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (raised || on_event.is_none()) continue;
      for (const DataMembers& event : events) on_event(to_python(event));
    } catch (const py::error_already_set& error) {
      if (!raised) raised = std::make_unique<py::error_already_set>(error);
      command.stop.request();
    }
  }
  if (raised) throw py::error_already_set(*raised);
}

// (exit code, what would go to stdout); a design in memory stands for the argument that names one.
py::tuple run_command(const CachePtr& cache, const std::vector<std::string>& arguments, DesignHandle* design,
                      const py::object& on_event) {
  const auto command = std::make_shared<RunningCommand>();
  command->arguments = arguments;
  command->cache = cache;
  if (design) command->design = design->loaded();
  std::thread([command] { work(*command); }).detach();
  wait_for(*command, on_event);
  if (command->code != cli::done && design) design->raise_failures();
  return py::make_tuple(command->code, py::bytes(command->data));
}

// The whole command line, on this process's own streams. `load_script` gives the design of a .py file, or None once
// it has reported what is wrong.
int run_main(const std::vector<std::string>& arguments, const py::function& load_script, const CachePtr& cache) {
  cli::Host host;
  host.cache = cache.get();
  py::object script_design = py::none();
  host.load = [&](const std::string& path, const compile::LoadOptions& options, Diagnostics& diagnostics) {
    if (!path.ends_with(".py")) return compile::load_design(path, options, diagnostics);
    const py::gil_scoped_acquire lock;
    script_design = load_script(path, options.materials, options.definitions);
    if (!script_design.is_none()) return script_design.cast<DesignHandle&>().loaded();
    diagnostics.error(Code::script, {}, path + " gives no design");
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

void add_commands(py::module_& module, const CachePtr& cache) {
  module.def(
      "run_command",
      [cache](const std::vector<std::string>& arguments, DesignHandle* design, const py::object& on_event) {
        return run_command(cache, arguments, design, on_event);
      },
      py::arg("arguments"), py::arg("design") = nullptr, py::arg("on_event") = py::none());
  module.def("run_main", [cache](const std::vector<std::string>& arguments, const py::function& load_script) {
    return run_main(arguments, load_script, cache);
  });
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
