// Reads files that name unstructured grids of VTK: collections of steps and parts (.pvd), and grids in pieces (.pvtu).
#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/containers/xml_file.h"
#include "formats/results/named_grids.h"
#include "formats/results/result_steps.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

// Appends the values of a part, which has so many points or elements behind those before it.
void append_field(std::vector<ResultField>& fields, ResultField part, size_t before) {
  const auto found = std::ranges::find_if(fields, [&](const ResultField& field) {
    return field.name == part.name && field.is_of_elements == part.is_of_elements &&
           field.components == part.components && field.values.size() <= before * field.components;
  });
  if (found == fields.end()) {
    part.values.insert(part.values.begin(), before * part.components, std::nan(""));
    fields.push_back(std::move(part));
    return;
  }
  found->values.resize(before * found->components, std::nan(""));
  found->values.insert(found->values.end(), part.values.begin(), part.values.end());
}

// Appends a part. Points that parts share stay separate: each element is interpolated from its own nodes, and the outer
// sides of each part are closed by themselves.
void append(Results& all, Results part) {
  const size_t points = all.points.size(), elements = all.kinds.size(), nodes = all.nodes.size();
  all.points.insert(all.points.end(), part.points.begin(), part.points.end());
  all.kinds.insert(all.kinds.end(), part.kinds.begin(), part.kinds.end());
  for (const uint64_t first : part.first) all.first.push_back(nodes + first);
  for (const uint32_t node : part.nodes) all.nodes.push_back(static_cast<uint32_t>(points + node));
  all.left_out.insert(all.left_out.end(), part.left_out.begin(), part.left_out.end());
  for (ResultField& field : part.fields) {
    const size_t before = field.is_of_elements ? elements : points;
    append_field(all.fields, std::move(field), before);
  }
}

class NamedGrids {
 public:
  NamedGrids(const std::string& name, std::string_view bytes, const ResultsBeside& beside, Diagnostics& diagnostics)
      : name_(name), bytes_(bytes), beside_(beside), diagnostics_(diagnostics) {}

  Results of_collection() {
    const XmlFile file(name_, bytes_, diagnostics_);
    std::map<double, std::vector<xml_node>> steps;
    for (const xml_node set : file.root("VTKFile").child("Collection").children("DataSet"))
      steps[file.number(set, file.attribute(set, "timestep").value_or("0"), "a time")].push_back(set);
    std::vector<std::string> times;
    for (const auto& [time, sets] : steps) times.push_back(format_number(time));
    const size_t wanted = step_index(name_, times, beside_.step, diagnostics_);
    set_steps(results_, times, wanted);
    for (const xml_node set : std::next(steps.begin(), static_cast<ptrdiff_t>(wanted))->second) {
      const ResultsFile& grid = file_called(file, set, std::string(file.required(set, "file")));
      if (is_pvtu(without_byte_order_mark(grid.bytes)))
        add_pieces(grid.name, grid.bytes, grid.written);
      else
        add_grid(grid);
    }
    return std::move(results_);
  }

  Results of_pieces() {
    add_pieces(name_, bytes_, "");
    return std::move(results_);
  }

 private:
  // `written` is the name of the file of pieces in the collection; empty for the first file.
  void add_pieces(const std::string& name, std::string_view bytes, const std::string& written) {
    const XmlFile file(name, bytes, diagnostics_);
    for (const xml_node piece : file.root("VTKFile").child("PUnstructuredGrid").children("Piece"))
      add_grid(file_called(file, piece, name_beside(written, std::string(file.required(piece, "Source")))));
  }

  const ResultsFile& file_called(const XmlFile& file, xml_node node, const std::string& wanted) const {
    const auto found = std::ranges::find(beside_.named, wanted, &ResultsFile::written);
    if (found == beside_.named.end())
      file.fail_at(node, "the file " + formats::quoted(wanted) + " that is named here is not there",
                   "put it beside this file, under that name");
    return *found;
  }

  void add_grid(const ResultsFile& grid) {
    Results part = read_vtu(grid.name, grid.bytes, diagnostics_);
    if (results_.points.size() + part.points.size() > UINT32_MAX)
      fail(diagnostics_, name_, "the parts have more than 4294967295 points");
    append(results_, std::move(part));
  }

  const std::string& name_;
  std::string_view bytes_;
  const ResultsBeside& beside_;
  Diagnostics& diagnostics_;
  Results results_;
};

}  // namespace

Results read_pvd(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                 Diagnostics& diagnostics) {
  return NamedGrids(name, bytes, beside, diagnostics).of_collection();
}

Results read_pvtu(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                  Diagnostics& diagnostics) {
  return NamedGrids(name, bytes, beside, diagnostics).of_pieces();
}

}  // namespace ombre::formats

#endif
