// ombre info: what a grid of numbers in a file holds, and the parameters of an OpenSCAD script.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/json.h"
#include "base/text.h"
#include "compile/attribute_survey.h"
#include "formats/file.h"
#include "lang/openscad/customizer.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/job_arguments.h"
#include "ombre/result_files.h"
#include "sources/volume_parts.h"

namespace ombre::cli {
namespace {

struct ValueCounts {
  double least = 0, greatest = 0;
  std::vector<double> counts;  // of as many equal parts of the range
};

ValueCounts count_values(const formats::VoxelValues& values, size_t parts) {
  return std::visit(
      [&](const auto& list) {
        const auto [least, greatest] = std::ranges::minmax(list);
        ValueCounts result{static_cast<double>(least), static_cast<double>(greatest), std::vector<double>(parts, 0)};
        const double width = result.greatest - result.least;
        for (const auto value : list) {
          const double share = width > 0 ? (static_cast<double>(value) - result.least) / width : 0;
          ++result.counts[std::min(static_cast<size_t>(share * static_cast<double>(parts)), parts - 1)];
        }
        return result;
      },
      values);
}

DataList to_list(Vec3 v) { return {v.x, v.y, v.z}; }

// The step from voxel to voxel along an axis of the grid.
Vec3 step_of(const Affine& map, int axis) { return {map.rows[0][axis], map.rows[1][axis], map.rows[2][axis]}; }

std::string vector_text(Vec3 v) {
  return "(" + format_rounded(v.x, 6) + ", " + format_rounded(v.y, 6) + ", " + format_rounded(v.z, 6) + ")";
}

std::string placement_text(const formats::VoxelVolume& volume) {
  if (!volume.space_from_index) return "  voxels    the file does not say how large they are\n";
  const Affine& map = *volume.space_from_index;
  std::string text = "  voxels    ";
  for (int axis = 0; axis < 3; ++axis) text += (axis > 0 ? " x " : "") + format_rounded(length(step_of(map, axis)), 6);
  text += " mm\n  origin    " + vector_text(map.offset) + " mm, the centre of the first voxel\n";
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = step_of(map, axis);
    text += "  axis " + std::to_string(axis + 1) + "    along " + vector_text((1 / length(step)) * step) + "\n";
  }
  return text;
}

std::string histogram_text(const ValueCounts& values) {
  constexpr double longest_bar = 40;
  const double most = std::ranges::max(values.counts), parts = static_cast<double>(values.counts.size());
  std::string text;
  for (size_t n = 0; n < values.counts.size(); ++n) {
    const double from = values.least + static_cast<double>(n) * (values.greatest - values.least) / parts;
    std::string line = "  " + format_rounded(from, 5);
    line.resize(std::max<size_t>(line.size() + 1, 14), ' ');
    line += format_count(static_cast<unsigned long long>(values.counts[n]));
    line.resize(std::max<size_t>(line.size() + 1, 30), ' ');
    text += line + std::string(static_cast<size_t>(std::ceil(longest_bar * values.counts[n] / most)), '#') + "\n";
  }
  return text;
}

std::string volume_text(const std::string& path, const formats::VoxelVolume& volume, const ValueCounts& values) {
  const auto& [nx, ny, nz] = volume.count;
  return path + ": a volume\n  size      " + std::to_string(nx) + " x " + std::to_string(ny) + " x " +
         std::to_string(nz) + " voxels, " + volume.type + "\n" + placement_text(volume) + "  space     " +
         std::string(formats::name(volume.space)) + "\n  values    " + format_rounded(values.least, 9) + " to " +
         format_rounded(values.greatest, 9) + "\n  Otsu      " + format_rounded(sources::otsu_level(volume.values), 9) +
         ", a level between dark and bright\n\n  from        voxels\n" + histogram_text(values);
}

DataMembers volume_members(const std::string& path, const formats::VoxelVolume& volume, const ValueCounts& values) {
  DataList counts, histogram, steps;
  for (const int64_t count : volume.count) counts.emplace_back(static_cast<double>(count));
  for (const double count : values.counts) histogram.emplace_back(count);
  DataMembers members{{"file", path},
                      {"size", std::move(counts)},
                      {"data_type", volume.type},
                      {"space", std::string(formats::name(volume.space))},
                      {"least", values.least},
                      {"greatest", values.greatest},
                      {"otsu", sources::otsu_level(volume.values)},
                      {"histogram", std::move(histogram)}};
  if (!volume.space_from_index) return members;
  for (int axis = 0; axis < 3; ++axis) steps.emplace_back(to_list(step_of(*volume.space_from_index, axis)));
  members.emplace_back("steps_mm", std::move(steps));
  members.emplace_back("origin_mm", to_list(volume.space_from_index->offset));
  return members;
}

int show_volume(const std::string& path, const std::string& series, Session& session) {
  const sources::ReadFile read = [](const std::string& file) {
    return std::make_shared<const std::string>(formats::read_file(file));
  };
  std::vector<std::string> warnings;
  const formats::VoxelVolume volume =
      sources::read_volume_parts(path, sources::volume_parts(path, read), series, read, &session.stop, warnings);
  Diagnostics remarks;
  for (const std::string& warning : warnings) remarks.warning({}, warning);
  session.console.diagnose(remarks);
  constexpr size_t parts = 16;
  const ValueCounts values = count_values(volume.values, parts);
  if (session.console.voice() == Voice::programs)
    session.console.event("volume", volume_members(path, volume, values));
  else
    session.console.print(volume_text(path, volume, values));
  return done;
}

std::string range_text(const std::optional<Interval>& range) {
  if (!range) return "no values";
  return format_rounded(range->lo, 5) + " to " + format_rounded(range->hi, 5);
}

std::string attributes_text(const std::vector<compile::SurveyedAttribute>& attributes) {
  std::string text;
  for (const compile::SurveyedAttribute& attribute : attributes) {
    const design::AttributeDeclaration& declared = attribute.declaration;
    const std::string unit = declared.unit.empty() || declared.unit == "1" ? "" : ", " + declared.unit;
    text += declared.name + "  " + std::string(design::name(declared.type)) + unit + ", " +
            std::string(design::overlap_names[static_cast<size_t>(declared.overlap)]) + " where solids meet";
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
  for (const auto& [part, range] : attribute.ranges)
    numbers.emplace_back(part, range ? Data(DataList{range->lo, range->hi}) : Data());
  return DataMembers{{"name", declared.name},
                     {"type", std::string(design::name(declared.type))},
                     {"unit", declared.unit},
                     {"default", declared.default_value},
                     {"overlap", std::string(design::overlap_names[static_cast<size_t>(declared.overlap)])},
                     {"values", std::move(numbers)}};
}

int show_design(const std::string& path, Session& session) {
  Diagnostics diagnostics;
  const compile::LoadedPtr loaded = load_design({path, "", {}}, session, diagnostics);
  const auto attributes = loaded ? compile::survey_attributes(*loaded, diagnostics) : std::nullopt;
  session.console.diagnose(diagnostics);
  if (!attributes) return wrong_input;
  DataList list;
  for (const compile::SurveyedAttribute& attribute : *attributes) list.push_back(attribute_data(attribute));
  if (session.console.voice() == Voice::programs)
    session.console.event("design", {{"file", path}, {"attributes", std::move(list)}});
  else
    session.console.print(attributes->empty() ? "the design has no attributes\n" : attributes_text(*attributes));
  return done;
}

bool is_design(const std::string& path) {
  const std::string ending = to_lower(std::filesystem::path(path).extension().string());
  return ending == ".vcad" || ending == ".py" || ending == ".json";
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
  if (session.console.voice() == Voice::programs) {
    DataList list;
    for (const auto& parameter : parameters) list.emplace_back(lang::openscad::to_data(parameter));
    session.console.event("script", {{"file", path}, {"parameters", std::move(list)}});
    return done;
  }
  std::string text = path + ": an OpenSCAD script with " + std::to_string(parameters.size()) + " parameters\n", section;
  for (const auto& parameter : parameters) {
    if (parameter.section == "Hidden") continue;
    if (parameter.section != section) text += "\n  [" + (section = parameter.section) + "]\n";
    text += parameter_text(parameter);
  }
  session.console.print(text);
  return done;
}

int show_file(const std::string& path, const std::string& series, Session& session) {
  if (path.ends_with(".scad")) return show_script(path, session);
  if (is_results(path) || is_xdmf(path)) return show_results(path, session);
  return is_design(path) ? show_design(path, session) : show_volume(path, series, session);
}

}  // namespace

Command add_info(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand(
      "info",
      "Say what a volume (a scan, a grid) holds: size, voxels, orientation, values and how often they occur; or which "
      "attributes a design gives, with type, unit and range; or which fields the results of a simulation have; or "
      "which "
      "parameters an OpenSCAD script has");
  auto file = std::make_shared<std::string>(), series = std::make_shared<std::string>();
  app->add_option(
         "file", *file,
         "A volume: a folder of DICOM files or PNG images, .dcm, .nii, .nrrd, .mha, .vdb, .npy, or raw numbers "
         "with a .json beside them; or a design, or a script: .scad; or results: .vtu, .frd, .inp")
      ->required()
      ->type_name("FILE");
  app->add_option("--series", *series, "Of several DICOM series, its number or UID; of several grids, its name")
      ->type_name("NAME");
  add_output_options(*app, output);
  app->footer("Examples:\n  ombre info models/two_lobes.nrrd\n  ombre info part.vcad\n  ombre info seat.vtu\n");
  return {app, [file, series](Session& session) { return show_file(*file, *series, session); }};
}

}  // namespace ombre::cli
