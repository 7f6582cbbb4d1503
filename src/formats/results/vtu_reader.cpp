// Reads unstructured grids in VTK's XML files (.vtu).
#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"
#include "formats/results/polyhedra.h"
#include "formats/results/results_readers.h"
#include "formats/volumes/vtk_arrays.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

constexpr size_t most_fields = 1000, most_components = 9;
constexpr double polyhedron_type = 42;

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
    PolyhedronCutter cutter(results_);
    const std::vector<uint32_t> elements = add_cells(piece, points, point_count, cell_count, cutter);
    add_fields(piece.child("PointData"), false, points, std::vector<uint32_t>(point_count, 1));
    add_fields(piece.child("CellData"), true, before, elements);
    for (ResultField& field : results_.fields)
      if (!field.is_of_elements) cutter.fill(field);
    folded_ += cutter.folded();
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

  // The lists of faces of a piece's polyhedra, as numbers in the file.
  struct FaceLists {
    xml_node place;                                  // for messages
    std::vector<std::vector<double>> faces_of_cell;  // by cell: the number of faces, then of each its size and points
  };

  // Reads the lists of faces, by cell: each end lies in "faceoffsets", which is -1 for other cells.
  FaceLists faces_of(xml_node cells, const std::vector<double>& types) const {
    FaceLists lists;
    if (std::ranges::find(types, polyhedron_type) == types.end()) return lists;
    if (has_array(cells, "polyhedron_offsets")) return faces_by_number(cells, types);
    lists.place = array_called(cells, "faces");
    const std::vector<double> ends = numbers_of(array_called(cells, "faceoffsets"), types.size());
    const double last = *std::ranges::max_element(ends);
    const std::vector<double> all = numbers_of(lists.place, checked_size(lists.place, last));
    size_t begin = 0;
    lists.faces_of_cell.resize(types.size());
    for (size_t n = 0; n < types.size(); ++n) {
      if (types[n] != polyhedron_type) continue;
      const size_t end = checked_end(lists.place, ends[n], begin, all.size());
      lists.faces_of_cell[n].assign(all.begin() + static_cast<ptrdiff_t>(begin),
                                    all.begin() + static_cast<ptrdiff_t>(end));
      begin = end;
    }
    return lists;
  }

  // Reads the lists as VTK has written them since 9.4: cells have numbers of faces, and faces have points.
  FaceLists faces_by_number(xml_node cells, const std::vector<double>& types) const {
    FaceLists lists;
    lists.place = array_called(cells, "polyhedron_to_faces");
    const xml_node face_places = array_called(cells, "face_offsets"), points = array_called(cells, "face_connectivity");
    const std::vector<double> ends = numbers_of(array_called(cells, "polyhedron_offsets"), types.size());
    const std::vector<double> faces = numbers_of(lists.place, checked_size(lists.place, ends.back()));
    const double most_face = faces.empty() ? -1 : *std::ranges::max_element(faces);
    const std::vector<double> face_ends = numbers_of(face_places, checked_size(face_places, most_face + 1));
    const std::vector<double> corners =
        numbers_of(points, face_ends.empty() ? 0 : checked_size(points, face_ends.back()));
    // A face belongs to one polyhedron or to two, so that the lists cannot grow without bound.
    size_t begin = 0, listed = 0;
    lists.faces_of_cell.resize(types.size());
    for (size_t n = 0; n < types.size(); ++n) {
      const size_t end = checked_end(lists.place, ends[n], begin, faces.size());
      std::vector<double>& list = lists.faces_of_cell[n];
      list.push_back(static_cast<double>(end - begin));
      for (size_t f = begin; f < end; ++f) {
        const size_t face = checked_end(lists.place, faces[f], 0, face_ends.size() - 1);
        const size_t first = face == 0 ? 0 : checked_end(points, face_ends[face - 1], 0, corners.size());
        const size_t last = checked_end(points, face_ends[face], first, corners.size());
        listed += last - first;
        if (listed > 2 * corners.size()) file_.fail_at(lists.place, "a face belongs to more than two polyhedra");
        list.push_back(static_cast<double>(last - first));
        list.insert(list.end(), corners.begin() + static_cast<ptrdiff_t>(first),
                    corners.begin() + static_cast<ptrdiff_t>(last));
      }
      begin = end;
    }
    return lists;
  }

  static bool has_array(xml_node parent, std::string_view name) {
    return std::ranges::any_of(parent.children("DataArray"),
                               [&](xml_node array) { return array.attribute("Name").value() == name; });
  }
  uint64_t checked_size(xml_node array, double size) const {
    if (!(size >= 0 && size <= static_cast<double>(bytes_.size()) * 1032))
      file_.fail_at(array, "the offsets of faces go beyond the file");
    return static_cast<uint64_t>(size);
  }
  size_t checked_end(xml_node array, double end, size_t begin, size_t size) const {
    if (!(end >= static_cast<double>(begin) && end <= static_cast<double>(size)))
      file_.fail_at(array, "the faces of a polyhedron lie beyond those of the file");
    return static_cast<size_t>(end);
  }

  // Adds a polyhedron from its list of faces; returns the number of its elements.
  uint32_t add_polyhedron(const FaceLists& lists, size_t cell, size_t first_point, uint64_t point_count,
                          PolyhedronCutter& cutter) {
    const std::vector<double>& list = lists.faces_of_cell[cell];
    std::vector<PolyhedronCutter::Face> faces;
    for (size_t at = 1; at < list.size();) {
      const double size = list[at++];
      if (!(size >= 3 && size <= static_cast<double>(list.size() - at))) break;
      PolyhedronCutter::Face& face = faces.emplace_back();
      for (const size_t end = at + static_cast<size_t>(size); at < end; ++at) {
        if (!(list[at] >= 0 && list[at] < static_cast<double>(point_count)))
          file_.fail_at(lists.place, "polyhedron " + std::to_string(cell) + " names point " + format_number(list[at]) +
                                         "; there are " + std::to_string(point_count));
        face.push_back(static_cast<uint32_t>(first_point + static_cast<size_t>(list[at])));
      }
    }
    if (list.empty() || faces.size() < 4 || static_cast<double>(faces.size()) != list.front())
      file_.fail_at(lists.place, "polyhedron " + std::to_string(cell) +
                                     " has not the faces that its list promises: four or more, of three corners or "
                                     "more");
    if (results_.points.size() + faces.size() >= UINT32_MAX) file_.fail_at(lists.place, "there are too many faces");
    return static_cast<uint32_t>(cutter.add(faces));
  }

  // Adds the cells of a piece; returns how many elements each of them became.
  std::vector<uint32_t> add_cells(xml_node piece, size_t first_point, uint64_t point_count, uint64_t count,
                                  PolyhedronCutter& cutter) {
    std::vector<uint32_t> elements(count, 0);
    const xml_node cells = piece.child("Cells");
    if (count == 0) return elements;
    const std::vector<double> types = numbers_of(array_called(cells, "types"), count),
                              ends = numbers_of(array_called(cells, "offsets"), count);
    const xml_node list = array_called(cells, "connectivity");
    if (!(ends.back() >= 0 && ends.back() <= static_cast<double>(bytes_.size()) * 1032))
      file_.fail_at(list, "the offsets of cells go beyond the file");
    const std::vector<double> corners = numbers_of(list, static_cast<uint64_t>(ends.back()));
    std::array<uint32_t, 20> nodes{};
    const std::vector<bool> is_ghost = ghosts_of(piece, count);
    const FaceLists faces = faces_of(cells, types);
    for (size_t n = 0; n < count; ++n) {
      if (is_ghost[n]) {
        ++ghost_cells_;
        continue;
      }
      const double begin = n == 0 ? 0 : ends[n - 1];
      if (types[n] == polyhedron_type) {
        elements[n] = add_polyhedron(faces, n, first_point, point_count, cutter);
        continue;
      }
      const CellKind* const kind = cell_kind(types[n], ends[n] - begin);
      if (!kind && is_flat_cell(types[n])) {
        ++flat_cells_;
        continue;
      }
      if (!kind)
        file_.fail_at(list, "cell " + std::to_string(n) + " is of VTK's type " + format_number(types[n]) +
                                "; read are tetrahedra (10, 24, 71), hexahedra (12, 25, 72), voxels (11), wedges (13, "
                                "73), pyramids (14, 74) and polyhedra (42)");
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
      elements[n] = 1;
    }
    return elements;
  }

  // Adds the fields of a piece; `before` is the number of nodes or elements of earlier pieces.
  // `copies` says how many of them each node or cell of the piece became.
  void add_fields(xml_node parent, bool is_of_elements, size_t before, const std::vector<uint32_t>& copies) {
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
      const std::vector<double> numbers = numbers_of(array, field.components * copies.size());
      ResultField& all = field_of(field, before);
      for (size_t n = 0; n < copies.size(); ++n)
        for (uint32_t copy = 0; copy < copies[n]; ++copy)
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
    if (folded_ > 0)
      file_.diagnostics().warning({make_source(file_.name(), ""), 0, 0},
                                  format_count(folded_) +
                                      " polyhedra are not seen whole from their middle; the tetrahedra into which "
                                      "they are cut may overlap");
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
  uint64_t flat_cells_ = 0, ghost_cells_ = 0, folded_ = 0;
  std::set<std::string> wide_fields_;  // names
};

}  // namespace

Results read_vtu(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return VtuReader(name, bytes, diagnostics).run();
}

}  // namespace ombre::formats

#endif
