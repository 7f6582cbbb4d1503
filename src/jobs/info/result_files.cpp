#include "jobs/info/result_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/math/box.h"
#include "base/math/point_text.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "formats/results/result_steps.h"
#include "formats/results/results.h"
#include "import/surfaces/mesh_report.h"
#include "jobs/common/session.h"
#include "sources/files_of_results.h"
#include "sources/result_border.h"

namespace ombre::jobs {
namespace {

constexpr std::array<std::string_view, formats::element_kinds> kind_names{"C3D4",  "C3D10", "C3D8",
                                                                          "C3D20", "C3D6",  "C3D5"};

std::array<size_t, formats::element_kinds> counts_of_kinds(const formats::Results& results) {
  std::array<size_t, formats::element_kinds> counts{};
  for (const formats::ElementKind kind : results.kinds) ++counts[static_cast<size_t>(kind)];
  return counts;
}

Box box_of_points(const formats::Results& results) {
  Box box;
  for (const Vec3& point : results.points) box = hull(box, Box{point, point});
  return box;
}

// Returns the range of the finite values of a component.
Interval range_of_component(const formats::ResultField& field, size_t component) {
  Interval range(Box::inf, -Box::inf);
  for (size_t n = component; n < field.values.size(); n += field.components)
    if (std::isfinite(field.values[n])) range = hull(range, Interval(field.values[n]));
  return range;
}

// Returns "3: 1 (time 0.5), 2 (time 1), 3 (time 1.5); shown is number 3".
std::string steps_line(const formats::Results& results) {
  if (results.step_times.empty()) return "";
  const size_t count = results.step_times.size();
  const std::string shown = results.step == 0 ? "each field is of the last one that has it"
                                              : "shown is number " + std::to_string(results.step);
  return "  steps     " + format_count(count) + ": " + formats::steps_text(results.step_times) + "; " + shown + "\n";
}

std::string_view name_of(formats::ResultSet::Of of) {
  constexpr std::array<std::string_view, 3> names{"nodes", "elements", "sides"};
  return names[static_cast<size_t>(of)];
}

std::string sets_text(const formats::Results& results) {
  constexpr size_t most_shown = 40;
  if (results.sets.empty()) return "";
  std::string text = "\nsets\n";
  for (size_t n = 0; n < std::min(results.sets.size(), most_shown); ++n) {
    const formats::ResultSet& set = results.sets[n];
    text += "  " + set.name + ": " + format_count(set.count) + ' ' + std::string(name_of(set.of)) + "\n";
  }
  if (results.sets.size() > most_shown) text += "  and " + format_count(results.sets.size() - most_shown) + " more\n";
  return text;
}

std::string field_text(const formats::ResultField& field, bool is_of_steps) {
  std::string text = "  " + field.name + (field.unit.empty() ? "" : ", " + field.unit) +
                     (field.is_of_elements ? ", of elements" : ", of nodes");
  if (is_of_steps) text += ", of step " + std::to_string(field.step);
  text += field.components == 1 ? ": " : ", " + std::to_string(field.components) + " components: ";
  for (size_t n = 0; n < field.components; ++n) {
    const Interval range = range_of_component(field, n);
    text += (n > 0 ? "; " : "") +
            (range.lo <= range.hi ? format_rounded(range.lo, 5) + " to " + format_rounded(range.hi, 5) : "no values");
  }
  return text + "\n";
}

// Returns the volume that the elements fill in mm3; null if there are none, or their outer sides do not close.
std::optional<double> volume_of_elements(const std::string& path, const formats::Results& results) {
  Diagnostics ignored;
  const auto border = sources::border_of_elements(path, results, ignored);
  if (!border) return std::nullopt;
  const importing::MeshReport report = importing::inspect(*border);
  return report.is_closed() ? std::optional(report.volume) : std::nullopt;
}

std::string results_text(const std::string& path, const formats::Results& results) {
  const Box box = box_of_points(results);
  const auto counts = counts_of_kinds(results);
  std::string text = path + ": results of a simulation\n  nodes     " + format_count(results.points.size()) +
                     ", from " + format_point(box.lo, 6) + " to " + format_point(box.hi, 6) + " mm\n";
  for (size_t n = 0; n < counts.size(); ++n)
    if (counts[n] > 0) text += "  elements  " + format_count(counts[n]) + " " + std::string(kind_names[n]) + "\n";
  if (const auto volume = volume_of_elements(path, results))
    text += "  volume    " + format_rounded(*volume, 7) + " mm3\n";
  text += steps_line(results);
  text += results.fields.empty() ? "\nno fields\n" : "\nfields\n";
  for (const formats::ResultField& field : results.fields)
    text += field_text(field, results.step == 0 && field.step > 0);
  return text + sets_text(results);
}

DataList steps_data(const formats::Results& results) {
  DataList list;
  for (const std::string& text : results.step_times) {
    const auto time = parse_number(text);
    list.push_back(time ? Data(*time) : text.empty() ? Data() : Data(text));
  }
  return list;
}

DataList sets_data(const formats::Results& results) {
  DataList list;
  for (const formats::ResultSet& set : results.sets)
    list.emplace_back(DataMembers{
        {"name", set.name}, {"of", std::string(name_of(set.of))}, {"count", static_cast<double>(set.count)}});
  return list;
}

DataList left_out_data(const formats::Results& results) {
  DataList list;
  for (const formats::LeftOut& left : results.left_out)
    list.emplace_back(DataMembers{{"what", left.what}, {"count", static_cast<double>(left.count)}});
  return list;
}

// Returns the number of a step, or null for 0.
Data step_data(uint64_t step) { return step > 0 ? Data(static_cast<double>(step)) : Data(); }

DataMembers results_members(const std::string& path, const formats::Results& results) {
  DataMembers elements;
  const auto counts = counts_of_kinds(results);
  for (size_t n = 0; n < counts.size(); ++n)
    if (counts[n] > 0) elements.emplace_back(std::string(kind_names[n]), static_cast<double>(counts[n]));
  DataList fields;
  for (const formats::ResultField& field : results.fields) {
    DataList ranges;
    for (size_t n = 0; n < field.components; ++n) {
      const Interval range = range_of_component(field, n);
      ranges.push_back(range.lo <= range.hi ? Data(DataList{range.lo, range.hi}) : Data());
    }
    fields.emplace_back(DataMembers{{"name", field.name},
                                    {"unit", field.unit},
                                    {"of", field.is_of_elements ? "elements" : "nodes"},
                                    {"step", step_data(results.step > 0 ? results.step : field.step)},
                                    {"ranges", std::move(ranges)}});
  }
  const Box box = box_of_points(results);
  const auto volume = volume_of_elements(path, results);
  return {{"file", path},
          {"nodes", static_cast<double>(results.points.size())},
          {"elements", std::move(elements)},
          {"bounds_mm", DataList{box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z}},
          {"volume_mm3", volume ? Data(*volume) : Data()},
          {"step_times", steps_data(results)},
          {"step", step_data(results.step)},
          {"fields", std::move(fields)},
          {"sets", sets_data(results)},
          {"left_out", left_out_data(results)}};
}

}  // namespace

bool is_results(const std::string& path) { return sources::has_elements(path); }

int show_results(const InfoChoices& choices, Session& session) {
  const std::string& path = choices.file;
  Diagnostics diagnostics;
  const auto results = sources::read_results(path, diagnostics, static_cast<uint64_t>(choices.step), choices.values);
  session.events.diagnose(diagnostics);
  if (!results) return wrong_input;
  if (session.events.wants_data())
    session.events.event("results", results_members(path, *results));
  else
    session.events.print(results_text(path, *results));
  return done;
}

std::string results_as_script(const std::string& path, const std::string& by, double deform, int step) {
  const std::string file = print_json_line(Data(std::filesystem::path(path).filename().string()));
  const std::string chosen = ", deform=" + format_number(deform) + ", step=" + std::to_string(step);
  const std::string solid = "mesh(" + file + chosen + ");\n";
  if (by.empty()) return solid;
  const std::string name = print_json_line(Data(by));
  return "attribute(" + name + ", results(" + file + ", " + name + ", outside=\"nearest\"" + chosen + ").value) " +
         solid;
}

}  // namespace ombre::jobs
