// Runs the jobs that the page starts, of any kind, one at a time; each may pause.
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
  std::string file;    // name of the design on the page
  std::string name;    // name of the folder on the page
  std::string folder;  // path of the folder
  bool replace = false;
  const jobs::JobKind* kind = nullptr;  // null: a slice stack by the choices
  DataMembers members = {};             // values of the kind's options, with absolute paths
  DataMembers shown = {};               // the same values as the page has them
};

// The queue of jobs. Thread-safe. A job writes the files that the command of its kind would. When a job pauses or ends,
// or the program is killed, finished parts of slice stacks and searches stay, and the same request continues from
// there; jobs of other kinds begin again.
class Exports {
 public:
  // A function that gets a job's state when it changes, and now and then while it works, from any thread.
  using Report = std::function<void(const DataMembers& job)>;

  // `program` is the text for job.json: "ombre 0.1.0".
  Exports(Report report, sources::SourceCache& cache, std::string program);
  // Pauses the job that works, and waits for it.
  ~Exports();
  Exports(const Exports&) = delete;
  Exports& operator=(const Exports&) = delete;

  bool is_at_work() const;  // true also if jobs wait

  // Adds a job and describes it. Throws RequestError if a job for the folder works or waits already.
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
