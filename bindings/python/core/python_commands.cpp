// Runs jobs, and the command line, inside of Python.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <thread>

#include "base/system/not_copied.h"
#include "base/system/progress.h"
#include "design_objects.h"
#include "expr/expression.h"
#include "jobs/all_jobs.h"
#include "jobs/common/data_events.h"
#include "jobs/common/memory_loader.h"
#include "jobs/common/run_reported.h"
#include "jobs/grid/voxels_in_memory.h"
#include "load/load.h"
#include "ombre/command_line.h"
#include "options/members.h"
#include "python_data.h"

namespace ombre::python {
namespace {

constexpr auto signal_interval = std::chrono::milliseconds(20);

std::vector<const char*> pointers(const std::vector<std::string>& arguments) {
  std::vector<const char*> list{"ombre"};
  for (const std::string& argument : arguments) list.push_back(argument.c_str());
  return list;
}

// A job on a thread of its own. The thread shares ownership, so that the job may outlive the caller: Python ends
// threads in the middle when it exits.
struct RunningJob {
  std::function<int(jobs::Session&)> run;
  compile::LoadedPtr design = nullptr;  // replaces the option that names a design file
  CachePtr cache = nullptr;
  StopFlag stop = {};
  std::mutex mutex = {};
  std::condition_variable changed = {};
  std::deque<DataMembers> events = {};  // events that were not handed over yet
  bool is_done = false;
  std::string data = {};
  int code = 0;
};

// Runs the job and returns an exit code, as the command line does.
int run_job(RunningJob& running, const jobs::Events& events) {
  jobs::Session session{events, running.stop, compile::load_design, *running.cache, "ombre " OMBRE_VERSION};
  if (running.design) session.load = jobs::memory_loader(running.design, false);
  return jobs::run_reported(events, [&] { return running.run(session); });
}

void work(RunningJob& job) {
  const jobs::DataEvents events(
      FrontEnd::python,
      [&](const DataMembers& event) {
        const std::scoped_lock lock(job.mutex);
        job.events.push_back(event);
        job.changed.notify_one();
      },
      [&](const std::string& text) { job.data += text; });
  job.code = run_job(job, events);
  const std::scoped_lock lock(job.mutex);
  job.is_done = true;
  job.changed.notify_one();
}

// A guard that stops a command when nobody waits for it any more.
class StopAtEnd : NotCopied {
 public:
  explicit StopAtEnd(StopFlag& stop) : stop_(stop) {}
  ~StopAtEnd() { stop_.request(); }

 private:
  StopFlag& stop_;
};

// Takes the events since the last call, and waits a little for some; returns false once the command has ended.
bool next_events(RunningJob& command, std::deque<DataMembers>& events) {
  // A guard is not possible here: when Python exits it ends this thread in RestoreThread, which no destructor would
  // survive.
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

// Waits for the end, and hands events over as they come. Raises exceptions of `on_event`, and KeyboardInterrupt once
// the command has stopped in good order.
void wait_for(RunningJob& command, const py::object& on_event) {
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

DataMembers members_of(const py::dict& options) {
  DataMembers members;
  for (const auto& [key, value] : options) {
    const auto name = py::cast<std::string>(key);
    members.emplace_back(name, to_data(value, call_site(), name));
  }
  return members;
}

// Runs the job to its end; a design in memory replaces the option that names one.
void run_to_end(const std::shared_ptr<RunningJob>& running, const CachePtr& cache, DesignHandle* design,
                const py::object& on_event) {
  running->cache = cache;
  if (design) running->design = design->loaded();
  std::thread([running] { work(*running); }).detach();
  wait_for(*running, on_event);
  if (running->code != jobs::done && design) design->raise_failures();
}

// Runs a job; returns (exit code, its output as text or bytes).
py::tuple run_kind(const CachePtr& cache, const std::string& kind, const py::dict& options, DesignHandle* design,
                   const py::object& on_event) {
  const jobs::JobKind* found = jobs::find_job(kind);
  if (!found) throw py::key_error(kind);
  const auto running = std::make_shared<RunningJob>();
  running->run = [found, members = members_of(options)](jobs::Session& session) {
    const std::shared_ptr<void> job = found->make();
    options::read_members(found->options(), job.get(), members);
    return found->run(job.get(), session);
  };
  run_to_end(running, cache, design, on_event);
  return py::make_tuple(running->code, py::bytes(running->data));
}

// Computes voxels with the options of `ombre voxels`; returns (exit code, [(kind of the numbers, the numbers)]).
py::tuple make_voxels(const CachePtr& cache, const py::dict& options, DesignHandle& design,
                      const py::object& on_event) {
  const auto running = std::make_shared<RunningJob>();
  const auto made = std::make_shared<std::vector<compile::VolumeInMemory>>();
  running->run = [made, members = members_of(options)](jobs::Session& session) {
    compile::GridChoices choices;
    options::read_members(compile::GridChoices::options().options(), &choices, members);
    return jobs::make_voxels(choices, session, *made);
  };
  run_to_end(running, cache, &design, on_event);
  py::list grids;
  if (running->code != jobs::done) return py::make_tuple(running->code, grids);
  for (const compile::VolumeInMemory& grid : *made) {
    DataMembers about = exporting::describe(grid.volume);
    about.emplace_back("data_type", grid.volume.is_float ? "float32" : "uint8");
    grids.append(py::make_tuple(to_python(about), py::bytes(grid.numbers)));
  }
  return py::make_tuple(running->code, grids);
}

py::list describe_jobs() {
  py::list list;
  for (const jobs::JobKind& kind : jobs::all_jobs())
    list.append(to_python(DataMembers{{"name", kind.name},
                                      {"help", kind.help},
                                      {"options", options::describe(kind.options())},
                                      {"endings", DataList(kind.endings.begin(), kind.endings.end())}}));
  return list;
}

// Runs the whole command line on this process's own streams. `load_script` returns the design of a .py file, or None
// after it has reported what is wrong.
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
  if (code != jobs::done && !script_design.is_none()) script_design.cast<DesignHandle&>().raise_failures();
  return code;
}

}  // namespace

void add_commands(py::module_& module, const CachePtr& cache) {
  module.def(
      "run_job",
      [cache](const std::string& kind, const py::dict& options, DesignHandle* design, const py::object& on_event) {
        return run_kind(cache, kind, options, design, on_event);
      },
      py::arg("kind"), py::arg("options"), py::arg("design") = nullptr, py::arg("on_event") = py::none());
  module.def("run_main", [cache](const std::vector<std::string>& arguments, const py::function& load_script) {
    return run_main(arguments, load_script, cache);
  });
  module.def("voxels", [cache](const py::dict& options, DesignHandle& design, const py::object& on_event) {
    return make_voxels(cache, options, design, on_event);
  });
  module.def("jobs", &describe_jobs);
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
