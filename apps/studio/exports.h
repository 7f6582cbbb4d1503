// Jobs of any kind that the page started. They run one at a time, and may be paused.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "base/system/progress.h"
#include "jobs/common/job_kind.h"
#include "studio/designs.h"

namespace ombre::studio {

struct ExportRequest {
  OpenDesignPtr design;
  JobChoices choices;
  std::string file;    // file of the design, as the page names it
  std::string name;    // name of the folder, as the page names it
  std::string folder;  // path of the folder
  bool replace = false;
  const jobs::JobKind* kind = nullptr;  // kind of the job; null for a slice stack by the choices
  DataMembers members = {};             // the kind's options, with absolute paths
  DataMembers shown = {};               // the same options, as the page names them
};

// Runs jobs, which write the same files as the command of their kind. Slice stacks and searches keep finished work when
// they are paused, end, or the program is killed, and the same request continues from there; other jobs start again.
// Thread-safe.
class Exports {
 public:
  // Called with a job's state when it changes, and regularly while it works, from any thread.
  using Report = std::function<void(const DataMembers& job)>;

  // Constructs a queue without jobs; `program` is written to job.json, such as "ombre 0.1.0".
  Exports(Report report, sources::SourceCache& cache, std::string program);
  // Pauses the running job and waits for it.
  ~Exports();
  Exports(const Exports&) = delete;
  Exports& operator=(const Exports&) = delete;

  bool is_at_work() const;  // true if a job is running or waiting

  // Starts a job and returns its description. Throws RequestError if a job for the folder is running or waiting.
  DataMembers start(const ExportRequest& request);
  // These throw RequestError if there is no such job, or its state does not allow the change.
  void pause(int64_t id);
  void resume(int64_t id);
  void cancel(int64_t id);
  DataList list() const;

 private:
  enum class State { waiting, working, paused, done, failed, cancelled };
  struct Job;
  class Watch;
  using JobPtr = std::shared_ptr<Job>;

  void run();
  void work(Job& job);
  void slice(Job& job, const StopFlag& stop);
  void run_kind(Job& job, const StopFlag& stop);
  void take(Job& job, const DataMembers& event);
  static void go_on(ExportRequest& request);
  void end(Job& job, State state, const std::string& message);
  JobPtr find(int64_t id);
  JobPtr next();
  void stop(int64_t id, State state);
  static DataMembers describe(const Job& job);

  Report report_;
  sources::SourceCache& cache_;
  std::string program_;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::list<JobPtr> jobs_;
  int64_t count_ = 0;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace ombre::studio
