// `ombre optimise` searches for the best values of a design's variables.
#include <algorithm>
#include <filesystem>

#include "base/system/not_copied.h"
#include "base/system/tasks.h"
#include "base/text/file_ending.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/common/study_source.h"
#include "jobs/optimise/optimise_choices.h"
#include "jobs/optimise/optimise_job.h"
#include "jobs/optimise/run_topology.h"
#include "jobs/optimise/search_history.h"
#include "jobs/optimise/search_report.h"
#include "jobs/optimise/stored_search.h"
#include "load/turned.h"
#include "stores/folder_store.h"
#include "stores/journal_folder.h"
#include "stores/shard_store.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;
using compile::History;
using compile::OptimiseChoices;
using compile::OptimiseStudy;
using optimise::Outcome;

constexpr const char* optimise_footer =
    "STUDY is a JSON file with variables, objectives and constraints.\n"
    "  {\"variables\": {\"width\": {\"from\": 2, \"to\": 10}, \"ribs\": {\"from\": 1, \"to\": 6, \"whole\": true}},\n"
    "   \"objectives\": [{\"minimise\": \"mass\"}],\n"
    "   \"constraints\": [{\"measure\": \"displacement\", \"axis\": \"z\", \"at_most\": 0.5}],\n"
    "   \"fea\": \"pull.json\", \"cell\": 1, \"method\": \"cobyla\", \"evaluations\": 100}\n"
    "Variables are those at the top of the script. Measures are volume, mass, share (of a \"material\"), "
    "displacement,\n"
    "stress, compliance, and echo, a number that the script prints: echo(cost = 3). \"fea\" is a study of ombre fea, "
    "or\n"
    "its file. Methods for one objective are cobyla (default), bobyqa, direct and cmaes, for several nsga2.\n\n"
    "FOLDER gets history.csv, a line for each design as soon as it is measured, the best designs as scripts, "
    "front.csv\n"
    "with all of them, and a chart.\n\n"
    "With \"topology\": {\"volume_fraction\": 0.4, \"radius\": 2} in place of variables, objectives and constraints, "
    "the\n"
    "search is for the densities of bricks that make the design stiffest: density.nrrd, for volume(), and a script.\n\n"
    "Examples:\n"
    "  ombre optimise hook.vcad --study lighter.json -o lighter\n"
    "  ombre optimise hook.vcad --study lighter.json -o lighter --resume\n";

// The files of the folder beside the journal.
struct Folder {
  fs::path path;

  std::string file(const std::string& name) const { return (path / name).string(); }
  bool has(const std::string& name) const { return fs::exists(path / name); }
  std::string history() const { return file("history.csv"); }
};

constexpr const char* earlier_key = "study.key";  // in place of search.json in folders of earlier versions

// Throws WrongArgument if the folder holds what the options do not allow.
void refuse_folder(const OptimiseChoices& a, const Folder& folder) {
  if (a.force) return;
  const Phrase begin_again = ", or " + spelled::option("--force") + " to begin again";
  const bool has_search = folder.has(compile::search_file);
  if (!has_search && folder.has(earlier_key))
    throw WrongArgument("the search in " + folder.path.string() +
                        " was made by an older version of Ombre and has no journal to go on with; choose another " +
                        spelled::option("-o") + begin_again);
  if (has_search && !a.resume)
    throw WrongArgument(folder.path.string() + " holds a search; write " + spelled::option("--resume") +
                        " to go on with it" + begin_again);
  if (!has_search && a.resume)
    throw WrongArgument("there is no " + folder.file(compile::search_file) + " to go on with; leave out " +
                        spelled::option("--resume"));
  if (!has_search && fs::exists(folder.history()))
    throw WrongArgument(folder.history() + " is there; choose another " + spelled::option("-o") + begin_again);
}

// Returns a function that loads the design with other options, and turns it.
compile::LoadWith loader(const OptimiseChoices& a, Session& session) {
  return [&a, &session](const compile::LoadOptions& with, Diagnostics& found) {
    const compile::LoadedPtr loaded = session.load(a.design.design, with, found);
    return loaded ? compile::turned(loaded, a.design.rotate.value_or(Vec3{}), found) : nullptr;
  };
}

compile::LoadOptions load_options(const OptimiseChoices& a, Session& session) {
  compile::LoadOptions options = a.design.load();
  options.cache = &session.cache;
  return options;
}

// A search that is ready to measure designs.
struct VariableSearch : NotCopied {
  const OptimiseChoices choices;
  const OptimiseStudy study;
  const stores::JobKey key;
  const compile::StoredSearch stored;
  const compile::DesignMeter meter;
  const Folder folder;

  VariableSearch(const OptimiseChoices& a, OptimiseStudy of, const Data& data, const compile::PlanOptions& plan,
                 Session& session)
      : choices(a),
        study(std::move(of)),
        key(compile::search_key(choices, data, study, plan.program)),
        stored(study, key),
        meter(study, loader(choices, session), load_options(choices, session), plan),
        folder{choices.folder} {}
};
using VariableSearchPtr = std::shared_ptr<const VariableSearch>;

using Values = std::vector<double>;

std::vector<Values> all_values(const OptimiseStudy& study, const std::vector<optimise::Point>& points) {
  std::vector<Values> all;
  for (const optimise::Point& point : points) all.push_back(compile::values_at(study, point));
  return all;
}

// Returns the designs that are not in the history, each once.
std::vector<Values> missing_in(const History& history, const std::vector<Values>& all) {
  std::vector<Values> missing;
  for (const Values& values : all)
    if (!history.find(values) && std::ranges::find(missing, values) == missing.end()) missing.push_back(values);
  return missing;
}

std::vector<Outcome> outcomes_in(const History& history, const OptimiseStudy& study, const std::vector<Values>& all) {
  std::vector<Outcome> outcomes;
  for (const Values& values : all) outcomes.push_back(outcome_of(study, history.find(values)->measured));
  return outcomes;
}

// Measures designs that are not in the history, several at once if memory allows.
class Evaluator {
 public:
  Evaluator(const VariableSearch& search, History& history, stores::Store& store, Session& session)
      : study_(search.study),
        meter_(search.meter),
        history_(history),
        store_(store),
        path_(search.folder.history()),
        table_(search.folder.history()),
        session_(session),
        progress_(session.events, Counted::steps),
        threads_(search.choices.work.threads > 0 ? search.choices.work.threads : core_count()),
        memory_(static_cast<double>(search.choices.work.memory_bytes)) {}

  std::vector<Outcome> measure(const std::vector<optimise::Point>& points) {
    if (session_.stop.requested()) throw Cancelled();
    const std::vector<Values> all = all_values(study_, points);
    measure_missing(missing_in(history_, all));
    requested_ += points.size();
    progress_.update({std::min(requested_, study_.search.evaluations), study_.search.evaluations});
    return outcomes_in(history_, study_, all);
  }
  void finish() {
    progress_.finish();
    store_.close();
    // A design that filled a gap of the history stands at the end of the table.
    const std::string table = history_.table();
    if (formats::read_file(path_) != table) exporting::write_file(path_, table);
  }
  size_t measured() const { return measured_; }

 private:
  void measure_missing(const std::vector<Values>& missing) {
    const auto count = static_cast<int>(missing.size());
    const int at_once = most_at_once(count);
    const int each = std::max(1, threads_ / std::max(1, at_once));
    run_ordered<compile::Measured>(
        missing.size(), at_once, static_cast<size_t>(at_once),
        [&](size_t n) { return meter_.measure(missing[n], each, &session_.stop); },
        [&](size_t n, compile::Measured& measured) { keep(missing[n], std::move(measured)); });
  }

  int most_at_once(int count) const {
    if (count < 2) return 1;
    const double fit = largest_ > 0 ? memory_ / largest_ : threads_;
    return std::clamp(static_cast<int>(std::min<double>(fit, threads_)), 1, count);
  }

  void keep(const std::vector<double>& values, compile::Measured measured) {
    largest_ = std::max(largest_, measured.solve_bytes);
    const History::Row& row = history_.add(values, std::move(measured));
    store_.put(History::piece(row));
    table_.append(history_.line(row));
    ++measured_;
  }

  const OptimiseStudy& study_;
  const compile::DesignMeter& meter_;
  History& history_;
  stores::Store& store_;
  std::string path_;
  exporting::AppendFile table_;
  Session& session_;
  JobProgress progress_;
  int threads_;
  double memory_, largest_ = 0;
  size_t requested_ = 0, measured_ = 0;
};

optimise::Problem problem_of(const OptimiseStudy& study, decltype(optimise::Problem::evaluate) evaluate) {
  optimise::Problem problem;
  for (const compile::DesignVariable& variable : study.variables)
    problem.start.push_back((variable.start - variable.low) / (variable.high - variable.low));
  problem.objectives = study.objectives.size();
  problem.constraints = study.limits.size();
  problem.evaluate = std::move(evaluate);
  return problem;
}

// Runs the search from the start design. If that has no measures, the study is wrong.
bool run_search(const OptimiseStudy& study, const History& history, Evaluator& evaluator, Session& session) {
  const optimise::Problem problem = problem_of(study, [&](const auto& points) { return evaluator.measure(points); });
  evaluator.measure({problem.start});
  const History::Row& first = *history.find(compile::values_at(study, problem.start));
  if (!first.measured.failure.empty()) {
    evaluator.finish();
    session.events.error(Code::study, "the first design, " + values_text(study, first) +
                                          ", cannot be measured: " + first.measured.failure);
    return false;
  }
  optimise::search(problem, study.search);
  evaluator.finish();
  return true;
}

// Measures what the history lacks, until the search is over, and reports it.
int finish_search(const VariableSearch& search, History& history, stores::Store& store, Session& session) {
  const Folder& folder = search.folder;
  exporting::write_file(folder.history(), history.table());
  Evaluator evaluator(search, history, store, session);
  const size_t known = history.size();
  try {
    if (!run_search(search.study, history, evaluator, session)) return wrong_input;
  } catch (const Cancelled&) {
    evaluator.finish();
    session.events.say(folder.history() + " has " + format_count(history.size()) +
                       " designs; the same command with --resume goes on");
    throw;
  }
  session.events.say(format_count(evaluator.measured()) + " designs measured, " + format_count(known) +
                     " were known; all are in " + folder.history());
  session.events.event("search", {{"measured", static_cast<double>(evaluator.measured())},
                                  {"known", static_cast<double>(known)},
                                  {"history", folder.history()}});
  return report_search(search.choices, search.study, history, session.events);
}

int optimise_variables(const VariableSearch& search, Session& session) {
  const OptimiseChoices& a = search.choices;
  refuse_folder(a, search.folder);
  stores::FolderStore store(a.folder, search.stored, a.resume ? stores::FolderUse::resume : stores::FolderUse::replace,
                            {a.work.threads, nullptr, &session.stop});
  fs::remove(search.folder.file(earlier_key));
  History history(search.study);
  history.read(store.finished());
  return finish_search(search, history, store, session);
}

// Returns null, and adds diagnostics, if the study or the script is wrong.
VariableSearchPtr plan_search(const OptimiseChoices& a, const std::optional<Data>& data, Session& session,
                              Diagnostics& diagnostics) {
  const std::string ending = ending_of(a.design.design);
  if (ending != ".vcad" && ending != ".scad")
    throw WrongArgument(a.design.design + " has no variables that could be set; take a .vcad or .scad script");
  auto study = data ? compile::read_optimise_study(*data, diagnostics) : std::nullopt;
  if (!study) return nullptr;
  const optimise::Method& method = *optimise::find_method(study->search.method);
  if (!optimise::is_built(method)) optimise::search({}, study->search);  // throws, and says what is missing
  compile::check_variables(*study, make_source(a.design.design, formats::read_file(a.design.design)), diagnostics);
  const auto plan = plan_options({}, session, diagnostics);
  if (!plan || diagnostics.has_errors()) return nullptr;
  return std::make_shared<VariableSearch>(a, std::move(*study), *data, *plan, session);
}

int run_optimise(const OptimiseChoices& a, Session& session) {
  Diagnostics diagnostics;
  const auto data = parse_json(study_source(a.study), diagnostics);
  if (data && data->find("topology")) return optimise_topology(a, *data, session);
  const VariableSearchPtr search = plan_search(a, data, session, diagnostics);
  session.events.diagnose(diagnostics);
  return search ? optimise_variables(*search, session) : wrong_input;
}

// Thrown where a search needs designs that nobody has measured yet.
struct DesignsWanted : std::exception {
  explicit DesignsWanted(std::vector<Values> wanted) : values(std::move(wanted)) {}
  const char* what() const noexcept override { return "designs are to be measured"; }
  std::vector<Values> values;
};

// Returns the designs that the search measures next, all at once; none if it is over.
std::vector<Values> next_designs(const OptimiseStudy& study, const History& history) {
  const optimise::Problem problem = problem_of(study, [&](const std::vector<optimise::Point>& points) {
    const std::vector<Values> all = all_values(study, points);
    if (std::vector<Values> missing = missing_in(history, all); !missing.empty()) throw DesignsWanted(missing);
    return outcomes_in(history, study, all);
  });
  try {
    const bool begins = !problem.evaluate({problem.start}).front().failed;
    if (begins) optimise::search(problem, study.search);
  } catch (const DesignsWanted& wanted) {
    return wanted.values;
  }
  return {};
}

// The designs that a search measures next, as pieces that several processes measure. What follows depends on them.
class SharedSearch final : public SharedJob {
 public:
  explicit SharedSearch(VariableSearchPtr search) : search_(std::move(search)), known_(search_->study) {
    const stores::JournalFolder folder(search_->choices.folder, search_->stored, stores::journal_file);
    if (fs::exists(folder.file(stores::journal_file))) {
      folder.check_description();
      known_.read(stores::parse_journal(search_->stored.words().id_name, folder.read(stores::journal_file),
                                        [&](const stores::Entry& entry) { return search_->stored.accepts(entry); }));
    }
    if (known_.size() > 0 && known_.rows().back()->number != static_cast<int64_t>(known_.size()))
      throw WrongArgument("designs are missing in the history of " + search_->choices.folder +
                          "; measure them first: ombre optimise with " + spelled::option("--resume"));
    next_ = next_designs(search_->study, known_);
    if (next_.empty())
      throw WrongArgument("the search in " + search_->choices.folder +
                          " is over: all designs that it asks for are measured");
  }

  std::string folder() const override { return search_->choices.folder; }
  const stores::StoredJob& stored() const override { return search_->stored; }
  stores::PieceRange pieces() const override {
    const auto first = static_cast<int64_t>(known_.size()) + 1;
    return {first, first + static_cast<int64_t>(next_.size())};
  }
  DataMembers description() const override { return {{"key", search_->key.data()}}; }
  std::string difference(const DataMembers& earlier) const override {
    return search_->key.difference(Data(earlier).find("key"));
  }
  // How long a design takes is not known before one was measured.
  PieceCosts costs(Session&) const override { return {std::vector<double>(next_.size()), 0}; }

  int make(stores::PieceRange range, const stores::Shard& shard, Session& session) const override {
    stores::ShardStore store(folder(), stored(), shard, {0, nullptr, &session.stop});
    for (int64_t number = range.begin; number < range.end; ++number) {
      if (store.finished().contains(number)) continue;
      const Values& values = next_[static_cast<size_t>(number - pieces().begin)];
      compile::Measured measured = search_->meter.measure(values, search_->choices.work.threads, &session.stop);
      store.put(History::piece({number, values, std::move(measured)}));
    }
    store.close();
    return done;
  }

  int join(Session& session) const override {
    stores::FolderStore store(folder(), stored(), stores::FolderUse::resume, {0, nullptr, &session.stop});
    History history(search_->study);
    history.read(store.finished());
    const std::vector<Values> following = next_designs(search_->study, history);
    if (following.empty()) return finish_search(*search_, history, store, session);
    store.close();
    exporting::write_file(search_->folder.history(), history.table());
    session.events.say(format_count(history.size()) + " designs are known; the search goes on with " +
                       format_count(following.size()) + ": make the next plan by ombre plan");
    session.events.event("designs", {{"known", number(history.size())}, {"next", number(following.size())}});
    return done;
  }

 private:
  VariableSearchPtr search_;
  History known_;
  std::vector<Values> next_;
};

SharedJobPtr share(const void* job, Session& session, Diagnostics& diagnostics) {
  const auto& choices = *static_cast<const OptimiseChoices*>(job);
  if (choices.force || choices.resume)
    throw WrongArgument("a search that is shared out has neither " + spelled::option("--force") + " nor " +
                        spelled::option("--resume"));
  const auto data = parse_json(study_source(choices.study), diagnostics);
  if (data && data->find("topology"))
    throw WrongArgument("the densities of a topology are found step by step, so they are not shared out");
  VariableSearchPtr search = plan_search(choices, data, session, diagnostics);
  return search ? std::make_unique<SharedSearch>(std::move(search)) : nullptr;
}

}  // namespace

JobKind optimise_kind() {
  JobKind kind = job_kind<OptimiseChoices>(
      "optimise", "Search for the values of a design's variables that serve it best", optimise_footer, run_optimise);
  kind.share = share;
  return kind;
}

}  // namespace ombre::jobs
