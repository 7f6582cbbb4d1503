// `ombre optimise` searches for the best values of a design's variables.
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "base/system/hash.h"
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
#include "load/files_read.h"
#include "load/turned.h"
#include "optimise/chart.h"
#include "optimise/ranking.h"

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

// The files of the folder.
struct Folder {
  fs::path path;

  std::string file(const std::string& name) const { return (path / name).string(); }
  std::string history() const { return file("history.csv"); }
  std::string key() const { return file("study.key"); }
};

// Lists the data that a search depends on, a line for each part: its name and the hash of its content. Searches with
// equal results have equal keys, whatever number of designs each may measure.
class SearchKey {
 public:
  SearchKey(const OptimiseChoices& a, const Data& data, const OptimiseStudy& study) {
    DataMembers members;
    for (const auto& [name, value] : *data.members())
      if (name != "evaluations") members.emplace_back(name, value);
    add("the study", print_json_line(Data(members)));
    if (const Data* fea = data.find("fea"); fea && fea->string())
      add(*fea->string(), formats::read_file((fs::path(study_folder(a.study)) / *fea->string()).string()));
    std::string definitions;
    for (const std::string& definition : a.design.definitions) definitions += definition + "\n";
    add(spelled::option("-D").text(), definitions);
    const Vec3 turn = a.design.rotate.value_or(Vec3{});
    add(spelled::option("--rotate").text(),
        format_number(turn.x) + "," + format_number(turn.y) + "," + format_number(turn.z));
    add_files(a, study);
  }

  std::string text() const { return join(lines_, "\n") + "\n"; }

  // Returns the names of the parts in which an earlier search differs.
  std::vector<std::string> differences(const std::string& earlier) const {
    std::vector<std::string> before = split(earlier, '\n'), names;
    const auto missing_in = [&](const std::vector<std::string>& lines, const std::vector<std::string>& others) {
      for (const std::string& line : lines) {
        const std::string name = line.substr(0, line.rfind(' '));
        if (!line.empty() && std::ranges::find(others, line) == others.end() &&
            std::ranges::find(names, name) == names.end())
          names.push_back(name);
      }
    };
    missing_in(lines_, before);
    missing_in(before, lines_);
    return names;
  }

 private:
  void add(const std::string& name, const std::string& content) {
    lines_.push_back(name + " " + hash_bytes(content).hex());
  }

  // Adds the files that the first design reads.
  void add_files(const OptimiseChoices& a, const OptimiseStudy& study) {
    std::vector<double> start;
    for (const compile::DesignVariable& variable : study.variables) start.push_back(variable.start);
    compile::LoadOptions options{a.design.materials, a.design.definitions};
    for (std::string& definition : compile::definitions_of(study, start))
      options.definitions.push_back(std::move(definition));
    Diagnostics ignored;  // measuring the first design reports them
    const auto files = compile::files_read(a.design.design, options, ignored);
    const fs::path folder = compile::whole_path(a.design.design).parent_path();
    if (!files) return add(a.design.design, formats::read_file(a.design.design));
    for (const fs::path& file : *files)
      add(fs::proximate(file, folder).generic_string(), formats::read_file(file.string()));
  }

  std::vector<std::string> lines_;
};

// Prepares the folder. A resumed search reads its history.
bool open_folder(const OptimiseChoices& a, const Folder& folder, const SearchKey& key, History& history,
                 Diagnostics& diagnostics) {
  std::error_code problem;
  fs::create_directories(folder.path, problem);
  if (problem)
    throw Error(Code::cannot_write, "cannot make the folder " + folder.path.string() + ": " + problem.message());
  const bool has_history = fs::exists(folder.history());
  if (has_history && !a.resume && !a.force)
    throw WrongArgument(folder.history() + " is there; write " + spelled::option("--resume") +
                        " to go on with it, or " + spelled::option("--force") + " to begin again");
  if (!has_history && a.resume)
    throw WrongArgument("there is no " + folder.history() + " to go on with; leave out " + spelled::option("--resume"));
  if (a.resume) {
    const auto changed = key.differences(fs::exists(folder.key()) ? formats::read_file(folder.key()) : "");
    if (!changed.empty())
      throw WrongArgument("the history in " + folder.path.string() + " is of another study or design, since " +
                          join(changed, ", ") + (changed.size() == 1 ? " differs" : " differ") + "; choose another " +
                          spelled::option("-o") + ", or " + spelled::option("--force") + " to begin again");
    if (!history.read(folder.history(), formats::read_file(folder.history()), diagnostics)) return false;
  }
  std::string text = history.header();
  for (size_t row = 0; row < history.rows().size(); ++row) text += history.line(row);
  exporting::write_file(folder.history(), text);
  exporting::write_file(folder.key(), key.text());
  return true;
}

// Measures designs that are not in the history, several at once if memory allows.
class Evaluator {
 public:
  Evaluator(const OptimiseChoices& a, const OptimiseStudy& study, const compile::DesignMeter& meter, History& history,
            const Folder& folder, Session& session)
      : study_(study),
        meter_(meter),
        history_(history),
        file_(folder.history()),
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
  void finish() { progress_.finish(); }
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
    history_.add({values, std::move(measured)});
    file_.append(history_.line(history_.rows().size() - 1));
    ++measured_;
  }

  const OptimiseStudy& study_;
  const compile::DesignMeter& meter_;
  History& history_;
  exporting::AppendFile file_;
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

std::string chart_of(const OptimiseStudy& study, const History& history, const std::vector<Outcome>& outcomes,
                     const std::vector<size_t>& front) {
  using Kind = optimise::ChartPoint::Kind;
  const auto measures = study.measures();
  const bool has_two = study.objectives.size() > 1;
  optimise::Chart chart;
  chart.title = has_two ? "Designs, the best in red" : "Designs in the order of the search, the best in red";
  chart.x_label = has_two ? measures[0].label() : "design";
  chart.y_label = measures[has_two ? 1 : 0].label();
  chart.joins_best = has_two;
  const auto add = [&](size_t n, Kind kind) {
    const auto& values = history.rows()[n].measured.values;
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
      : a_(a), study_(study), history_(history), folder_(folder), events_(events) {
    for (const History::Row& row : history.rows()) outcomes_.push_back(outcome_of(study, row.measured));
    front_ = optimise::front_of(outcomes_);
  }

  int write() {
    write_file("chart.svg", chart_of(study_, history_, outcomes_, front_));
    if (front_.empty()) return tell_nothing_holds();
    std::string table = history_.header();
    for (const size_t row : front_) table += history_.line(row);
    write_file("front.csv", table);
    size_t number = 0;
    const std::string ending = fs::path(a_.design.design).extension().string();
    for (const size_t row : some_of(front_, static_cast<size_t>(a_.best))) {
      const std::string name = "best_" + std::to_string(++number) + ending;
      write_file(name, script_of(a_, study_, folder_, history_.rows()[row]));
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
    const History::Row& best = history_.rows()[row];
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
    const History::Row& row = history_.rows()[nearest];
    events_.error(Code::nothing_inside, "no design keeps all limits; the nearest is " + values_text(study_, row) +
                                            ": " + measures_text(study_, row));
    return check_failed;
  }

  const OptimiseChoices& a_;
  const OptimiseStudy& study_;
  const History& history_;
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
  const Folder folder{a.folder};
  History history(study);
  const bool is_open =
      plan && !diagnostics.has_errors() && open_folder(a, folder, SearchKey(a, data, study), history, diagnostics);
  session.events.diagnose(diagnostics);
  if (!is_open) return wrong_input;

  compile::LoadOptions options{a.design.materials, a.design.definitions};
  options.cache = &session.cache;
  const auto load = [&](const compile::LoadOptions& with, Diagnostics& found) {
    const compile::LoadedPtr loaded = session.load(a.design.design, with, found);
    return loaded ? compile::turned(loaded, a.design.rotate.value_or(Vec3{}), found) : nullptr;
  };
  const compile::DesignMeter meter(study, load, options, *plan);
  Evaluator evaluator(a, study, meter, history, folder, session);
  const size_t known = history.rows().size();
  try {
    if (!run_search(study, history, evaluator, session)) return wrong_input;
  } catch (const Cancelled&) {
    evaluator.finish();
    session.events.say(folder.history() + " has " + format_count(history.rows().size()) +
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
