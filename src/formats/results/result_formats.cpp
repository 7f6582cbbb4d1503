#include "formats/results/result_formats.h"

#include <algorithm>

#include "base/text/file_ending.h"
#include "formats/containers/hdf5.h"
#include "formats/containers/text_scanner.h"
#include "formats/results/deck.h"
#include "formats/results/named_grids.h"
#include "formats/results/result_steps.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

bool is_xdmf(std::string_view text) { return text.starts_with('<') && text.find("<Xdmf") != std::string_view::npos; }
bool is_xml(std::string_view text) { return text.starts_with('<'); }
bool is_frd(std::string_view text) { return text.starts_with("1C"); }
bool is_deck(std::string_view text) { return text.starts_with('*'); }
bool is_hdf5(std::string_view text) { return text.starts_with("\x89HDF\r\n"); }
bool is_anything(std::string_view) { return true; }

void refuse_values(const std::string& name, const ResultsBeside& beside, Diagnostics& diagnostics) {
  if (beside.values)
    fail(diagnostics, name, "a table of values belongs to a mesh in an .inp file", "leave \"values\" out");
}

// Formats without steps have one.
void refuse_steps(const std::string& name, const ResultsBeside& beside, Diagnostics& diagnostics) {
  const std::string only;
  step_index(name, {&only, 1}, beside.step, diagnostics);
}

// A format of one file with one step.
template <Results read(const std::string&, std::string_view, Diagnostics&)>
Results read_alone(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                   Diagnostics& diagnostics) {
  refuse_values(name, beside, diagnostics);
  refuse_steps(name, beside, diagnostics);
  return read(name, bytes, diagnostics);
}

Results read_collection(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                        Diagnostics& diagnostics) {
  refuse_values(name, beside, diagnostics);
  return read_pvd(name, bytes, beside, diagnostics);
}

Results read_pieces(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                    Diagnostics& diagnostics) {
  refuse_values(name, beside, diagnostics);
  refuse_steps(name, beside, diagnostics);
  return read_pvtu(name, bytes, beside, diagnostics);
}

Results read_vtkhdf_step(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                         Diagnostics& diagnostics) {
  refuse_values(name, beside, diagnostics);
  return read_vtkhdf(name, bytes, beside.step, diagnostics);
}

Results read_frd_step(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                      Diagnostics& diagnostics) {
  refuse_values(name, beside, diagnostics);
  return read_frd(name, bytes, beside.step, diagnostics);
}

Results read_deck(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                  Diagnostics& diagnostics) {
  refuse_steps(name, beside, diagnostics);
  NumberedResults mesh = read_inp(name, bytes, beside.named, diagnostics);
  if (mesh.results.kinds.empty()) fail(diagnostics, name, "the deck has no solid elements");
  if (beside.values) add_csv_values(beside.values->name, beside.values->bytes, mesh, diagnostics);
  return std::move(mesh.results);
}

}  // namespace

std::span<const ResultFormat> result_formats() {
  static const std::vector<ResultFormat> rows{
      {{"XDMF",
        {".xdmf"},
        Content::results,
        true,
        true,
        nullptr,
        "several grids or spatial collections; elements of other types; references between items; numbers in several "
        "files",
        "points, lines and faces; fields of other places than nodes and cells, or of more than nine numbers"},
       true,
       is_xdmf,
       read_xdmf},
      {{"VTK collection", {".pvd"}, Content::results, true, false, nullptr, "files other than .vtu and .pvtu"},
       true,
       is_pvd,
       read_collection,
       files_named_in_pvd,
       true},
      {{"VTK unstructured grid in pieces", {".pvtu"}, Content::results, true},
       true,
       is_pvtu,
       read_pieces,
       files_named_in_pvtu,
       true},
      {{"VTK unstructured grid",
        {".vtu"},
        Content::results,
        true,
        true,
        nullptr,
        "cells of other types",
        "points, lines and faces; hidden cells and those of other pieces; fields of more than nine numbers"},
       true,
       is_xml,
       read_alone<read_vtu>},
      {{"VTKHDF",
        {".vtkhdf", ".hdf"},
        Content::results,
        true,
        false,
        &hdf5_library,
        "other types than unstructured grids; cells of other types; numbers in other files",
        "points, lines and faces; hidden cells and those of other pieces; fields of more than nine numbers, or of "
        "none"},
       true,
       is_hdf5,
       read_vtkhdf_step},
      {{"CalculiX results",
        {".frd"},
        Content::results,
        true,
        false,
        nullptr,
        "binary files; wedges of 15 nodes",
        "beams and shells"},
       true,
       is_frd,
       read_frd_step},
      {{"Abaqus and CalculiX deck",
        {".inp"},
        Content::elements,
        true,
        true,
        nullptr,
        "keywords that change the mesh and are not known",
        "elements that are neither solids nor shells with a thickness; steps, loads and constraints"},
       true,
       is_deck,
       read_deck,
       files_named_in_deck},
      {{"table of points", {".csv"}, Content::table, true}, false, is_anything, read_alone<read_csv_points>},
  };
  return rows;
}

bool may_name_files(const std::string& path) {
  return std::ranges::any_of(result_formats(),
                             [&](const ResultFormat& row) { return row.named && has_ending(path, row.file); });
}

std::vector<std::string> files_named_in(const std::string& path, std::string_view bytes, uint64_t step,
                                        const std::string& written) {
  for (const ResultFormat& row : result_formats()) {
    if (!row.named || !(has_ending(path, row.file) || row.recognises(without_byte_order_mark(bytes)))) continue;
    std::vector<std::string> names = row.named(bytes, step);
    if (row.names_beside_itself)
      for (std::string& name : names) name = name_beside(written, name);
    return names;
  }
  return {};
}

}  // namespace ombre::formats
