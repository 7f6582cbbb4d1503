#include "studio/data_scripts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>

#include "base/math/box.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "design/attributes.h"
#include "formats/results/results.h"
#include "sources/file_formats.h"
#include "sources/files_of_results.h"
#include "studio/designs.h"
#include "studio/scans.h"
#include "studio/workspace/data_files.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> vector_words{"x", "y", "z"};
constexpr std::array<std::string_view, 6> tensor_words{"xx", "yy", "zz", "xy", "yz", "zx"};

std::string quoted(const std::string& text) { return print_json_line(Data(text)); }

formats::Results read_results(const std::string& path) {
  Diagnostics diagnostics;
  auto results = sources::read_results(path, diagnostics);
  if (!results) throw design_error(diagnostics);
  return std::move(*results);
}

// Rounds up to 1, 2 or 5 times a power of ten.
double round_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

// Returns the factor by which the displacement moves the mesh by a quarter of its size; null if there is no
// displacement.
std::optional<double> greatest_deform(const formats::Results& results) {
  const formats::ResultField* field = formats::find_field(results, "displacement");
  if (!field || field->components != 3 || field->is_of_elements) return std::nullopt;
  Box box;
  for (const Vec3& point : results.points) box = hull(box, Box{point, point});
  double most = 0;
  for (const double value : field->values) most = std::max(most, std::abs(value));
  if (!(most > 0) || !std::isfinite(most)) return std::nullopt;
  return round_up(std::max(1.0, length(box.size()) / 4 / most));
}

// Writes the lines that name each number of each field.
class FieldLines {
 public:
  FieldLines(std::string file, bool is_deformed) : file_(std::move(file)), is_deformed_(is_deformed) {}

  void add(const formats::ResultField& field) {
    if (!std::ranges::all_of(field.values, [](double v) { return std::isfinite(v); })) return;
    if (field.components == 1 || field.components == 3) add_line(field, "");
    if (field.components == 3)
      for (const std::string_view word : vector_words) add_line(field, word);
    if (field.components == 6)
      for (const std::string_view word : tensor_words) add_line(field, word);
  }
  const std::string& text() const { return text_; }

 private:
  // Returns a name that formulas can use; a name with a predefined meaning is used only with the unit of that meaning.
  std::string name_for(const formats::ResultField& field, std::string_view component) {
    std::string name;
    for (const char c : field.name) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) name = "field_" + name;
    if (!component.empty()) name += "_" + std::string(component);
    const design::StandardAttribute* standard = design::standard_attribute(name);
    if (standard && standard->unit != field.unit) name += "_of_results";
    while (!names_.insert(name).second) name += "_";
    return name;
  }

  void add_line(const formats::ResultField& field, std::string_view component) {
    text_ += "attribute(" + quoted(name_for(field, component)) + ", results(" + file_ + ", " + quoted(field.name);
    if (!component.empty()) text_ += ", component=" + quoted(std::string(component));
    text_ += std::string(", outside=\"nearest\"") + (is_deformed_ ? ", deform=deform" : "") + ").value";
    if (!field.unit.empty()) text_ += ", unit=" + quoted(field.unit);
    text_ += ")\n";
  }

  std::string file_;
  bool is_deformed_;
  std::set<std::string> names_;
  std::string text_;
};

// How designs read files whose contents decide nothing about the script.
struct Import {
  Content content;
  std::string_view ending;  // of the design
  std::string_view before, after;
};
constexpr std::array<Import, 4> imports{{
    {Content::mesh, ".vcad", "// A mesh.\n\nmesh(", ", \"gray\");\n"},
    {Content::cad, ".vcad", "// A solid from a CAD file.\n\ncad(", ", \"gray\");\n"},
    {Content::image, ".vcad",
     "// A plate that is higher where an image is brighter.\n\nwidth = 40;  // [5:200]\nheight = 2;  // [0.1:0.1:20]\n"
     "base = 1;  // [0.1:0.1:10]\n\nrelief(",
     ", width, height, base, \"gray\");\n"},
    {Content::drawing, ".scad",
     "// A plate from a drawing.\n\nheight = 2;  // [0.1:0.1:50]\n\nlinear_extrude(height) import(", ");\n"},
}};

const Import* import_of(const std::string& name) {
  const auto found =
      std::ranges::find_if(imports, [&](const Import& row) { return sources::is_read_as(name, row.content); });
  return found == imports.end() ? nullptr : &*found;
}

bool is_scan(const std::string& name, const fs::path& path) {
  return data_kind(name) == DataKind::scan || is_dicom_folder(path);
}

}  // namespace

bool can_be_imported(const std::string& name) {
  const DataKind kind = data_kind(name);
  return kind == DataKind::scan || kind == DataKind::results || import_of(name) != nullptr;
}

ImportingDesign importing_design(const std::string& name, const fs::path& path) {
  if (is_scan(name, path)) return {".vcad", script_for_scan(name, path)};
  if (data_kind(name) == DataKind::results) return {".vcad", script_for_results(name, path)};
  const Import* import = import_of(name);
  if (!import) throw RequestError("unsupported", "no node reads files like " + name);
  const std::string file = quoted(fs::path(name).filename().string());
  return {std::string(import->ending), std::string(import->before) + file + std::string(import->after)};
}

std::string script_for_scan(const std::string& name, const fs::path& path) {
  const Scan scan = read_scan(path.string(), {}, nullptr);
  const double width = scan.range.hi - scan.range.lo;
  const double step = width > 0 ? std::pow(10, std::floor(std::log10(width / 100))) : 1;
  const std::string file = quoted(fs::path(name).filename().string());
  return "// The solid in a scan where values reach a level.\n\nlevel = " +
         format_number(step * std::round(scan.otsu / step)) + ";  // [" + format_number(scan.range.lo) + ":" +
         format_number(step) + ":" + format_number(scan.range.hi) + "]\n\nvolume_solid(" + file + ", level=level);\n";
}

std::string script_for_results(const std::string& name, const fs::path& path) {
  const formats::Results results = read_results(path.string());
  const std::string file = quoted(fs::path(name).filename().string());
  const auto most = greatest_deform(results);
  std::string text = "// Results of a simulation: \"Colour by\" shows their numbers.\n";
  if (most)
    text += "// How many times the displacement moves the mesh\ndeform = 0;  // [0:" + format_number(*most / 200) +
            ":" + format_number(*most) + "]\n";
  FieldLines lines(file, most.has_value());
  for (const formats::ResultField& field : results.fields) lines.add(field);
  return text + "\n" + lines.text() + "mesh(" + file + (most ? ", deform=deform" : "") + ");\n";
}

}  // namespace ombre::studio
