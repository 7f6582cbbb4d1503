// `ombre optimise` searches for the best values of a design's variables.
#include <algorithm>
#include <filesystem>

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
#include "jobs/optimise/stored_search.h"
#include "load/turned.h"
#include "optimise/chart.h"
#include "optimise/ranking.h"
#include "stores/folder_store.h"

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

// Measures designs that are not in the history, several at once if memory allows.
class Evaluator {
 public:
  Evaluator(const OptimiseChoices& a, const OptimiseStudy& study, const compile::DesignMeter& meter, History& history,
            const Folder& folder, stores::Store& store, Session& session)
      : study_(study),
        meter_(meter),
        history_(history),
        store_(store),
        path_(folder.history()),
        table_(folder.history()),
        session_(session),
        progress_(session.events, Counted::steps),
        threads_(a.work.threads > 0 ? a.work.threads : core_count()),
        memory_(static_cast<double>(a.work.memory_bytes)) {}

  std::vector<Outcome> measure(const std::vector<optimise::Point>& points) {
    if (session_.stop.requested()) throw Cancelled();
    std::vector<std::vector<double>> all, missing;
    for (const optimise::Point& point : points) all.push_back(compile::values_at(study_, point));
    for (const auto& values : all)
      if (!history_.find(values) && std::ranges::find(missing, values) == missing.end()) missing.push_back(values);
    measure_missing(missing);
    requested_ += points.size();
    progress_.update({std::min(requested_, study_.search.evaluations), study_.search.evaluations});
    std::vector<Outcome> outcomes;
    for (const auto& values : all) outcomes.push_back(outcome_of(study_, history_.find(values)->measured));
    return outcomes;
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
  void measure_missing(const std::vector<std::vector<double>>& missing) {
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

std::string values_text(const OptimiseStudy& study, const History::Row& row) {
  std::vector<std::string> parts;
  for (size_t n = 0; n < row.values.size(); ++n)
    parts.push_back(study.variables[n].name + " = " + format_rounded(row.values[n], 6));
  return join(parts, ", ");
}

std::string measures_text(const OptimiseStudy& study, const History::Row& row) {
  std::vector<std::string> parts;
  const auto measures = study.measures();
  for (size_t n = 0; n < measures.size(); ++n)
    parts.push_back(measures[n].label() + " " + format_rounded(row.measured.values[n], 6));
  return join(parts, ", ");
}

// Returns the option that turns the script as the measured designs were turned.
std::string turn_text(const OptimiseChoices& a) {
  if (!a.design.rotate) return "";
  const Vec3 turn = *a.design.rotate;
  return "; with " +
         spelled::option("--rotate", format_number(turn.x) + "," + format_number(turn.y) + "," + format_number(turn.z))
             .text();
}

// Returns a script that is the design with other values: the last value of a variable counts.
std::string script_of(const OptimiseChoices& a, const OptimiseStudy& study, const Folder& folder,
                      const History::Row& row) {
  const fs::path design = fs::proximate(fs::absolute(a.design.design), fs::absolute(folder.path));
  std::string text = "// " + measures_text(study, row) + turn_text(a) + "\ninclude <" + design.generic_string() + ">\n";
  for (size_t n = 0; n < row.values.size(); ++n)
    text += study.variables[n].name + " = " + format_number(row.values[n]) + ";\n";
  return text;
}

// Returns some of them, evenly from the first to the last.
std::vector<size_t> some_of(const std::vector<size_t>& front, size_t most) {
  if (front.size() <= most) return front;
  std::vector<size_t> some;
  for (size_t n = 0; n < most; ++n) some.push_back(front[most == 1 ? 0 : n * (front.size() - 1) / (most - 1)]);
  return some;
}

std::string chart_of(const OptimiseStudy& study, const std::vector<const History::Row*>& rows,
                     const std::vector<Outcome>& outcomes, const std::vector<size_t>& front) {
  using Kind = optimise::ChartPoint::Kind;
  const auto measures = study.measures();
  const bool has_two = study.objectives.size() > 1;
  optimise::Chart chart;
  chart.title = has_two ? "Designs, the best in red" : "Designs in the order of the search, the best in red";
  chart.x_label = has_two ? measures[0].label() : "design";
  chart.y_label = measures[has_two ? 1 : 0].label();
  chart.joins_best = has_two;
  const auto add = [&](size_t n, Kind kind) {
    const auto& values = rows[n]->measured.values;
    if (has_two)
      chart.points.push_back({values[0], values[1], kind});
    else
      chart.points.push_back({static_cast<double>(n + 1), values[0], kind});
  };
  for (size_t n = 0; n < outcomes.size(); ++n)
    if (!outcomes[n].failed && std::ranges::find(front, n) == front.end())
      add(n, optimise::is_feasible(outcomes[n]) ? Kind::feasible : Kind::other);
  for (const size_t n : front) add(n, Kind::best);
  return optimise::chart_svg(chart);
}

class Report {
 public:
  Report(const OptimiseChoices& a, const OptimiseStudy& study, const History& history, const Folder& folder,
         const Events& events)
      : a_(a), study_(study), history_(history), rows_(history.rows()), folder_(folder), events_(events) {
    for (const History::Row* row : rows_) outcomes_.push_back(outcome_of(study, row->measured));
    front_ = optimise::front_of(outcomes_);
  }

  int write() {
    write_file("chart.svg", chart_of(study_, rows_, outcomes_, front_));
    if (front_.empty()) return tell_nothing_holds();
    std::string table = history_.header();
    for (const size_t row : front_) table += history_.line(*rows_[row]);
    write_file("front.csv", table);
    size_t number = 0;
    const std::string ending = fs::path(a_.design.design).extension().string();
    for (const size_t row : some_of(front_, static_cast<size_t>(a_.best))) {
      const std::string name = "best_" + std::to_string(++number) + ending;
      write_file(name, script_of(a_, study_, folder_, *rows_[row]));
      tell(row, name);
    }
    events_.event("done", {{"files", files_}});
    return done;
  }

 private:
  void write_file(const std::string& name, const std::string& text) {
    exporting::write_file(folder_.file(name), text);
    files_.emplace_back(folder_.file(name));
  }

  void tell(size_t row, const std::string& name) const {
    const History::Row& best = *rows_[row];
    events_.say(name + ": " + values_text(study_, best) + "; " + measures_text(study_, best));
    DataMembers values, measures;
    for (size_t n = 0; n < best.values.size(); ++n) values.emplace_back(study_.variables[n].name, best.values[n]);
    const auto all = study_.measures();
    for (size_t n = 0; n < all.size(); ++n) measures.emplace_back(all[n].label(), best.measured.values[n]);
    events_.event("best", {{"file", folder_.file(name)}, {"variables", values}, {"measures", measures}});
  }

  int tell_nothing_holds() const {
    size_t nearest = outcomes_.size();
    for (size_t n = 0; n < outcomes_.size(); ++n)
      if (!outcomes_[n].failed &&
          (nearest == outcomes_.size() || outcomes_[n].violation() < outcomes_[nearest].violation()))
        nearest = n;
    const History::Row& row = *rows_[nearest];
    events_.error(Code::nothing_inside, "no design keeps all limits; the nearest is " + values_text(study_, row) +
                                            ": " + measures_text(study_, row));
    return check_failed;
  }

  const OptimiseChoices& a_;
  const OptimiseStudy& study_;
  const History& history_;
  std::vector<const History::Row*> rows_;
  const Folder& folder_;
  const Events& events_;
  std::vector<Outcome> outcomes_;
  std::vector<size_t> front_;
  DataList files_;
};

optimise::Problem problem_of(const OptimiseStudy& study, Evaluator& evaluator) {
  optimise::Problem problem;
  for (const compile::DesignVariable& variable : study.variables)
    problem.start.push_back((variable.start - variable.low) / (variable.high - variable.low));
  problem.objectives = study.objectives.size();
  problem.constraints = study.limits.size();
  problem.evaluate = [&](const std::vector<optimise::Point>& points) { return evaluator.measure(points); };
  return problem;
}

// Runs the search from the start design. If that has no measures, the study is wrong.
bool run_search(const OptimiseStudy& study, const History& history, Evaluator& evaluator, Session& session) {
  const optimise::Problem problem = problem_of(study, evaluator);
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

int optimise_variables(const OptimiseChoices& a, const OptimiseStudy& study, const Data& data, Session& session) {
  const optimise::Method& method = *optimise::find_method(study.search.method);
  if (!optimise::is_built(method)) optimise::search({}, study.search);  // throws, and says what is missing
  Diagnostics diagnostics;
  compile::check_variables(study, make_source(a.design.design, formats::read_file(a.design.design)), diagnostics);
  auto plan = plan_options({}, session, diagnostics);
  session.events.diagnose(diagnostics);
  if (!plan || diagnostics.has_errors()) return wrong_input;

  const Folder folder{a.folder};
  refuse_folder(a, folder);
  const compile::StoredSearch search(study, compile::search_key(a, data, study, plan->program));
  stores::FolderStore store(folder.path.string(), search,
                            a.resume ? stores::FolderUse::resume : stores::FolderUse::replace,
                            {a.work.threads, nullptr, &session.stop});
  fs::remove(folder.file(earlier_key));
  History history(study);
  history.read(store.finished());
  exporting::write_file(folder.history(), history.table());

  compile::LoadOptions options = a.design.load();
  options.cache = &session.cache;
  const auto load = [&](const compile::LoadOptions& with, Diagnostics& found) {
    const compile::LoadedPtr loaded = session.load(a.design.design, with, found);
    return loaded ? compile::turned(loaded, a.design.rotate.value_or(Vec3{}), found) : nullptr;
  };
  const compile::DesignMeter meter(study, load, options, *plan);
  Evaluator evaluator(a, study, meter, history, folder, store, session);
  const size_t known = history.size();
  try {
    if (!run_search(study, history, evaluator, session)) return wrong_input;
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
  return Report(a, study, history, folder, session.events).write();
}

int run_optimise(const OptimiseChoices& a, Session& session) {
  Diagnostics diagnostics;
  const auto data = parse_json(study_source(a.study), diagnostics);
  if (data && data->find("topology")) return optimise_topology(a, *data, session);
  const std::string ending = ending_of(a.design.design);
  if (ending != ".vcad" && ending != ".scad")
    throw WrongArgument(a.design.design + " has no variables that could be set; take a .vcad or .scad script");
  const auto study = data ? compile::read_optimise_study(*data, diagnostics) : std::nullopt;
  session.events.diagnose(diagnostics);
  if (!study) return wrong_input;
  return optimise_variables(a, *study, *data, session);
}

}  // namespace

JobKind optimise_kind() {
  return job_kind<OptimiseChoices>("optimise", "Search for the values of a design's variables that serve it best",
                                   optimise_footer, run_optimise);
}

}  // namespace ombre::jobs
