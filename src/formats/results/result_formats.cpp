#include "formats/results/result_formats.h"

#include "formats/containers/text_scanner.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

bool is_xdmf(std::string_view text) { return text.starts_with('<') && text.find("<Xdmf") != std::string_view::npos; }
bool is_xml(std::string_view text) { return text.starts_with('<'); }
bool is_frd(std::string_view text) { return text.starts_with("1C"); }
bool is_deck(std::string_view text) { return text.starts_with('*'); }
bool is_anything(std::string_view) { return true; }

// A format of one file.
template <Results read(const std::string&, std::string_view, Diagnostics&)>
Results read_alone(const std::string& name, std::string_view bytes, const std::optional<ResultsFile>& values,
                   Diagnostics& diagnostics) {
  if (values) fail(diagnostics, name, "a table of values belongs to a mesh in an .inp file", "leave \"values\" out");
  return read(name, bytes, diagnostics);
}

Results read_deck(const std::string& name, std::string_view bytes, const std::optional<ResultsFile>& values,
                  Diagnostics& diagnostics) {
  NumberedResults mesh = read_inp(name, bytes, diagnostics);
  if (mesh.results.kinds.empty()) fail(diagnostics, name, "the deck has no solid elements");
  if (values) add_csv_values(values->name, values->bytes, mesh, diagnostics);
  return std::move(mesh.results);
}

}  // namespace

std::span<const ResultFormat> result_formats() {
  static const std::vector<ResultFormat> rows{
      {{"XDMF", {".xdmf"}, Content::results, true, true}, true, is_xdmf, read_xdmf},
      {{"VTK unstructured grid", {".vtu"}, Content::results, true, true}, true, is_xml, read_alone<read_vtu>},
      {{"CalculiX results", {".frd"}, Content::results, true}, true, is_frd, read_alone<read_frd>},
      {{"Abaqus and CalculiX deck", {".inp"}, Content::elements, true, true}, true, is_deck, read_deck},
      {{"table of points", {".csv"}, Content::table, true}, false, is_anything, read_alone<read_csv_points>},
  };
  return rows;
}

}  // namespace ombre::formats
