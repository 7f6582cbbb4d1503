// `ombre characterise` says what a part or a cell is like: density, surfaces, topology, thinnest places, stiffness.
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "jobs/characterise/characterise_choices.h"
#include "jobs/characterise/characteristics.h"
#include "jobs/common/data_events.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/homogenise/homogenise_job.h"

namespace ombre::jobs {
namespace {

using compile::CharacteriseChoices;
using compile::Characteristics;
using compile::Measured;
using compile::Periodic;
using compile::ThinPlace;

constexpr const char* characterise_footer =
    "Volumes and areas are those of the closed surfaces that ombre mesh makes with cells of the voxels' size and of "
    "twice\n"
    "that size, extrapolated; pieces, Euler's number, sections and thin places are those of the voxels. The least "
    "wall\n"
    "is as thick as the largest ball that fits everywhere inside, but for edges and corners; the least gap likewise\n"
    "outside.\n\n"
    "Examples:\n"
    "  ombre characterise part.vcad --voxel 0.1\n"
    "  ombre characterise cell.vcad --voxel 0.1 --box 0,0,0,5,5,5 --periodic xyz --stiffness --picture cell.svg\n"
    "  ombre characterise cell.vcad --voxel 0.1 --periodic xyz --sweep thickness=0.2..1:9 --key density -o curve.csv\n";

// Values of a variable from a low to a high one.
struct Curve {
  std::string name;
  double low = 0, high = 0;
  int steps = 1;

  double value(int n) const { return steps == 1 ? low : low + (high - low) * n / (steps - 1); }
};

// Reads NAME=LOW..HIGH:N.
Curve curve_of(const std::string& text) {
  constexpr int most_steps = 1000;
  const size_t equals = text.find('='), dots = text.find(".."), colon = text.rfind(':');
  const auto part = [&](size_t from, size_t to) { return std::string(trim(text.substr(from, to - from))); };
  if (equals != std::string::npos && dots != std::string::npos && colon != std::string::npos && equals < dots &&
      dots < colon) {
    const auto low = parse_number(part(equals + 1, dots)), high = parse_number(part(dots + 2, colon));
    const auto steps = parse_number(part(colon + 1, text.size()));
    if (low && high && *low < *high && steps && *steps >= 2 && *steps <= most_steps && *steps == std::floor(*steps))
      return {part(0, equals), *low, *high, static_cast<int>(*steps)};
  }
  throw WrongArgument(spelled::option("--sweep", text) + " is no curve: write for example " +
                      spelled::option("--sweep", "thickness=0.2..1:9") + ", with 2 to 1000 values");
}

Periodic periodic_of(const std::string& axes) {
  Periodic periodic{};
  for (const char letter : axes) {
    const size_t axis = std::string("xyz").find(letter);
    if (axis == std::string::npos)
      throw WrongArgument(spelled::option("--periodic", axes) + " is not a choice of axes: write for example " +
                          spelled::option("--periodic", "xyz"));
    periodic[axis] = true;
  }
  return periodic;
}

// True for the numbers of a homogenisation that a table has.
bool is_of_stiffness(const std::string& name) {
  return name.find("mpa") != std::string::npos || name.find("ratio") != std::string::npos ||
         name.find("conductivity") != std::string::npos;
}

void refuse_key(const std::string& key, const std::vector<std::string>& names) {
  const std::string close = did_you_mean(key, names);
  throw WrongArgument("there is no column \"" + key + "\"; " +
                      (close.empty() ? "there are " + join(names, ", ") : close));
}

// Refuses a column that no table has. Those of a stiffness are known once there is one.
void check_key(const CharacteriseChoices& a, const std::string& variable) {
  Characteristics any;
  any.periodic = periodic_of(a.periodic);
  std::vector<std::string> names{variable};
  for (const auto& [name, value] : any.numbers()) names.push_back(name);
  const bool is_known = std::ranges::find(names, a.key) != names.end();
  if (!a.key.empty() && !is_known && !(a.stiffness && is_of_stiffness(a.key))) refuse_key(a.key, names);
}

void refuse(const CharacteriseChoices& a) {
  periodic_of(a.periodic);
  if (!a.sweep.empty()) check_key(a, curve_of(a.sweep).name);
  if (!a.picture.empty() && !to_lower(a.picture).ends_with(".svg"))
    throw WrongArgument(spelled::option("--picture", a.picture) + " does not say a format; let it end in .svg");
  if (!a.picture.empty()) refuse_to_overwrite(a.picture, a.force);
  if (a.output.empty()) return;
  const std::string ending = to_lower(a.output);
  if (!ending.ends_with(".csv") && !ending.ends_with(".json"))
    throw WrongArgument(spelled::option("-o", a.output) + " does not say a format; let it end in .csv or .json");
  if (ending.ends_with(".csv") && a.sweep.empty())
    throw WrongArgument("a table has a row for each value of a variable: add " +
                        spelled::option("--sweep", "thickness=0.2..1:9") + ", or let the file end in .json");
  refuse_to_overwrite(a.output, a.force);
}

std::string text_of(const Measured& one, const std::string& unit) {
  return format_rounded(one.value, 5) + unit + " (within about " + format_rounded(one.error, 2) + ")";
}

std::string place_text(const ThinPlace& thin) {
  if (!thin.is_found) return "none below " + format_rounded(thin.least_mm, 4) + " mm";
  return "about " + format_rounded(thin.least_mm, 4) + " mm, at (" + format_rounded(thin.place.x, 4) + ", " +
         format_rounded(thin.place.y, 4) + ", " + format_rounded(thin.place.z, 4) + ")";
}

std::string pieces_text(const Characteristics& found) {
  const auto counted = [](uint64_t count, const std::string& one, const std::string& several) {
    return format_count(count) + ' ' + (count == 1 ? one : several);
  };
  const auto genus = found.genus();
  return counted(found.pieces.count, "piece", "pieces") + ", " +
         (genus ? counted(found.voids.enclosed, "closed hollow", "closed hollows")
                : "void in " + counted(found.voids.count, "piece", "pieces")) +
         ", Euler's number " + std::to_string(found.euler) + (genus ? ", genus " + std::to_string(*genus) : "");
}

// Near the ends of walls that are a few voxels thick, thin places are taken for their edges.
void warn_of_coarse_voxels(const Events& events, const Characteristics& found) {
  constexpr double enough = 5;
  const double voxel = std::min({found.voxel_mm.x, found.voxel_mm.y, found.voxel_mm.z});
  for (const auto& [what, thin] : {std::pair("wall", &found.wall), std::pair("gap", &found.gap)})
    if (thin->is_found && thin->least_mm < enough * voxel)
      events.warn(std::string("the least ") + what + " is fewer than 5 voxels wide, and may be narrower: choose " +
                  spelled::option("--voxel", format_rounded(thin->least_mm / (2 * enough), 2)) + " to measure it");
}

void tell(const Events& events, const Characteristics& found) {
  const Vec3 size = found.box.size();
  events.say("box of " + format_rounded(size.x) + " x " + format_rounded(size.y) + " x " + format_rounded(size.z) +
             " mm, voxels of " + format_rounded(found.voxel_mm.x, 4) + " x " + format_rounded(found.voxel_mm.y, 4) +
             " x " + format_rounded(found.voxel_mm.z, 4) + " mm");
  events.say("density " + text_of({found.density(), found.density_error()}, "") + ", porosity " +
             format_rounded(1 - found.density(), 5));
  events.say("volume " + text_of(found.volume_mm3, " mm3") + ", surface " + text_of(found.surface_mm2, " mm2"));
  if (found.material_mm3.size() > 1)
    for (const auto& [name, volume] : found.material_mm3) events.say("  " + name + ": " + text_of(volume, " mm3"));
  for (const auto& [names, area] : found.interface_mm2)
    events.say("  border of " + names + ": " + text_of(area, " mm2"));
  events.say("hydraulic diameter " + format_rounded(found.hydraulic_diameter_mm(), 4) + " mm");
  for (size_t axis = 0; axis < 3; ++axis)
    events.say(std::string("sections across ") + "xyz"[axis] + ": " +
               format_rounded(100 * found.sections[axis].least, 4) + " to " +
               format_rounded(100 * found.sections[axis].greatest, 4) + " % of the box, " +
               format_rounded(100 * found.sections[axis].mean, 4) + " % in the mean");
  events.say(pieces_text(found));
  if (found.euler != found.coarse_euler)
    events.warn("Euler's number is " + std::to_string(found.coarse_euler) +
                " with voxels of twice the size: pieces or holes are as small as the voxels; choose a smaller " +
                spelled::option("--voxel"));
  warn_of_coarse_voxels(events, found);
  for (const compile::RandomCells& foam : found.random_cells) events.say(foam.text());
  for (const compile::LatticeGraph& lattice : found.lattices) events.say(lattice.text());
  events.say("least wall " + place_text(found.wall) + "; least gap " + place_text(found.gap));
}

compile::CharacteriseRequest request_of(const CharacteriseChoices& a, Session& session) {
  compile::CharacteriseRequest request;
  request.voxel_mm = a.voxel_mm;
  request.box = a.box;
  request.periodic = periodic_of(a.periodic);
  request.threads = a.work.threads;
  request.memory_bytes = a.work.memory_bytes;
  request.stop = &session.stop;
  return request;
}

std::optional<Characteristics> characterise(const CharacteriseChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto loaded = load_design(a.design, session, diagnostics, a.work.threads);
  const auto options = loaded ? plan_options({}, a.work, session, diagnostics) : std::nullopt;
  if (!options) return std::nullopt;
  compile::CharacteriseRequest request = request_of(a, session);
  JobProgress progress(session.events, Counted::steps);  // layers of voxels, then slabs of the mesh
  request.progress = &progress;
  auto found = characteristics_of(loaded, request, *options, diagnostics);
  progress.finish();
  return found;
}

compile::HomogeniseChoices homogenise_choices(const CharacteriseChoices& a) {
  compile::HomogeniseChoices choices;
  choices.design = a.design;
  choices.cell_mm = a.cell_mm.value_or(a.voxel_mm);
  choices.box = a.box;
  choices.study = a.study;
  choices.output = a.picture;
  choices.force = true;  // an existing file was refused before
  choices.work = a.work;
  choices.work.memory_bytes = std::max(a.work.memory_bytes, choices.work.memory_bytes);
  return choices;
}

// Lets work of the session give its events to a function instead.
template <class Work>
auto with_events(Session& session, const std::function<void(const DataMembers&)>& on_event, const Work& work) {
  const DataEvents events(FrontEnd::command_line, on_event, [](const std::string&) {});
  Session own{events, session.stop, session.load, session.cache, session.program, session.quit_at_once};
  return work(own);
}

// Runs the homogenisation, and returns what it reports as data. If it fails it runs again, to tell the session why.
std::optional<DataMembers> stiffness(const CharacteriseChoices& a, Session& session) {
  std::optional<DataMembers> found;
  const compile::HomogeniseChoices choices = homogenise_choices(a);
  const auto keep = [&](const DataMembers& event) {
    if (*Data(event).find("event") == Data("homogenised")) found = event;
  };
  with_events(session, keep, [&](Session& own) { return homogenise_kind().run(&choices, own); });
  if (!found) homogenise_kind().run(&choices, session);
  return found;
}

// Sees before anything is measured whether the homogenisation can be done. Returns false, and adds diagnostics, if not.
bool can_homogenise(const CharacteriseChoices& a, Session& session, Diagnostics& diagnostics) {
  if (!a.stiffness) return true;
  const compile::HomogeniseChoices choices = homogenise_choices(a);
  Diagnostics found;
  const auto is_stiffness = with_events(
      session, [](const DataMembers&) {}, [&](Session& own) { return gives_stiffness(choices, own, found); });
  if (!is_stiffness) diagnostics.add_all(found);  // else the homogenisation tells them
  if (is_stiffness == false && !a.picture.empty())
    throw WrongArgument(spelled::option("--picture", a.picture) +
                        " is a chart of stiffness: conductivities have none; leave it out");
  return is_stiffness.has_value();
}

// Adds the numbers of an event: those of a list by their places, which begin with 1.
void add_numbers(const std::string& name, const Data& value, std::vector<std::pair<std::string, double>>& rows) {
  if (value.number()) rows.emplace_back(name, *value.number());
  if (!value.list()) return;
  for (size_t n = 0; n < value.list()->size(); ++n)
    add_numbers(name + "." + std::to_string(n + 1), (*value.list())[n], rows);
}

void add_stiffness(const DataMembers& event, std::vector<std::pair<std::string, double>>& rows) {
  for (const auto& [name, value] : event)
    if (is_of_stiffness(name)) add_numbers(name, value, rows);
}

void write_json(const CharacteriseChoices& a, const Data& data, Session& session, DataList& files) {
  exporting::write_file(a.output, print_json(data));
  session.events.say(a.output + " written");
  files.emplace_back(a.output);
}

int finish(Session& session, const DataList& files) {
  session.events.event("done", {{"files", files}});
  return done;
}

int run_one(const CharacteriseChoices& a, const Characteristics& found, Session& session) {
  tell(session.events, found);
  DataMembers members = found.data();
  session.events.event("characteristics", members);
  DataList files;
  if (a.output.empty()) {
    const compile::HomogeniseChoices choices = homogenise_choices(a);
    return a.stiffness ? homogenise_kind().run(&choices, session) : finish(session, files);
  }
  if (a.stiffness) {
    const auto solved = stiffness(a, session);
    if (!solved) return wrong_input;
    members.emplace_back("homogenised", *solved);
    if (!a.picture.empty()) files.emplace_back(a.picture);
  }
  write_json(a, members, session, files);
  return finish(session, files);
}

using Row = std::vector<std::pair<std::string, double>>;

std::optional<Row> row_of(const CharacteriseChoices& a, const Curve& curve, int n, Session& session,
                          Diagnostics& diagnostics) {
  CharacteriseChoices one = a;
  one.design.needed = {curve.name};
  one.design.definitions.push_back(curve.name + "=" + format_number(curve.value(n)));
  const bool is_first = n == 0;
  if (is_first && !can_homogenise(one, session, diagnostics)) return std::nullopt;
  const auto found = characterise(one, session, diagnostics);
  if (!found) return std::nullopt;
  Row row{{curve.name, curve.value(n)}};
  for (const auto& number : found->numbers())
    if (number.first != curve.name) row.push_back(number);
  if (!a.stiffness) return row;
  const auto solved = stiffness(one, session);
  if (!solved) return std::nullopt;
  add_stiffness(*solved, row);
  return row;
}

std::vector<std::string> names_of(const Row& row) {
  std::vector<std::string> names;
  for (const auto& [name, value] : row) names.push_back(name);
  return names;
}

void check_column(const std::string& key, const Row& row) {
  const std::vector<std::string> names = names_of(row);
  if (std::ranges::find(names, key) == names.end()) refuse_key(key, names);
}

// Puts the column first and sorts the rows by it. Throws WrongArgument if there is no such column, or values repeat.
void sort_by(const std::string& key, std::vector<Row>& rows) {
  for (Row& row : rows) {
    check_column(key, row);
    const auto column = std::ranges::find(row, key, &std::pair<std::string, double>::first);
    std::rotate(row.begin(), column, column + 1);
  }
  std::ranges::sort(rows, {}, [](const Row& row) { return row.front().second; });
  for (size_t n = 1; n < rows.size(); ++n)
    if (!(rows[n - 1].front().second < rows[n].front().second))
      throw WrongArgument(key + " is " + format_rounded(rows[n].front().second) +
                          " twice, so it says no value of the others; choose another " + spelled::option("--key"));
}

std::string table_of(const std::vector<Row>& rows) {
  std::string table = join(names_of(rows.front()), ",") + "\n";
  for (const Row& row : rows) {
    std::vector<std::string> values;
    for (const auto& [name, value] : row) values.push_back(format_rounded(value, 10));
    table += join(values, ",") + "\n";
  }
  return table;
}

int run_curve(const CharacteriseChoices& a, Session& session) {
  refuse(a);
  const Curve curve = curve_of(a.sweep);
  std::vector<Row> rows;
  for (int n = 0; n < curve.steps; ++n) {
    Diagnostics diagnostics;
    auto row = row_of(a, curve, n, session, diagnostics);
    session.events.diagnose(diagnostics);
    if (!row) return wrong_input;
    if (!rows.empty() && row->size() != rows.front().size())
      throw WrongArgument("with " + curve.name + " = " + format_number(curve.value(n)) +
                          " other numbers are known than before; choose a range in which the part stays in one piece");
    session.events.say(curve.name + " = " + format_rounded(curve.value(n), 5) + ": density " +
                       format_rounded((*row)[1].second, 5));
    rows.push_back(std::move(*row));
    if (n == 0 && !a.key.empty()) check_column(a.key, rows.front());
  }
  if (!a.key.empty()) sort_by(a.key, rows);
  DataList list;
  for (const Row& row : rows) {
    DataMembers members;
    for (const auto& [name, value] : row) members.emplace_back(name, value);
    list.emplace_back(members);
  }
  DataList files;
  if (to_lower(a.output).ends_with(".json")) {
    write_json(a, DataMembers{{"rows", list}}, session, files);
  } else {
    exporting::write_file(a.output, table_of(rows));
    session.events.say(a.output + " written");
    files.emplace_back(a.output);
  }
  session.events.event("curve", {{"rows", list}});
  return finish(session, files);
}

int run_characterise(const CharacteriseChoices& a, Session& session) {
  if (!a.sweep.empty()) return run_curve(a, session);
  JobSteps<Characteristics> steps;
  steps.refuse = [&] { refuse(a); };
  steps.plan = [&](Diagnostics& diagnostics) {
    return can_homogenise(a, session, diagnostics) ? characterise(a, session, diagnostics) : std::nullopt;
  };
  steps.run = [&](const Characteristics& found) { return run_one(a, found, session); };
  return take_steps(steps, session);
}

}  // namespace

JobKind characterise_kind() {
  return job_kind<CharacteriseChoices>("characterise",
                                       "Say what a part or a cell is like: density, surfaces, holes, thin places",
                                       characterise_footer, run_characterise);
}

}  // namespace ombre::jobs
