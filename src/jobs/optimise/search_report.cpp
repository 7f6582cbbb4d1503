#include "jobs/optimise/search_report.h"

#include <algorithm>
#include <filesystem>

#include "base/text/text.h"
#include "export/output_file.h"
#include "jobs/common/exit_codes.h"
#include "optimise/chart.h"
#include "optimise/ranking.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;
using compile::History;
using compile::OptimiseStudy;

std::string measures_text(const OptimiseStudy& study, const History::Row& row) {
  std::vector<std::string> parts;
  const auto measures = study.measures();
  for (size_t n = 0; n < measures.size(); ++n)
    parts.push_back(measures[n].label() + " " + format_rounded(row.measured.values[n], 6));
  return join(parts, ", ");
}

// Returns the option that turns the script as the measured designs were turned.
std::string turn_text(const compile::OptimiseChoices& a) {
  if (!a.design.rotate) return "";
  const Vec3 turn = *a.design.rotate;
  return "; with " +
         spelled::option("--rotate", format_number(turn.x) + "," + format_number(turn.y) + "," + format_number(turn.z))
             .text();
}

// Returns a script that is the design with other values: the last value of a variable counts.
std::string script_of(const compile::OptimiseChoices& a, const OptimiseStudy& study, const History::Row& row) {
  const fs::path design = fs::proximate(fs::absolute(a.design.design), fs::absolute(a.folder));
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
                     const std::vector<optimise::Outcome>& outcomes, const std::vector<size_t>& front) {
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
  Report(const compile::OptimiseChoices& a, const OptimiseStudy& study, const History& history, const Events& events)
      : a_(a), study_(study), history_(history), rows_(history.rows()), events_(events) {
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
      write_file(name, script_of(a_, study_, *rows_[row]));
      tell(row, name);
    }
    events_.event("done", {{"files", files_}});
    return done;
  }

 private:
  std::string file(const std::string& name) const { return (fs::path(a_.folder) / name).string(); }

  void write_file(const std::string& name, const std::string& text) {
    exporting::write_file(file(name), text);
    files_.emplace_back(file(name));
  }

  void tell(size_t row, const std::string& name) const {
    const History::Row& best = *rows_[row];
    events_.say(name + ": " + values_text(study_, best) + "; " + measures_text(study_, best));
    DataMembers values, measures;
    for (size_t n = 0; n < best.values.size(); ++n) values.emplace_back(study_.variables[n].name, best.values[n]);
    const auto all = study_.measures();
    for (size_t n = 0; n < all.size(); ++n) measures.emplace_back(all[n].label(), best.measured.values[n]);
    events_.event("best", {{"file", file(name)}, {"variables", values}, {"measures", measures}});
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

  const compile::OptimiseChoices& a_;
  const OptimiseStudy& study_;
  const History& history_;
  std::vector<const History::Row*> rows_;
  const Events& events_;
  std::vector<optimise::Outcome> outcomes_;
  std::vector<size_t> front_;
  DataList files_;
};

}  // namespace

std::string values_text(const OptimiseStudy& study, const History::Row& row) {
  std::vector<std::string> parts;
  for (size_t n = 0; n < row.values.size(); ++n)
    parts.push_back(study.variables[n].name + " = " + format_rounded(row.values[n], 6));
  return join(parts, ", ");
}

int report_search(const compile::OptimiseChoices& choices, const OptimiseStudy& study, const History& history,
                  const Events& events) {
  return Report(choices, study, history, events).write();
}

}  // namespace ombre::jobs
