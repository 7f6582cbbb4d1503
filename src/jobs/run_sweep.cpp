// `ombre sweep` runs a job with several values of its options and of its design's variables.
#include <algorithm>
#include <filesystem>
#include <set>

#include "base/system/not_copied.h"
#include "base/system/temporary_folder.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "jobs/common/data_events.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_options.h"
#include "jobs/stored_sweep.h"
#include "load/files_read.h"
#include "options/members.h"
#include "stores/folder_store.h"
#include "stores/shard_store.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;

constexpr const char* sweep_footer =
    "JOB is a file that --save-job wrote. It runs once for each choice of values: a case. FOLDER gets sweep.csv, a "
    "line\n"
    "for each case with the numbers that the job reports, and the files that the job writes, such as "
    "case_07_part.vtu.\n"
    "Values are separated by commas; write a value with commas in brackets, such as [0.1,0.1,0.05]. A case that fails\n"
    "has its message in the table. Processes may share the cases: see ombre plan -h.\n\n"
    "Examples:\n"
    "  ombre homogenise cell.vcad --cell 0.25 --save-job job.json\n"
    "  ombre sweep job.json -D wall=0.2,0.4,0.8 -o walls              stiffness by the thickness of walls\n"
    "  ombre sweep job.json -D wall=0.2,0.4 --vary cell=0.5,0.25,0.125 -o walls\n"
    "  ombre fea part.vcad --study pull.json --cell 1 --solve -o part.vtu --save-job job.json\n"
    "  ombre sweep job.json --vary study=pull.json,twist.json -o loads    load cases\n";

struct SweepChoices {
  std::string job, folder;
  std::vector<std::string> varied, definitions;
  bool force = false, resume = false;

  static const options::Spec<SweepChoices>& options() {
    using namespace options;
    using S = SweepChoices;
    static const options::Spec<S> spec{
        option("job", &S::job, kind::file, "The job: a file that --save-job wrote", "JOB").required(),
        options::list("-D,--define", &S::definitions, kind::text, "Values of a variable of the design; may be repeated",
                      "NAME=V1,V2"),
        options::list("--vary", &S::varied, kind::text,
                      "Values of an option of the job, without dashes; may be repeated", "NAME=V1,V2"),
        option("-o,--output", &S::folder, kind::file, "The folder for the results", "FOLDER").required(),
        flag("--resume", &S::resume, "Go on with the sweep in the folder"),
        flag("--force", &S::force, "Replace the sweep in the folder").excludes({"--resume"})};
    return spec;
  }

  stores::FolderUse use() const {
    if (force) return stores::FolderUse::replace;
    return resume ? stores::FolderUse::resume : stores::FolderUse::fresh;
  }
};

// Collects what the job of a case says: its numbers, and its first error.
class Said {
 public:
  void take(const DataMembers& event) {
    const Data data(event);
    const std::string& name = *data.find("event")->string();
    if (name == "message") return take_message(data);
    static const std::set<std::string> not_results{"progress", "checking", "preparing", "plan", "done"};
    if (not_results.contains(name)) return;
    for (const auto& [member, value] : event)
      if (is_kept(member)) add(joined(name, member), value);
  }

  const DataMembers& results() const { return results_; }
  const std::string& failure() const { return failure_; }
  int64_t warnings() const { return warnings_; }

 private:
  static std::string joined(std::string name, const std::string& member) {
    name += '.';
    return name += member;
  }

  // Times and memory depend on the machine.
  static bool is_kept(const std::string& member) {
    return member.find("seconds") == std::string::npos && member.find("memory") == std::string::npos;
  }

  void take_message(const Data& message) {
    if (*message.find("severity") == Data("warning")) ++warnings_;
    if (failure_.empty() && *message.find("severity") == Data("error")) failure_ = *message.find("message")->string();
  }

  // Adds a number, or those of a list by their places, which begin with 1.
  void add(const std::string& name, const Data& value) {
    if (value.number()) results_.emplace_back(name, value);
    if (value.members())
      for (const auto& [member, inner] : *value.members()) add(joined(name, member), inner);
    if (!value.list()) return;
    for (size_t n = 0; n < value.list()->size(); ++n) add(name + "." + std::to_string(n + 1), (*value.list())[n]);
  }

  DataMembers results_;
  std::string failure_;
  int64_t warnings_ = 0;
};

// Errors that are of the case, and come again when it is run again.
bool is_of_case(Code code) {
  static const std::set<Code> codes{Code::not_solved, Code::not_meshed, Code::nothing_inside, Code::too_large};
  return codes.contains(code);
}

class Sweep : NotCopied {
 public:
  Sweep(const SweepChoices& choices, SweepCases cases, stores::JobKey key)
      : folder_(choices.folder), cases_(std::move(cases)), key_(std::move(key)), stored_(cases_, key_) {}

  const std::string& folder() const { return folder_; }
  const SweepCases& cases() const { return cases_; }
  const stores::JobKey& key() const { return key_; }
  const StoredSweep& stored() const { return stored_; }

  // Runs the cases of a range that the store lacks.
  void run(stores::PieceRange range, stores::Store& store, Session& session) const {
    JobProgress progress(session.events, Counted::steps);
    const auto count = static_cast<uint64_t>(range.end - range.begin);
    int64_t failures = 0, warnings = 0;
    for (int64_t number = range.begin; number < range.end; ++number) {
      if (session.stop.requested()) throw Cancelled();
      progress.update({static_cast<uint64_t>(number - range.begin), count});
      if (store.finished().contains(number)) continue;
      Said said;
      store.put(piece(number, said, session));
      warnings += said.warnings();
      if (said.failure().empty()) continue;
      if (failures++ == 0)
        session.events.warn("case " + std::to_string(number) + " (" + cases_.name_of(number) +
                            ") fails: " + said.failure());
    }
    progress.finish();
    if (failures > 1) session.events.warn(format_count(failures) + " cases fail; the table has their messages");
    if (warnings > 0)
      session.events.warn("the cases gave " + format_count(warnings) + " warnings; ombre job shows those of one job");
  }

  int finish(stores::Store& store, size_t kept, Session& session) const {
    store.close();
    const std::string table = (fs::path(folder_) / "sweep.csv").string();
    exporting::write_file(table, stored_.table(store.finished()));
    session.events.say(format_count(store.finished().size() - kept) + " cases were run" +
                       (kept > 0 ? ", " + format_count(kept) + " before" : "") + "; all are in " + table);
    session.events.event("sweep", {{"file", table}, {"cases", number(store.finished().size())}});
    return done;
  }

 private:
  stores::Piece piece(int64_t number, Said& said, Session& session) const {
    const TemporaryFolder files;
    const std::string failure = run_case(number, files, said, session);
    stores::Piece piece{number, {}, {{"values", values_of(number)}}};
    if (!failure.empty())
      piece.record.emplace_back("failure", failure);
    else
      piece.record.emplace_back("results", said.results());
    if (failure.empty()) add_files(files, piece);
    return piece;
  }

  DataList values_of(int64_t number) const {
    const std::vector<std::string> values = cases_.values(number);
    return {values.begin(), values.end()};
  }

  // Returns why the case fails; "" if it does not.
  std::string run_case(int64_t number, const TemporaryFolder& files, Said& said, Session& session) const {
    SavedJob job = cases_.job_of(number);
    for (auto& [name, value] : job.options)
      if (name == "output") value = outputs_in(files, number, value);
    const DataEvents events(
        FrontEnd::command_line, [&](const DataMembers& event) { said.take(event); }, [](const std::string&) {});
    Session own{events, session.stop, session.load, session.cache, session.program, session.quit_at_once};
    try {
      if (run_saved_job(job, own) == done) return "";
    } catch (const WrongArgument& wrong) {
      return wrong.message().text();
    } catch (const Error& error) {
      if (is_of_case(error.code())) return error.message().text();
      throw;
    }
    return said.failure().empty() ? "the job failed" : said.failure();
  }

  // Returns the option --output of a case, whose files go into a folder of their own.
  Data outputs_in(const TemporaryFolder& files, int64_t number, const Data& output) const {
    if (output.string())
      return files.file(stored_.file_prefix(number) + fs::path(*output.string()).filename().string());
    DataList all;
    for (const Data& one : *output.list()) all.push_back(outputs_in(files, number, one));
    return all;
  }

  static void add_files(const TemporaryFolder& files, stores::Piece& piece) {
    for (const auto& entry : fs::directory_iterator(files.path())) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file())
        throw WrongArgument("the job writes a folder, " + name + ", which a sweep does not keep; let it write a file");
      piece.files.emplace_back(name, formats::read_file(entry.path().string()));
    }
    std::ranges::sort(piece.files);
  }

  std::string folder_;
  SweepCases cases_;
  stores::JobKey key_;
  StoredSweep stored_;
};
using SweepPtr = std::shared_ptr<Sweep>;

// Returns the options of the job that choose its design.
compile::DesignOptions design_of(const SavedJob& job) {
  compile::DesignOptions design;
  for (const options::Option& option : compile::DesignOptions::options().options())
    for (const auto& [name, value] : job.options)
      if (name == options::member_name(option.name())) options::set_member(option, &design, value);
  return design;
}

// Adds the paths of the files that a case reads, as far as that can be seen.
void add_files_of(const SavedJob& job, std::set<std::string>& files) {
  const auto add = [&](const std::string& path) {
    if (fs::is_regular_file(path)) files.insert(path);
  };
  for (const options::Option& option : job.kind->options())
    for (const auto& [name, value] : job.options)
      if (name == options::member_name(option.name()) && name != "output" && option.kind == "file" && value.string())
        add(*value.string());
  const compile::DesignOptions design = design_of(job);
  if (design.design.empty()) return;
  Diagnostics ignored;  // the case itself reports them
  const fs::path here = fs::current_path();
  if (const auto read = compile::files_read(design.design, design.load(), ignored))
    for (const fs::path& file : *read) add(fs::proximate(file, here).generic_string());
}

// Returns everything that the cases depend on but what the machine decides.
stores::JobKey key_of(const SweepCases& cases, const Session& session) {
  static const std::set<std::string> without{"threads", "memory", "force"};
  stores::JobKey key;
  const SavedJob& job = cases.job();
  key.add("the kind of job", job.kind->name);
  for (const auto& [name, value] : job.options)
    if (!without.contains(name)) key.add(name, print_json_line(value));
  for (const Varied& varied : cases.varied())
    key.add((varied.is_variable ? "values of the variable " : "values of ") + varied.name, join(varied.values, "\n"));
  std::set<std::string> files;
  for (int64_t number = 0; number < cases.count(); ++number) add_files_of(cases.job_of(number), files);
  for (const std::string& file : files) key.add(file, formats::read_file(file));
  key.add("the version of Ombre", session.program);
  return key;
}

// Returns null, and adds diagnostics, if the job is wrong.
SweepPtr plan_sweep(const SweepChoices& a, const Session& session, Diagnostics& diagnostics) {
  auto job = read_saved_job(make_source(a.job, formats::read_file(a.job)), diagnostics);
  if (!job) return nullptr;
  std::vector<Varied> varied;
  for (const std::string& text : a.definitions) varied.push_back(parse_varied(text, true));
  for (const std::string& text : a.varied) varied.push_back(parse_varied(text, false));
  if (varied.empty())
    throw WrongArgument("a sweep needs values: write " + spelled::option("-D", "wall=0.2,0.4") + " or " +
                        spelled::option("--vary", "cell=1,2"));
  const auto has_output = [](const auto& member) { return member.first == "output"; };
  if (!job->kind->endings.empty() && std::ranges::none_of(job->options, has_output))
    throw WrongArgument("the job does not say which file it writes; save it again with " + spelled::option("-o"));
  SweepCases cases(std::move(*job), std::move(varied));
  stores::JobKey key = key_of(cases, session);
  return std::make_shared<Sweep>(a, std::move(cases), std::move(key));
}

int run_sweep(const SweepChoices& a, Session& session) {
  stores::refuse_used_folder(a.folder, a.use(), sweep_words());
  Diagnostics diagnostics;
  const SweepPtr sweep = plan_sweep(a, session, diagnostics);
  session.events.diagnose(diagnostics);
  if (!sweep) return wrong_input;
  stores::FolderStore store(a.folder, sweep->stored(), a.use(), {0, nullptr, &session.stop});
  const size_t kept = store.finished().size();
  session.events.say(format_count(sweep->cases().count()) + " cases");
  sweep->run({0, sweep->cases().count()}, store, session);
  return sweep->finish(store, kept, session);
}

// A sweep whose cases several processes run.
class SharedSweep final : public SharedJob {
 public:
  explicit SharedSweep(SweepPtr sweep) : sweep_(std::move(sweep)) {}

  std::string folder() const override { return sweep_->folder(); }
  const stores::StoredJob& stored() const override { return sweep_->stored(); }
  stores::PieceRange pieces() const override { return {0, sweep_->cases().count()}; }
  DataMembers description() const override { return {{"key", sweep_->key().data()}}; }
  std::string difference(const DataMembers& earlier) const override {
    return sweep_->key().difference(Data(earlier).find("key"));
  }
  // How long a case takes is not known before one was run.
  PieceCosts costs(Session&) const override {
    return {std::vector<double>(static_cast<size_t>(sweep_->cases().count())), 0};
  }

  int make(stores::PieceRange range, const stores::Shard& shard, Session& session) const override {
    stores::ShardStore store(folder(), stored(), shard, {0, nullptr, &session.stop});
    sweep_->run(range, store, session);
    store.close();
    return done;
  }

  int join(Session& session) const override {
    stores::FolderStore store(folder(), stored(), stores::FolderUse::resume, {0, nullptr, &session.stop});
    const size_t kept = store.finished().size();
    sweep_->run(pieces(), store, session);
    return sweep_->finish(store, kept, session);
  }

 private:
  SweepPtr sweep_;
};

SharedJobPtr share_sweep(const void* job, Session& session, Diagnostics& diagnostics) {
  const auto& choices = *static_cast<const SweepChoices*>(job);
  if (choices.force || choices.resume)
    throw WrongArgument("a sweep that is shared out has neither " + spelled::option("--force") + " nor " +
                        spelled::option("--resume"));
  SweepPtr sweep = plan_sweep(choices, session, diagnostics);
  return sweep ? std::make_unique<SharedSweep>(std::move(sweep)) : nullptr;
}

}  // namespace

JobKind sweep_kind() {
  JobKind kind = job_kind<SweepChoices>("sweep", "Run a job with several values of options and variables", sweep_footer,
                                        run_sweep);
  kind.share = share_sweep;
  return kind;
}

}  // namespace ombre::jobs
