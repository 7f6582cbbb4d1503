// Reads unstructured grids in VTK's XML files (.vtu).
#ifdef OMBRE_3MF

#include <algorithm>

#include "formats/containers/text_scanner.h"
#include "formats/results/results_readers.h"
#include "formats/results/vtk_grid.h"
#include "formats/volumes/vtk_arrays.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

class VtuReader {
 public:
  VtuReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : arrays_(name, bytes, diagnostics),
        file_(arrays_.file()),
        bytes_(bytes),
        grid_([this](VtkGrid::List list, const std::string& message) { file_.fail_at(place_of(list), message); }) {}

  Results run() {
    const xml_node root = file_.root("VTKFile");
    if (file_.required(root, "type") != "UnstructuredGrid")
      file_.fail_at(root, "this file holds no unstructured grid but " + formats::quoted(file_.required(root, "type")),
                    "save the results as .vtu");
    arrays_.read_settings(root);
    for (const xml_node piece : root.child("UnstructuredGrid").children("Piece")) add_piece(piece);
    return grid_.take(file_.name(), file_.diagnostics());
  }

 private:
  void add_piece(xml_node piece) {
    piece_ = piece;
    const uint64_t point_count = file_.count(piece, file_.required(piece, "NumberOfPoints"), "a count of points"),
                   cell_count = file_.count(piece, file_.required(piece, "NumberOfCells"), "a count of cells");
    if (point_count > most_numbers() || cell_count > most_numbers())
      file_.fail_at(piece, "the piece states more points or cells than the file can hold");
    if (point_count == 0) return;
    const xml_node points = piece.child("Points").child("DataArray");
    if (!points) file_.fail_at(piece, "the piece has no points");
    grid_.begin_piece(numbers_of(points, 3 * point_count));
    if (cell_count > 0) grid_.add_cells(cells_of(piece.child("Cells"), cell_count));
    add_fields(piece.child("PointData"), false, point_count);
    add_fields(piece.child("CellData"), true, cell_count);
    grid_.end_piece();
  }

  // Returns the array to which messages about a list point.
  xml_node place_of(VtkGrid::List list) const {
    const xml_node cells = piece_.child("Cells");
    switch (list) {
      case VtkGrid::List::points:
        return piece_.child("Points").child("DataArray");
      case VtkGrid::List::corners:
        return array_called(cells, "connectivity");
      case VtkGrid::List::faces:
        return has_array(cells, "polyhedron_to_faces") ? array_called(cells, "polyhedron_to_faces")
                                                       : array_called(cells, "faces");
      default:
        return array_called(cells, "face_connectivity");
    }
  }

  // No packing gives more numbers.
  uint64_t most_numbers() const { return bytes_.size() * 1032; }

  xml_node array_called(xml_node parent, std::string_view name) const {
    for (const xml_node array : parent.children("DataArray"))
      if (array.attribute("Name").value() == name) return array;
    file_.fail_at(parent, "expected an array " + formats::quoted(name) + " among the cells");
  }
  static bool has_array(xml_node parent, std::string_view name) {
    return std::ranges::any_of(parent.children("DataArray"),
                               [&](xml_node array) { return array.attribute("Name").value() == name; });
  }

  VtkCells cells_of(xml_node list, uint64_t count) const {
    VtkCells cells;
    cells.types = numbers_of(array_called(list, "types"), count);
    cells.ends = numbers_of(array_called(list, "offsets"), count);
    const xml_node corners = array_called(list, "connectivity");
    if (!is_size(cells.ends.back())) file_.fail_at(corners, "the offsets of cells go beyond the file");
    cells.corners = numbers_of(corners, static_cast<uint64_t>(cells.ends.back()));
    for (const xml_node array : piece_.child("CellData").children("DataArray"))
      if (array.attribute("Name").value() == std::string_view("vtkGhostType")) cells.ghosts = numbers_of(array, count);
    if (std::ranges::find(cells.types, vtk_polyhedron) != cells.types.end())
      cells.faces =
          has_array(list, "polyhedron_offsets") ? faces_by_number(list, cells.types) : faces_in_line(list, cells.types);
    return cells;
  }

  // Reads the lists of faces, by cell: each end lies in "faceoffsets", which is -1 for other cells.
  std::vector<std::vector<double>> faces_in_line(xml_node cells, const std::vector<double>& types) const {
    const xml_node place = array_called(cells, "faces");
    const std::vector<double> ends = numbers_of(array_called(cells, "faceoffsets"), types.size());
    const std::vector<double> all = numbers_of(place, checked_size(place, *std::ranges::max_element(ends)));
    std::vector<std::vector<double>> lists(types.size());
    size_t begin = 0;
    for (size_t n = 0; n < types.size(); ++n) {
      if (types[n] != vtk_polyhedron) continue;
      if (!(ends[n] >= static_cast<double>(begin)))
        file_.fail_at(place, "the faces of a polyhedron lie beyond those of the file");
      const auto end = static_cast<size_t>(ends[n]);
      lists[n].assign(all.begin() + static_cast<ptrdiff_t>(begin), all.begin() + static_cast<ptrdiff_t>(end));
      begin = end;
    }
    return lists;
  }

  // Reads the lists as VTK has written them since 9.4.
  std::vector<std::vector<double>> faces_by_number(xml_node cells, const std::vector<double>& types) const {
    const xml_node list = array_called(cells, "polyhedron_to_faces"), ends = array_called(cells, "face_offsets"),
                   corners = array_called(cells, "face_connectivity");
    VtkFaces faces;
    faces.polyhedron_ends = numbers_of(array_called(cells, "polyhedron_offsets"), types.size());
    faces.faces = numbers_of(list, checked_size(list, faces.polyhedron_ends.back()));
    const double most_face = faces.faces.empty() ? -1 : *std::ranges::max_element(faces.faces);
    faces.face_ends = numbers_of(ends, checked_size(ends, most_face + 1));
    faces.corners = numbers_of(corners, faces.face_ends.empty() ? 0 : checked_size(corners, faces.face_ends.back()));
    return grid_.faces_by_cell(faces, types);
  }

  bool is_size(double size) const { return size >= 0 && size <= static_cast<double>(most_numbers()); }
  uint64_t checked_size(xml_node array, double size) const {
    if (!is_size(size)) file_.fail_at(array, "the offsets of faces go beyond the file");
    return static_cast<uint64_t>(size);
  }

  void add_fields(xml_node parent, bool is_of_elements, uint64_t count) {
    for (const xml_node array : parent.children("DataArray")) {
      if (file_.attribute(array, "type") == "String") continue;
      ResultField field;
      set_name(field, file_.attribute(array, "Name").value_or("values"));
      field.is_of_elements = is_of_elements;
      field.components =
          file_.count(array, file_.attribute(array, "NumberOfComponents").value_or("1"), "a number of components");
      if (!grid_.takes(field)) continue;
      if (!grid_.add_field(field, numbers_of(array, field.components * count)))
        fail(file_.diagnostics(), file_.name(),
             "the file has more than " + std::to_string(VtkGrid::most_fields) + " fields");
    }
  }

  std::vector<double> numbers_of(xml_node array, uint64_t count) const { return arrays_.numbers(array, count); }

  VtkArrays arrays_;
  const XmlFile& file_;
  std::string_view bytes_;
  xml_node piece_;  // that is being read
  VtkGrid grid_;
};

}  // namespace

Results read_vtu(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return VtuReader(name, bytes, diagnostics).run();
}

}  // namespace ombre::formats

#endif
