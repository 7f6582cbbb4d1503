#include "studio/exports.h"

#include <algorithm>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "jobs/all_jobs.h"
#include "jobs/common/data_events.h"
#include "jobs/common/memory_loader.h"
#include "jobs/common/run_reported.h"
#include "jobs/saved_job.h"
#include "jobs/slice/slice.h"
#include "load/load.h"
#include "options/members.h"

namespace ombre::studio {

struct Exports::Job {
  int64_t id = 0;
  ExportRequest request;
  State state = State::waiting;
  State wanted = State::done;  // state after a requested stop: paused or cancelled
  HowFar how_far;
  int64_t layers = 0;
  std::string message;
  DataList report;                  // events of the kind's job except progress and messages
  std::optional<DataMembers> kept;  // the description of a job of an earlier start, which has no request yet
  Stopwatch since_report = {};
  std::shared_ptr<StopFlag> stop = std::make_shared<StopFlag>();
};

// Receives the progress of a job, and reports it a few times per second.
class Exports::Watch : public Progress {
 public:
  Watch(Exports& exports, Job& job) : exports_(exports), job_(job) {}

  void update(const HowFar& how_far) override {
    {
      const std::lock_guard lock(exports_.mutex_);
      job_.how_far = how_far;
      if (since_report_.seconds() < 0.2) return;
      since_report_ = {};
    }
    exports_.tell(job_);
  }

 private:
  Exports& exports_;
  Job& job_;
  Stopwatch since_report_;
};

namespace {

constexpr const char* state_names[] = {"waiting", "working", "paused", "done", "failed", "cancelled", "interrupted"};

void put(DataMembers& members, const std::string& name, Data value) {
  const auto found = std::ranges::find(members, name, [](const auto& member) { return member.first; });
  if (found == members.end()) return void(members.emplace_back(name, std::move(value)));
  found->second = std::move(value);
}

std::string text_in(const DataMembers& members, std::string_view name) {
  const auto found = std::ranges::find(members, name, [](const auto& member) { return member.first; });
  return found != members.end() && found->second.string() ? *found->second.string() : "";
}

// Returns true if the kind can go on with what an interrupted job has done.
bool can_resume(const jobs::JobKind* kind) {
  if (!kind) return true;  // slices
  const auto& options = kind->options();
  return std::ranges::find(options, "--resume", &options::Option::name) != options.end();
}

DataMembers describe_origin(const ExportRequest& request) {
  if (!request.design) return {};
  const DesignOrigin& origin = request.design->origin;
  DataList definitions(origin.definitions.begin(), origin.definitions.end());
  DataList rotate(origin.rotate.begin(), origin.rotate.end());
  return {{"definitions", std::move(definitions)}, {"rotate", std::move(rotate)}};
}

// Returns the job as --save-job writes it, so that `ombre job` can run it.
jobs::SavedJob saved_job(const ExportRequest& request) {
  jobs::SavedJob saved{request.kind ? request.kind : jobs::find_job("slice"), request.members};
  if (!request.design) return saved;
  const DesignOrigin& origin = request.design->origin;
  if (!request.kind) {
    saved.options = request.choices.given;
    put(saved.options, "design", request.design->loaded->path);
    put(saved.options, "output", request.folder);
  }
  if (!origin.definitions.empty())
    put(saved.options, "define", DataList(origin.definitions.begin(), origin.definitions.end()));
  if (origin.rotate != std::array<double, 3>{})
    put(saved.options, "rotate", DataList(origin.rotate.begin(), origin.rotate.end()));
  return saved;
}

}  // namespace

Exports::Exports(Report report, Keep keep, sources::SourceCache& cache, std::string program)
    : report_(std::move(report)), keep_(std::move(keep)), cache_(cache), program_(std::move(program)), thread_([this] {
        run();
      }) {}

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
  const char* const state = state_names[static_cast<size_t>(job.state)];
  if (job.kept) {
    DataMembers members = *job.kept;
    put(members, "id", number(job.id));
    put(members, "state", state);
    put(members, "message", job.message);
    return members;
  }
  DataMembers members{{"id", number(job.id)},
                      {"state", state},
                      {"folder", job.request.name},
                      {"path", job.request.folder},
                      {"file", job.request.file},
                      {"kind", job.request.kind ? job.request.kind->name : "slice"},
                      {"options", job.request.kind ? job.request.shown : job.request.choices.given},
                      {"resumes", can_resume(job.request.kind)},
                      {"is_download", job.request.holder != nullptr},
                      {"report", job.report},
                      {"layers", number(job.layers)},
                      {"done", number(job.how_far.done)},
                      {"total", number(job.how_far.total)},
                      {"seconds_left", job.how_far.seconds_left},
                      {"message", job.message}};
  for (auto& member : describe_origin(job.request)) members.push_back(std::move(member));
  return members;
}

// Returns a job's description without its report, and the job as `ombre job` runs it.
DataMembers Exports::to_keep(const Job& job) const {
  DataMembers members = describe(job);
  if (job.kept) return members;
  put(members, "report", DataList{});
  put(members, "replace", job.request.replace);
  Diagnostics ignored;
  if (auto spec = parse_json(make_source("job", jobs::saved_text(saved_job(job.request), program_)), ignored))
    put(members, "spec", std::move(*spec));
  return members;
}

// The job is described and reported under one lock, so that older news never comes after newer.
void Exports::tell(const Job& job) {
  const std::lock_guard order(report_mutex_);
  DataMembers now;
  {
    const std::lock_guard lock(mutex_);
    now = describe(job);
  }
  report_(now);
}

// The list is made and written under one lock, so that a newer list is never replaced by an older one.
void Exports::keep_list() {
  if (!keep_) return;
  const std::lock_guard order(keep_mutex_);
  DataList list;
  {
    const std::lock_guard lock(mutex_);
    for (const JobPtr& job : jobs_)
      if (!job->request.holder) list.emplace_back(to_keep(*job));
  }
  keep_(list);
}

void Exports::adopt(const DataList& kept) {
  constexpr size_t most = 100;
  const std::lock_guard lock(mutex_);
  for (const Data& data : kept) {
    if (!data.members() || text_in(*data.members(), "folder").empty() || jobs_.size() >= most) continue;
    auto job = std::make_shared<Job>();
    job->id = ++count_;
    job->kept = *data.members();
    job->message = text_in(*job->kept, "message");
    const std::string state = text_in(*job->kept, "state");
    const auto name = std::ranges::find(state_names, state);
    const auto known = name == std::end(state_names) ? State::interrupted : static_cast<State>(name - state_names);
    const bool is_over = known == State::done || known == State::failed || known == State::cancelled;
    job->state = is_over ? known : State::interrupted;
    job->request.name = text_in(*job->kept, "folder");
    job->request.folder = text_in(*job->kept, "path");
    jobs_.push_back(std::move(job));
  }
}

std::optional<Data> Exports::adopted(int64_t id) const {
  const std::lock_guard lock(mutex_);
  const JobPtr job = find(id);
  return job->kept ? std::optional<Data>(*job->kept) : std::nullopt;
}

void Exports::revive(int64_t id, const ExportRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    const JobPtr job = find(id);
    if (job->state == State::waiting || job->state == State::working || job->state == State::done)
      throw RequestError("state", "the job is not interrupted");
    job->kept.reset();
    job->request = request;
    if (job->state != State::paused) job->state = State::paused;
  }
  resume(id);
}

Download Exports::output(int64_t id) const {
  const std::lock_guard lock(mutex_);
  const JobPtr job = find(id);
  if (job->state != State::done || job->request.folder.empty())
    throw RequestError("state", "the job has not written what it makes");
  return {job->request.folder, job->request.holder};
}

DataMembers Exports::start(const ExportRequest& request) {
  DataMembers made;
  {
    const std::lock_guard lock(mutex_);
    for (const JobPtr& job : jobs_)
      if (job->request.folder == request.folder && (job->state == State::waiting || job->state == State::working))
        throw RequestError("busy", "a job is writing into " + request.name + " already");
    // The new job replaces earlier jobs with the same folder.
    std::erase_if(jobs_, [&](const JobPtr& job) { return job->request.folder == request.folder; });
    auto job = std::make_shared<Job>();
    job->id = ++count_;
    job->request = request;
    jobs_.push_back(job);
    made = describe(*job);
  }
  keep_list();
  news_.notify_all();
  return made;
}

// Changes the request to one that continues earlier work, if its kind supports that.
void Exports::go_on(ExportRequest& request) {
  if (!request.kind || !can_resume(request.kind)) return;
  std::erase_if(request.members,
                [](const auto& member) { return member.first == "force" || member.first == "resume"; });
  request.members.emplace_back("resume", true);
}

Exports::JobPtr Exports::find(int64_t id) const {
  const auto found = std::ranges::find(jobs_, id, [](const JobPtr& job) { return job->id; });
  if (found == jobs_.end()) throw RequestError("gone", "there is no such job");
  return *found;
}

void Exports::stop(int64_t id, State state) {
  JobPtr job;
  {
    const std::lock_guard lock(mutex_);
    job = find(id);
    if (job->state == State::working) {
      job->wanted = state;
      job->stop->request();
      return;
    }
    if (job->state != State::waiting && job->state != State::paused && job->state != State::interrupted)
      throw RequestError("state", "the job is at its end already");
    job->state = state;
  }
  tell(*job);
  keep_list();
}

void Exports::pause(int64_t id) { stop(id, State::paused); }
void Exports::cancel(int64_t id) { stop(id, State::cancelled); }

void Exports::resume(int64_t id) {
  JobPtr job;
  {
    const std::lock_guard lock(mutex_);
    job = find(id);
    if (job->state != State::paused && job->state != State::cancelled && job->state != State::failed)
      throw RequestError("state", "the job is not paused");
    go_on(job->request);
    job->state = State::waiting;
    job->message.clear();
    job->report.clear();
    job->stop = std::make_shared<StopFlag>();
  }
  tell(*job);
  keep_list();
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
    lock.unlock();
    tell(*job);
    keep_list();
    work(*job);
    lock.lock();
  }
}

void Exports::end(Job& job, State state, const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    job.state = state;
    job.message = message;
  }
  tell(job);
  keep_list();
}

void Exports::work(Job& job) {
  const std::shared_ptr<StopFlag> stop = job.stop;
  try {
    job.request.kind ? run_kind(job, *stop) : slice(job, *stop);
  } catch (const Cancelled&) {
    job.request.replace = false;  // a resumed job continues with its own layers
    end(job, job.wanted, "");
  } catch (const options::WrongValue& error) {
    end(job, State::failed, wrong_value(error).what());
  } catch (const std::bad_alloc&) {
    end(job, State::failed, "not enough memory");
  } catch (const std::exception& error) {
    end(job, State::failed, error.what());
  }
}

void Exports::slice(Job& job, const StopFlag& stop) {
  const ExportRequest& request = job.request;
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
  const compile::SliceReport report = compile::slice(cut->plan.request, cut->plan.producer, options, &watch, &stop);
  std::string message;
  for (const compile::CheckReport& check : report.checks) message += (message.empty() ? "" : "\n") + check.text;
  {
    const std::lock_guard lock(mutex_);
    job.how_far.done = job.how_far.total = std::max<uint64_t>(job.how_far.total, 1);
  }
  end(job, State::done, message);
}

// Runs a job of a kind. A search of variables loads the design again from its file; other jobs take the open design.
void Exports::run_kind(Job& job, const StopFlag& stop) {
  const ExportRequest& request = job.request;
  const jobs::JobKind& kind = *request.kind;
  const std::shared_ptr<void> made = kind.make();
  options::read_members(kind.options(), made.get(), request.members);
  std::string printed;
  const jobs::DataEvents events(
      FrontEnd::studio, [&](const DataMembers& event) { take(job, event); },
      [&](const std::string& text) { printed += text; });
  jobs::Session session{events, stop, compile::load_design, cache_, program_};
  if (request.design) session.load = jobs::memory_loader(request.design->loaded, true);
  const int code = jobs::run_reported(events, [&] { return kind.run(made.get(), session); });
  if (code == jobs::interrupted) throw Cancelled();
  const bool is_done = code == jobs::done;
  {
    const std::lock_guard lock(mutex_);
    if (!printed.empty()) job.report.emplace_back(DataMembers{{"event", "text"}, {"text", printed}});
    if (is_done) job.how_far.done = job.how_far.total = std::max<uint64_t>(job.how_far.total, 1);
  }
  end(job, is_done ? State::done : State::failed, job.message);
}

void Exports::take(Job& job, const DataMembers& event) {
  constexpr size_t most_events = 200;
  constexpr double interval_s = 0.2;
  const auto member = [&](std::string_view name) -> const Data* {
    const auto found = std::ranges::find(event, name, [](const auto& m) { return m.first; });
    return found == event.end() ? nullptr : &found->second;
  };
  const auto amount = [&](std::string_view voxels, std::string_view steps) {
    const Data* data = member(voxels) ? member(voxels) : member(steps);
    return data && data->number() ? static_cast<uint64_t>(std::max(0.0, *data->number())) : 0;
  };
  const std::string& name = *member("event")->string();
  {
    const std::lock_guard lock(mutex_);
    if (name == "progress") {
      job.how_far.done = amount("voxels_done", "steps_done");
      job.how_far.total = amount("voxels_total", "steps_total");
      const Data* left = member("seconds_left");
      job.how_far.seconds_left = left && left->number() ? *left->number() : -1;
    } else if (name == "message") {
      job.message += (job.message.empty() ? "" : "\n") + *member("message")->string();
      if (const Data* hint = member("hint"); hint && hint->string() && !hint->string()->empty())
        job.message += "; " + *hint->string();
    } else if (name != "checking" && name != "preparing" && job.report.size() < most_events) {
      job.report.emplace_back(event);
    }
    if (job.since_report.seconds() < interval_s) return;
    job.since_report = {};
  }
  tell(job);
}

}  // namespace ombre::studio
