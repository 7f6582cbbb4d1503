// Reads unstructured grids in VTK's XML files (.vtu).
#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"
#include "formats/results/results_readers.h"
#include "formats/volumes/vtk_arrays.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

constexpr size_t most_fields = 1000, most_components = 9;

// The supported elements, by VTK's numbers.
struct CellKind {
  double type;
  ElementKind kind;
  bool has_crossed_rows = false;  // nodes are ordered by x, then y, then z
};
// Lagrange cells (71, 72) of the first order, and tetrahedra of the second, have the nodes of others.
const std::vector<CellKind>& cell_kinds() {
  static const std::vector<CellKind> rows{
      {10, ElementKind::tetrahedron4},  {11, ElementKind::brick8, true}, {12, ElementKind::brick8},
      {24, ElementKind::tetrahedron10}, {25, ElementKind::brick20},      {71, ElementKind::tetrahedron4},
      {71, ElementKind::tetrahedron10}, {72, ElementKind::brick8},       {13, ElementKind::wedge6},
      {73, ElementKind::wedge6},        {14, ElementKind::pyramid5},     {74, ElementKind::pyramid5}};
  return rows;
}
// Returns the row of the type, of several rows that with so many nodes; null if there is none.
const CellKind* cell_kind(double type, double nodes) {
  const CellKind* of_type = nullptr;
  for (const CellKind& row : cell_kinds()) {
    if (row.type != type) continue;
    of_type = &row;
    if (static_cast<double>(node_count(row.kind)) == nodes) break;
  }
  return of_type;
}
// Returns true for points, lines and faces, which have no volume.
bool is_flat_cell(double type) {
  return (type >= 0 && type <= 9) || (type >= 21 && type <= 23) || type == 28 || type == 30 ||
         (type >= 34 && type <= 36) || (type >= 68 && type <= 70);
}

class VtuReader {
 public:
  VtuReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : arrays_(name, bytes, diagnostics), file_(arrays_.file()), bytes_(bytes) {}

  Results run() {
    const xml_node root = file_.root("VTKFile");
    if (file_.required(root, "type") != "UnstructuredGrid")
      file_.fail_at(root, "this file holds no unstructured grid but " + formats::quoted(file_.required(root, "type")),
                    "save the results as .vtu");
    arrays_.read_settings(root);
    for (const xml_node piece : root.child("UnstructuredGrid").children("Piece")) add_piece(piece);
    warn_of_left_out();
    return std::move(results_);
  }

 private:
  void add_piece(xml_node piece) {
    const size_t points = results_.points.size(), before = results_.kinds.size();
    const uint64_t point_count = file_.count(piece, file_.required(piece, "NumberOfPoints"), "a count of points"),
                   cell_count = file_.count(piece, file_.required(piece, "NumberOfCells"), "a count of cells");
    if (point_count > bytes_.size() * 1032 || cell_count > bytes_.size() * 1032 || points + point_count > UINT32_MAX)
      file_.fail_at(piece, "the piece states more points or cells than the file can hold");
    if (point_count == 0) return;
    add_points(piece, point_count);
    const std::vector<bool> is_kept = add_cells(piece, points, point_count, cell_count);
    add_fields(piece.child("PointData"), false, points, std::vector<bool>(point_count, true));
    add_fields(piece.child("CellData"), true, before, is_kept);
  }

  void add_points(xml_node piece, uint64_t count) {
    const xml_node array = piece.child("Points").child("DataArray");
    if (!array) file_.fail_at(piece, "the piece has no points");
    const std::vector<double> numbers = numbers_of(array, 3 * count);
    for (size_t n = 0; n < count; ++n) {
      const Vec3 p{numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]};
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(p[axis]) <= greatest_coordinate))
          file_.fail_at(array, "point " + std::to_string(n) + " has a coordinate that is not finite or beyond 1e15");
      results_.points.push_back(p);
    }
  }

  xml_node array_called(xml_node parent, std::string_view name) const {
    for (const xml_node array : parent.children("DataArray"))
      if (array.attribute("Name").value() == name) return array;
    file_.fail_at(parent, "expected an array " + formats::quoted(name) + " among the cells");
  }

  // Returns which cells belong to another piece, or are hidden, by the bits of vtkDataSetAttributes::CellGhostTypes.
  std::vector<bool> ghosts_of(xml_node piece, uint64_t count) const {
    constexpr unsigned duplicate = 1, hidden = 32;
    std::vector<bool> is_ghost(count, false);
    for (const xml_node array : piece.child("CellData").children("DataArray")) {
      if (array.attribute("Name").value() != std::string_view("vtkGhostType")) continue;
      const std::vector<double> bits = numbers_of(array, count);
      for (size_t n = 0; n < count; ++n)
        is_ghost[n] = bits[n] > 0 && bits[n] < 256 && (static_cast<unsigned>(bits[n]) & (duplicate | hidden)) != 0;
    }
    return is_ghost;
  }

  // Adds the cells of a piece; returns which of them became elements.
  std::vector<bool> add_cells(xml_node piece, size_t first_point, uint64_t point_count, uint64_t count) {
    std::vector<bool> is_kept(count, false);
    const xml_node cells = piece.child("Cells");
    if (count == 0) return is_kept;
    const std::vector<double> types = numbers_of(array_called(cells, "types"), count),
                              ends = numbers_of(array_called(cells, "offsets"), count);
    const xml_node list = array_called(cells, "connectivity");
    if (!(ends.back() >= 0 && ends.back() <= static_cast<double>(bytes_.size()) * 1032))
      file_.fail_at(list, "the offsets of cells go beyond the file");
    const std::vector<double> corners = numbers_of(list, static_cast<uint64_t>(ends.back()));
    std::array<uint32_t, 20> nodes{};
    const std::vector<bool> is_ghost = ghosts_of(piece, count);
    for (size_t n = 0; n < count; ++n) {
      if (is_ghost[n]) {
        ++ghost_cells_;
        continue;
      }
      const double begin = n == 0 ? 0 : ends[n - 1];
      const CellKind* const kind = cell_kind(types[n], ends[n] - begin);
      if (!kind && is_flat_cell(types[n])) {
        ++flat_cells_;
        continue;
      }
      if (!kind)
        file_.fail_at(list, "cell " + std::to_string(n) + " is of VTK's type " + format_number(types[n]) +
                                "; read are tetrahedra (10, 24, 71), hexahedra (12, 25, 72), voxels (11), wedges (13, "
                                "73) and pyramids (14, 74)");
      const size_t size = node_count(kind->kind);
      if (!(begin >= 0) || begin + static_cast<double>(size) != ends[n] || ends[n] > ends.back())
        file_.fail_at(list,
                      "cell " + std::to_string(n) + " has not the " + std::to_string(size) + " nodes of its type");
      for (size_t c = 0; c < size; ++c) {
        const double node = corners[static_cast<size_t>(begin) + c];
        if (!(node >= 0 && node < static_cast<double>(point_count)))
          file_.fail_at(list, "cell " + std::to_string(n) + " names point " + format_number(node) + "; there are " +
                                  std::to_string(point_count));
        nodes[c] = static_cast<uint32_t>(first_point + static_cast<size_t>(node));
      }
      if (kind->has_crossed_rows) {
        std::swap(nodes[2], nodes[3]);
        std::swap(nodes[6], nodes[7]);
      }
      results_.add_element(kind->kind, nodes.data());
      is_kept[n] = true;
    }
    return is_kept;
  }

  // Adds the fields of a piece; `before` is the number of nodes or elements of earlier pieces.
  void add_fields(xml_node parent, bool is_of_elements, size_t before, const std::vector<bool>& is_kept) {
    for (const xml_node array : parent.children("DataArray")) {
      if (file_.attribute(array, "type") == "String") continue;
      ResultField field;
      set_name(field, file_.attribute(array, "Name").value_or("values"));
      field.is_of_elements = is_of_elements;
      field.components =
          file_.count(array, file_.attribute(array, "NumberOfComponents").value_or("1"), "a number of components");
      if (field.components < 1 || field.components > most_components) {
        wide_fields_.insert(field.name);
        continue;
      }
      const std::vector<double> numbers = numbers_of(array, field.components * is_kept.size());
      ResultField& all = field_of(field, before);
      for (size_t n = 0; n < is_kept.size(); ++n)
        if (is_kept[n])
          all.values.insert(all.values.end(), numbers.begin() + static_cast<ptrdiff_t>(n * field.components),
                            numbers.begin() + static_cast<ptrdiff_t>((n + 1) * field.components));
    }
    fill_up(is_of_elements);
  }

  // Returns the field of the same name in earlier pieces, or a new one without values for them.
  ResultField& field_of(const ResultField& wanted, size_t before) {
    for (ResultField& field : results_.fields)
      if (field.name == wanted.name && field.is_of_elements == wanted.is_of_elements &&
          field.components == wanted.components && field.values.size() == before * wanted.components)
        return field;
    if (results_.fields.size() >= most_fields) fail_fields();
    results_.fields.push_back(wanted);
    results_.fields.back().values.assign(before * wanted.components, std::nan(""));
    return results_.fields.back();
  }

  [[noreturn]] void fail_fields() const {
    fail(file_.diagnostics(), file_.name(), "the file has more than " + std::to_string(most_fields) + " fields");
  }

  void fill_up(bool is_of_elements) {
    const size_t count = is_of_elements ? results_.kinds.size() : results_.points.size();
    for (ResultField& field : results_.fields)
      if (field.is_of_elements == is_of_elements) field.values.resize(count * field.components, std::nan(""));
  }

  void warn_of_left_out() const {
    const auto warn = [&](const std::string& what) {
      file_.diagnostics().warning({make_source(file_.name(), ""), 0, 0}, what + " are left out");
    };
    if (flat_cells_ > 0) warn(format_count(flat_cells_) + " points, lines or faces of the grid");
    if (ghost_cells_ > 0) warn(format_count(ghost_cells_) + " cells that are hidden, or belong to another piece,");
    if (!wide_fields_.empty())
      warn("fields of more than " + std::to_string(most_components) + " numbers (" +
           join(std::vector<std::string>(wide_fields_.begin(), wide_fields_.end()), ", ") + ")");
  }

  std::vector<double> numbers_of(xml_node array, uint64_t count) const { return arrays_.numbers(array, count); }

  VtkArrays arrays_;
  const XmlFile& file_;
  std::string_view bytes_;
  Results results_;
  uint64_t flat_cells_ = 0, ghost_cells_ = 0;
  std::set<std::string> wide_fields_;  // names
};

}  // namespace

Results read_vtu(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return VtuReader(name, bytes, diagnostics).run();
}

}  // namespace ombre::formats

#endif
