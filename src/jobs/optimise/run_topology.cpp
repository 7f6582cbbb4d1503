#include "jobs/optimise/run_topology.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "base/text/text.h"
#include "export/volume_file.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/common/solve_memory.h"
#include "jobs/optimise/optimise_job.h"
#include "jobs/optimise/topology_study.h"
#include "optimise/chart.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;
using compile::OptimiseChoices;

struct TopologyCase {
  compile::TopologyStudy study;
  fea::Model model;
  fea::Conditions conditions;
  std::optional<optimise::TopologyGoal> goal;
};

// Makes the goal. Conditions of the goal's force alone tell which nodes move, and how much each counts.
std::optional<optimise::TopologyGoal> make_goal(const compile::TopologyStudy& study, const fea::Model& model,
                                                Diagnostics& diagnostics) {
  fea::Study alone = study.model.fea;
  alone.loads = {*study.goal};
  auto conditions = fea::conditions_of(alone, model, diagnostics);
  if (!conditions) return std::nullopt;
  return optimise::TopologyGoal{std::move(conditions->forces), study.is_greatest};
}

std::optional<TopologyCase> make_topology_case(const OptimiseChoices& a, const compile::TopologyStudy& study,
                                               Session& session, Diagnostics& diagnostics) {
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
  if (!loaded) return std::nullopt;
  const auto options = plan_options({}, a.work, session, diagnostics);
  if (!options) return std::nullopt;
  const auto plan = compile::plan_bricks(loaded, study.model, *options, diagnostics);
  if (!plan) return std::nullopt;
  const compile::FeaRequest request = study.model.sections.request(a.work.threads);
  auto model = compile::fea_model(loaded, *plan, study.model.fea, request, diagnostics, nullptr, &session.stop);
  if (!model) return std::nullopt;
  auto conditions = fea::conditions_of(study.model.fea, *model, diagnostics);
  if (!conditions) return std::nullopt;
  std::optional<optimise::TopologyGoal> goal;
  if (study.goal && !(goal = make_goal(study, *model, diagnostics))) return std::nullopt;
  return TopologyCase{study, std::move(*model), std::move(*conditions), std::move(goal)};
}

// Writes densities as a grid around the bricks; 0 where there is none.
void write_density(const std::string& path, const fea::Bricks& bricks, const std::vector<float>& density) {
  fea::Cell low = bricks.cells.front(), high = low;
  for (const fea::Cell& cell : bricks.cells)
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis]);
    }
  exporting::Volume volume;
  volume.is_float = true;
  volume.spacing_mm = bricks.size_mm;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<int>(axis);
    volume.count[axis] = high[axis] - low[axis] + 1;
    volume.origin_mm[at] = bricks.origin[at] + (low[axis] + 0.5) * bricks.size_mm[at];
  }
  volume.about = {{"what", "density"}};
  std::vector<float> grid(static_cast<size_t>(volume.count[0] * volume.count[1] * volume.count[2]));
  for (size_t n = 0; n < bricks.count(); ++n) {
    const fea::Cell& cell = bricks.cells[n];
    const int64_t row = (cell[2] - low[2]) * volume.count[1] + (cell[1] - low[1]);
    grid[static_cast<size_t>(row * volume.count[0] + (cell[0] - low[0]))] = density[n];
  }
  std::string bytes(grid.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), grid.data(), bytes.size());
  exporting::VolumeFile file(path, exporting::volume_format(".nrrd"), volume);
  file.append(bytes);
  file.close();
  file.commit();
}

// A table of the steps. Each line is written as soon as its step is done.
class StepTable {
 public:
  StepTable(const std::string& path, bool has_goal) : has_goal_(has_goal), file_(begun(path, has_goal)) {}

  void add(const optimise::TopologyStep& step) {
    file_.append(std::to_string(step.number) + "," + format_number(step.compliance) + "," +
                 format_number(step.volume_fraction) + "," + format_number(step.change) + "," +
                 format_rounded(step.greyness, 6) + (has_goal_ ? "," + format_number(step.displacement) : "") + "\n");
  }

 private:
  static std::string begun(const std::string& path, bool has_goal) {
    const std::string titles = "step,compliance [N mm],volume fraction,change,greyness";
    exporting::write_file(path, titles + (has_goal ? ",displacement [mm]\n" : "\n"));
    return path;
  }

  bool has_goal_;
  exporting::AppendFile file_;
};

std::string chart_of(const optimise::Topology& topology, bool has_goal) {
  optimise::Chart chart;
  chart.title = has_goal ? "Displacement of each step" : "Compliance of each step";
  chart.x_label = "step";
  chart.y_label = has_goal ? "displacement [mm]" : "compliance [N mm]";
  chart.joins_best = true;
  for (const optimise::TopologyStep& step : topology.steps)
    chart.points.push_back({static_cast<double>(step.number), has_goal ? step.displacement : step.compliance,
                            optimise::ChartPoint::Kind::best});
  return optimise::chart_svg(chart);
}

// Returns a text such as "the compliance fell from 9 to 3 N mm".
std::string change_of(const optimise::Topology& topology, bool has_goal) {
  const optimise::TopologyStep &first = topology.steps.front(), &last = topology.steps.back();
  const auto from_to = [](double from, double to) {
    return " from " + format_rounded(from, 5) + " to " + format_rounded(to, 5);
  };
  const std::string compliance = from_to(first.compliance, last.compliance) + " N mm";
  if (!has_goal) return "the compliance fell" + compliance;
  return "the displacement went" + from_to(first.displacement, last.displacement) + " mm, the compliance" + compliance;
}

// Returns a design that uses the result: it is solid where the density is above a half.
std::string script_of(const OptimiseChoices& a) {
  const fs::path design = fs::proximate(fs::absolute(a.design.design), fs::absolute(a.folder));
  return "// The densities are numbers of a grid, for solids and for mixtures: volume(\"density.nrrd\").value.\n"
         "// The design was " +
         design.generic_string() + "\nvolume_solid(\"density.nrrd\", level=0.5);\n";
}

// Returns the paths of density.nrrd, topology.vcad, history.csv and chart.svg.
std::vector<std::string> files_of(const OptimiseChoices& a) {
  std::vector<std::string> files;
  for (const char* name : {"density.nrrd", "topology.vcad", "history.csv", "chart.svg"})
    files.push_back((fs::path(a.folder) / name).string());
  return files;
}

void refuse_to_overwrite_any(const OptimiseChoices& a) {
  if (a.resume) throw WrongArgument("a search for a topology begins anew; leave out " + spelled::option("--resume"));
  if (!fs::exists(a.folder)) return;
  for (const std::string& path : files_of(a)) refuse_to_overwrite(path, a.force);
}

optimise::Topology search(const OptimiseChoices& a, const TopologyCase& made, Session& session) {
  optimise::TopologyOptions options = made.study.options;
  options.threads = a.work.threads;
  options.goal = made.goal;
  const Vec3 size = made.model.bricks.size_mm;
  if (!(options.radius_mm > 0)) options.radius_mm = 1.5 * std::max({size.x, size.y, size.z});
  JobProgress progress(session.events, Counted::steps);
  StepTable history(files_of(a)[2], made.goal.has_value());
  const auto report = [&](const optimise::TopologyStep& step) {
    history.add(step);
    progress.update({step.number, options.steps});
  };
  optimise::Topology topology = optimise::find_topology(made.model, made.conditions, options, report, &session.stop);
  progress.finish();
  return topology;
}

void tell(const TopologyCase& made, const optimise::Topology& topology, const std::vector<std::string>& files,
          const Events& events) {
  const optimise::TopologyStep& last = topology.steps.back();
  events.say(format_count(topology.steps.size()) + " steps: " + change_of(topology, made.goal.has_value()) + " with " +
             format_rounded(100 * last.volume_fraction, 3) + " % of the volume, " +
             format_rounded(100 * last.greyness, 3) + " % grey" +
             (last.change > made.study.options.change ? ", and would change further with more steps" : ""));
  events.say("densities in " + files[0] + ", a solid of them in " + files[1]);
  events.event("topology", {{"bricks", static_cast<double>(made.model.bricks.count())},
                            {"steps", static_cast<double>(topology.steps.size())},
                            {"compliance_n_mm", last.compliance},
                            {"displacement_mm", made.goal ? Data(last.displacement) : Data()},
                            {"volume_fraction", last.volume_fraction},
                            {"change", last.change},
                            {"greyness", last.greyness},
                            {"files", DataList(files.begin(), files.end())}});
}

int find_and_write(const OptimiseChoices& a, const TopologyCase& made, Session& session) {
  std::error_code problem;
  fs::create_directories(a.folder, problem);
  if (problem) throw Error(Code::cannot_write, "cannot make the folder " + a.folder + ": " + problem.message());
  const optimise::Topology topology = search(a, made, session);
  const std::vector<std::string> files = files_of(a);
  write_density(files[0], made.model.bricks, topology.density);
  exporting::write_file(files[1], script_of(a));
  exporting::write_file(files[3], chart_of(topology, made.goal.has_value()));
  tell(made, topology, files, session.events);
  return done;
}

}  // namespace

int optimise_topology(const OptimiseChoices& a, const Data& data, Session& session) {
  JobSteps<TopologyCase> steps;
  steps.refuse = [&] { refuse_to_overwrite_any(a); };
  steps.plan = [&](Diagnostics& diagnostics) -> std::optional<TopologyCase> {
    const auto study = compile::read_topology_study(data, diagnostics);
    return study ? make_topology_case(a, *study, session, diagnostics) : std::nullopt;
  };
  steps.check = [&](const TopologyCase& made) {
    refuse_little_memory(fea::solve_bytes(made.model.bricks), a.work.memory_bytes,
                         "choose larger bricks with \"cell\"");
  };
  steps.run = [&](const TopologyCase& made) { return find_and_write(a, made, session); };
  return take_steps(steps, session);
}

}  // namespace ombre::jobs
