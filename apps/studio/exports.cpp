#include "studio/exports.h"

#include <algorithm>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "jobs/slice/slice.h"

namespace ombre::studio {

struct Exports::Job {
  int64_t id = 0;
  ExportRequest request;
  State state = State::waiting;
  State wanted = State::done;  // what a stop makes of it: paused or cancelled
  HowFar how_far;
  int64_t layers = 0;
  std::string message;
  std::shared_ptr<StopFlag> stop = std::make_shared<StopFlag>();
};

// Takes how far a job is, and tells it a few times a second.
class Exports::Watch : public Progress {
 public:
  Watch(Exports& exports, Job& job) : exports_(exports), job_(job) {}

  void update(const HowFar& how_far) override {
    DataMembers now;
    {
      const std::lock_guard lock(exports_.mutex_);
      job_.how_far = how_far;
      if (since_report_.seconds() < 0.2) return;
      since_report_ = {};
      now = describe(job_);
    }
    exports_.report_(now);
  }

 private:
  Exports& exports_;
  Job& job_;
  Stopwatch since_report_;
};

Exports::Exports(Report report) : report_(std::move(report)), thread_([this] { run(); }) {}

Exports::~Exports() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    for (const JobPtr& job : jobs_) {
      job->wanted = State::paused;
      job->stop->request();
    }
  }
  news_.notify_all();
  thread_.join();
}

DataMembers Exports::describe(const Job& job) {
  constexpr const char* names[] = {"waiting", "working", "paused", "done", "failed", "cancelled"};
  return {{"id", number(job.id)},
          {"state", names[static_cast<size_t>(job.state)]},
          {"folder", job.request.name},
          {"path", job.request.folder},
          {"file", job.request.file},
          {"options", job.request.choices.given},
          {"layers", number(job.layers)},
          {"done", number(job.how_far.done)},
          {"total", number(job.how_far.total)},
          {"seconds_left", job.how_far.seconds_left},
          {"message", job.message}};
}

DataMembers Exports::start(const ExportRequest& request) {
  DataMembers made;
  {
    const std::lock_guard lock(mutex_);
    for (const JobPtr& job : jobs_)
      if (job->request.folder == request.folder && (job->state == State::waiting || job->state == State::working))
        throw RequestError("busy", "a job is writing into " + request.name + " already");
    // The new job takes the place of those that wrote there before.
    std::erase_if(jobs_, [&](const JobPtr& job) { return job->request.folder == request.folder; });
    auto job = std::make_shared<Job>();
    job->id = ++count_;
    job->request = request;
    jobs_.push_back(job);
    made = describe(*job);
  }
  news_.notify_all();
  return made;
}

Exports::JobPtr Exports::find(int64_t id) {
  const auto found = std::ranges::find(jobs_, id, [](const JobPtr& job) { return job->id; });
  if (found == jobs_.end()) throw RequestError("gone", "there is no such job");
  return *found;
}

void Exports::stop(int64_t id, State state) {
  DataMembers now;
  {
    const std::lock_guard lock(mutex_);
    const JobPtr job = find(id);
    if (job->state == State::working) {
      job->wanted = state;
      job->stop->request();
      return;
    }
    if (job->state != State::waiting && job->state != State::paused)
      throw RequestError("state", "the job is at its end already");
    job->state = state;
    now = describe(*job);
  }
  report_(now);
}

void Exports::pause(int64_t id) { stop(id, State::paused); }
void Exports::cancel(int64_t id) { stop(id, State::cancelled); }

void Exports::resume(int64_t id) {
  DataMembers now;
  {
    const std::lock_guard lock(mutex_);
    const JobPtr job = find(id);
    if (job->state != State::paused && job->state != State::cancelled && job->state != State::failed)
      throw RequestError("state", "the job is not paused");
    job->state = State::waiting;
    job->message.clear();
    job->stop = std::make_shared<StopFlag>();
    now = describe(*job);
  }
  report_(now);
  news_.notify_all();
}

bool Exports::is_at_work() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(
      jobs_, [](const JobPtr& job) { return job->state == State::working || job->state == State::waiting; });
}

DataList Exports::list() const {
  const std::lock_guard lock(mutex_);
  DataList list;
  for (const JobPtr& job : jobs_) list.emplace_back(describe(*job));
  return list;
}

Exports::JobPtr Exports::next() {
  const auto found = std::ranges::find(jobs_, State::waiting, [](const JobPtr& job) { return job->state; });
  return found == jobs_.end() ? nullptr : *found;
}

void Exports::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    news_.wait(lock, [&] { return is_over_ || next(); });
    if (is_over_) return;
    const JobPtr job = next();
    job->state = State::working;
    const DataMembers now = describe(*job);
    lock.unlock();
    report_(now);
    work(*job);
    lock.lock();
  }
}

void Exports::end(Job& job, State state, const std::string& message) {
  DataMembers now;
  {
    const std::lock_guard lock(mutex_);
    job.state = state;
    job.message = message;
    now = describe(job);
  }
  report_(now);
}

void Exports::work(Job& job) {
  const ExportRequest& request = job.request;
  const std::shared_ptr<StopFlag> stop = job.stop;
  try {
    const CutDesignPtr cut = request.design->cut(request.choices);
    {
      const std::lock_guard lock(mutex_);
      job.layers = cut->plan.request.lattice.count[2];
    }
    compile::SliceOptions options;
    options.folder = request.folder;
    options.use = request.replace ? compile::FolderUse::replace : compile::FolderUse::resume;
    options.stages = cut->plan.stages;
    Watch watch(*this, job);
    const compile::SliceReport report =
        compile::slice(cut->plan.request, cut->plan.producer, options, &watch, stop.get());
    std::string message;
    for (const compile::CheckReport& check : report.checks) message += (message.empty() ? "" : "\n") + check.text;
    {
      const std::lock_guard lock(mutex_);
      job.how_far.done = job.how_far.total = std::max<uint64_t>(job.how_far.total, 1);
    }
    end(job, State::done, message);
  } catch (const Cancelled&) {
    job.request.replace = false;  // a resumed job goes on with its own layers
    end(job, job.wanted, "");
  } catch (const std::bad_alloc&) {
    end(job, State::failed, "not enough memory");
  } catch (const std::exception& error) {
    end(job, State::failed, error.what());
  }
}

}  // namespace ombre::studio
