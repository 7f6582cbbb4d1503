// Jobs that the page started, of any kind: one at a time, each of which may pause.
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
  std::string file;    // of the design, as the page knows it
  std::string name;    // of the folder, likewise
  std::string folder;  // its path
  bool replace = false;
  const jobs::JobKind* kind = nullptr;  // null: a slice stack by the choices
  DataMembers members = {};             // of the kind's options, with whole paths
  DataMembers shown = {};               // the same, as the page has them
};

// Thread-safe. A job writes the files that the command of its kind would. Of slice stacks and searches what is finished
// stays when a job pauses, ends or the program is killed, and the same request goes on from there; others begin again.
class Exports {
 public:
  // Called with a job's state when it changes, and now and then while it works, from any thread.
  using Report = std::function<void(const DataMembers& job)>;

  // `program` is for job.json: "ombre 0.1.0".
  Exports(Report report, sources::SourceCache& cache, std::string program);
  // Pauses what is at work, and waits for it.
  ~Exports();
  Exports(const Exports&) = delete;
  Exports& operator=(const Exports&) = delete;

  bool is_at_work() const;  // or has jobs that wait

  // The new job. Throws RequestError when the folder's job is at work or waits already.
  DataMembers start(const ExportRequest& request);
  // Each throws RequestError when there is no such job, or it is in no state for that.
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
