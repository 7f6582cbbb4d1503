// Jobs of any kind that the page started. They run one at a time, and may be paused.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/system/not_copied.h"
#include "base/system/progress.h"
#include "base/system/temporary_folder.h"
#include "jobs/common/job_kind.h"
#include "studio/designs.h"
#include "studio/workspace/downloads.h"

namespace ombre::studio {

struct ExportRequest {
  OpenDesignPtr design;
  JobChoices choices;
  std::string file;    // file of the design, as the page names it
  std::string name;    // name of the folder, as the page names it
  std::string folder;  // path of the folder
  bool replace = false;
  const jobs::JobKind* kind = nullptr;                      // kind of the job; null for a slice stack by the choices
  DataMembers members = {};                                 // the kind's options, with absolute paths
  DataMembers shown = {};                                   // the same options, as the page names them
  std::shared_ptr<const TemporaryFolder> holder = nullptr;  // holds the output of a job that is only for a download
};

// Runs jobs, which write the same files as the command of their kind. Slice stacks and searches keep finished work when
// they are paused, end, or the program is killed, and the same request continues from there; other jobs start again.
// The list of jobs can be kept between starts of the program. Thread-safe.
class Exports : NotCopied {
 public:
  // Called with a job's state when it changes, and regularly while it works, from any thread.
  using Report = std::function<void(const DataMembers& job)>;

  // Called with the list of jobs, as adopt() takes it, when the state of one changes.
  using Keep = std::function<void(const DataList& jobs)>;

  // Constructs a queue without jobs; `program` is written to job.json, such as "ombre 0.1.0".
  Exports(Report report, Keep keep, sources::SourceCache& cache, std::string program);
  // Pauses the running job and waits for it.
  ~Exports();

  bool is_at_work() const;  // true if a job is running or waiting

  // Lists the jobs of an earlier start of the program. Those that were not at their end are interrupted.
  void adopt(const DataList& kept);
  // Returns the description of a job of an earlier start, with what is needed to go on; nothing for other jobs.
  std::optional<Data> adopted(int64_t id) const;
  // Goes on with such a job by a request that was made from its description.
  void revive(int64_t id, const ExportRequest& request);

  // Starts a job and returns its description. Throws RequestError if a job for the folder is running or waiting.
  DataMembers start(const ExportRequest& request);
  // These throw RequestError if there is no such job, or its state does not allow the change.
  void pause(int64_t id);
  void resume(int64_t id);
  void cancel(int64_t id);
  DataList list() const;
  // Returns the file or folder that a finished job has written, and what holds it. Throws RequestError if there is no
  // such job, or it has not finished.
  Download output(int64_t id) const;

 private:
  enum class State { waiting, working, paused, done, failed, cancelled, interrupted };
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
  JobPtr find(int64_t id) const;
  JobPtr next();
  void stop(int64_t id, State state);
  static DataMembers describe(const Job& job);
  DataMembers to_keep(const Job& job) const;
  void tell(const Job& job);
  void keep_list();

  Report report_;
  std::mutex report_mutex_;
  Keep keep_;
  std::mutex keep_mutex_;
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
