// `ombre info` describes files with volumes, results and designs, and the parameters of an OpenSCAD script.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/text/file_ending.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/info/file_summary.h"
#include "jobs/info/map_reports.h"
#include "jobs/info/mesh_coverage.h"
#include "jobs/info/result_files.h"
#include "jobs/info/volume_info.h"
#include "lang/openscad/customizer.h"
#include "questions/attribute_survey.h"

namespace ombre::jobs {
namespace {

std::string range_text(const std::optional<Interval>& range) {
  if (!range) return "no values";
  return format_rounded(range->lo, 5) + " to " + format_rounded(range->hi, 5);
}

// Returns a text such as "1 lid, 2 bottom".
std::string labels_text(const std::vector<std::string>& labels) {
  std::vector<std::string> numbered;
  for (size_t n = 0; n < labels.size(); ++n) numbered.push_back(std::to_string(n + 1) + " " + labels[n]);
  return join(numbered, ", ");
}

std::string attributes_text(const std::vector<compile::SurveyedAttribute>& attributes) {
  std::string text;
  for (const compile::SurveyedAttribute& attribute : attributes) {
    const design::AttributeDeclaration& declared = attribute.declaration;
    const std::string unit = declared.unit.empty() || declared.unit == "1" ? "" : ", " + declared.unit;
    text += declared.name + "  " + std::string(design::name(declared.type)) + unit + ", " +
            std::string(design::overlap_names[static_cast<size_t>(declared.overlap)]) + " where solids meet";
    if (declared.type == design::ValueType::label) {
      text += ": " + labels_text(declared.labels) + "\n";
      continue;
    }
    if (attribute.ranges.size() == 1) {
      text += ", " + range_text(attribute.ranges[0].second) + "\n";
      continue;
    }
    text += '\n';
    for (const auto& [part, range] : attribute.ranges) text += "  " + part + "  " + range_text(range) + "\n";
  }
  return text;
}

Data attribute_data(const compile::SurveyedAttribute& attribute) {
  const design::AttributeDeclaration& declared = attribute.declaration;
  DataMembers numbers;
  const DataList labels(declared.labels.begin(), declared.labels.end());
  for (const auto& [part, range] : attribute.ranges)
    numbers.emplace_back(part, range ? Data(DataList{range->lo, range->hi}) : Data());
  return DataMembers{{"name", declared.name},
                     {"type", std::string(design::name(declared.type))},
                     {"unit", declared.unit},
                     {"default", declared.default_value},
                     {"overlap", std::string(design::overlap_names[static_cast<size_t>(declared.overlap)])},
                     {"labels", labels},
                     {"values", std::move(numbers)}};
}

// Returns a line such as "results seat.vtu  99.2 % of the design's volume lies in the mesh".
std::string coverage_text(const std::vector<compile::MeshCoverage>& coverage) {
  std::string text;
  for (const compile::MeshCoverage& mesh : coverage)
    text +=
        "results " + mesh.file + "  " +
        (mesh.share ? "about " + format_rounded(100 * *mesh.share, 3) + " % of the design's volume lies in the mesh\n"
                    : std::string("no sample lies in the design\n"));
  return text;
}

DataList coverage_data(const std::vector<compile::MeshCoverage>& coverage) {
  DataList list;
  for (const compile::MeshCoverage& mesh : coverage)
    list.emplace_back(DataMembers{{"file", mesh.file}, {"share_in_mesh", mesh.share ? Data(*mesh.share) : Data()}});
  return list;
}

// Nodes that give a report of themselves, such as maps of cells, with the line of the script that makes them.
struct NodeReport {
  std::string node, text;
  int line = 0;  // 0 if unknown
};

std::vector<NodeReport> reports_of(const design::Design& design) {
  std::vector<NodeReport> reports;
  for (const design::Node* node : design::topological(design.roots())) {
    const auto number = node->type().output("report");
    if (!number || !node->gives(*number)) continue;
    const Data text = node->constant(*number);
    if (!text.string()) continue;
    const SourceRange& where = node->where();
    const int line = where.source ? where.source->place(where.begin).line : 0;
    reports.push_back({node->type().name, *text.string(), line});
  }
  return reports;
}

std::string report_text(const std::string& node, int line, const std::string& text) {
  return node + (line > 0 ? ", line " + std::to_string(line) : "") + "  " + text + "\n";
}

std::string reports_text(const std::vector<NodeReport>& reports) {
  std::string text;
  for (const NodeReport& report : reports) text += report_text(report.node, report.line, report.text);
  return text;
}

std::string maps_text(const std::vector<compile::MapReport>& maps) {
  std::string text;
  for (const compile::MapReport& map : maps) text += report_text(map.node, map.line, map.text());
  return text;
}

DataList maps_data(const std::vector<compile::MapReport>& maps) {
  DataList list;
  for (const compile::MapReport& map : maps) list.emplace_back(map.data());
  return list;
}

DataList reports_data(const std::vector<NodeReport>& reports) {
  DataList list;
  for (const NodeReport& report : reports)
    list.emplace_back(
        DataMembers{{"node", report.node}, {"line", static_cast<double>(report.line)}, {"report", report.text}});
  return list;
}

int show_design(const std::string& path, Session& session) {
  Diagnostics diagnostics;
  const compile::LoadedPtr loaded = load_design({.design = path}, session, diagnostics);
  const auto attributes = loaded ? compile::survey_attributes(loaded->design, diagnostics) : std::nullopt;
  const auto coverage = attributes ? compile::survey_coverage(*loaded, diagnostics) : std::nullopt;
  session.events.diagnose(diagnostics);
  if (!coverage) return wrong_input;
  const std::vector<NodeReport> reports = reports_of(loaded->design);
  const std::vector<compile::MapReport> maps = compile::map_reports_of(loaded->design);
  DataList list;
  for (const compile::SurveyedAttribute& attribute : *attributes) list.push_back(attribute_data(attribute));
  if (session.events.wants_data())
    session.events.event("design", {{"file", path},
                                    {"attributes", std::move(list)},
                                    {"results", coverage_data(*coverage)},
                                    {"reports", reports_data(reports)},
                                    {"maps", maps_data(maps)}});
  else
    session.events.print((attributes->empty() ? "the design has no attributes\n" : attributes_text(*attributes)) +
                         coverage_text(*coverage) + reports_text(reports) + maps_text(maps));
  return done;
}

bool is_design(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".vcad" || ending == ".py" || ending == ".json" || ending == ".ombre";
}

std::string parameter_text(const lang::openscad::Parameter& parameter) {
  std::string text = "  " + parameter.name;
  text.resize(std::max<size_t>(text.size() + 1, 22), ' ');
  text += print_json_line(parameter.value);
  if (parameter.least || parameter.most)
    text += "  (" + (parameter.least ? format_number(*parameter.least) : std::string()) + " to " +
            (parameter.most ? format_number(*parameter.most) : std::string()) + ")";
  for (size_t n = 0; n < parameter.choices.size(); ++n) text += (n == 0 ? "  of " : ", ") + parameter.choices[n].second;
  return text + (parameter.description.empty() ? "" : "  " + parameter.description) + '\n';
}

int show_script(const std::string& path, Session& session) {
  const auto parameters = lang::openscad::parameters_of(make_source(path, formats::read_file(path)));
  if (session.events.wants_data()) {
    DataList list;
    for (const auto& parameter : parameters) list.emplace_back(lang::openscad::to_data(parameter));
    session.events.event("script", {{"file", path}, {"parameters", std::move(list)}});
    return done;
  }
  std::string text = path + ": an OpenSCAD script with " + std::to_string(parameters.size()) + " parameters\n", section;
  for (const auto& parameter : parameters) {
    if (parameter.section == "Hidden") continue;
    if (parameter.section != section) text += "\n  [" + (section = parameter.section) + "]\n";
    text += parameter_text(parameter);
  }
  session.events.print(text);
  return done;
}

void refuse_options_of_results(const InfoChoices& a) {
  for (const auto& [name, is_given] : {std::pair("--step", a.step > 0), std::pair("--values", !a.values.empty())})
    if (is_given)
      throw WrongArgument(spelled::option(name) + " is for results; leave it out, or write for example ombre info " +
                          "seat.pvd " + spelled::option("--step", "2"));
}

int show_file(const InfoChoices& a, Session& session) {
  const std::string& path = a.file;
  if (path.ends_with(".scad")) return show_script(path, session);
  if (is_results(path)) return show_results(a, session);
  refuse_options_of_results(a);
  const bool is_volume =
      a.as_volume || !a.picture.empty() || !a.series.empty() || a.channel >= 0 || a.phase > 0 || a.nan || a.is_regular;
  if (const auto content = summarised_content(path); content && !is_volume)
    return show_summary(path, *content, session);
  return is_design(path) ? show_design(path, session) : show_volume(a, session);
}

}  // namespace

JobKind info_kind() {
  return job_kind<InfoChoices>(
      "info", "Say what a file holds: a design, or any file that designs read",
      "For a volume (a scan, a grid) it prints size, voxels, orientation, values and how often they occur. For a\n"
      "design it prints attributes with type, unit and range, the share that lies in the meshes of its results, and\n"
      "what maps of cells on surfaces stretch;\n"
      "for results of a simulation elements and fields, and for an OpenSCAD script the parameters. For a mesh it "
      "prints\n"
      "triangles, volume, whether it is closed, parts and colours; for a CAD file its solids; for a drawing its "
      "regions\n"
      "and area; for a table and an image their size and values.\n\n"
      "Examples:\n  ombre info models/two_lobes.nrrd\n  ombre info scan/ --picture planes.png\n  ombre info "
      "part.vcad\n  ombre info seat.vtu\n",
      show_file);
}

}  // namespace ombre::jobs
