// Reads unstructured grids in VTK's files of HDF5 (.vtkhdf), in pieces and steps. Source: VTK's documentation, "VTKHDF
// format specification".
#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/containers/hdf5.h"
#include "formats/containers/text_scanner.h"
#include "formats/results/result_steps.h"
#include "formats/results/results_readers.h"
#include "formats/results/vtk_grid.h"

namespace ombre::formats {
namespace {

const std::string vtkhdf_group = "/VTKHDF";
constexpr size_t most_pieces = 100000;

// The places and lengths of a piece's lists in the arrays of the file.
struct HdfPiece {
  uint64_t points = 0, cells = 0, corners = 0;  // where they begin
  uint64_t polyhedron_faces = 0, faces = 0, face_corners = 0;
  uint64_t number = 0;  // of the piece in the file; lists of ends have one more number in each piece
  uint64_t point_count = 0, cell_count = 0, corner_count = 0;
};

class VtkHdfReader {
 public:
  VtkHdfReader(const std::string& name, std::string_view bytes, uint64_t step, Diagnostics& diagnostics)
      : name_(name),
        diagnostics_(diagnostics),
        step_(step),
        file_(opened(bytes)),
        grid_([this](VtkGrid::List list, const std::string& message) { fail_at(array_of(list), message); }) {}

  Results run() {
    check_type();
    std::vector<std::string> times;
    if (has_steps()) times = times_of_steps();
    const size_t chosen = step_index(name_, times.empty() ? std::vector<std::string>{""} : times, step_, diagnostics_);
    step_place_ = chosen;
    add_pieces();
    Results results = grid_.take(name_, diagnostics_);
    if (!times.empty()) set_steps(results, std::move(times), chosen);
    leave_out(results, name_, without_numbers_, "fields without numbers", diagnostics_);
    return results;
  }

 private:
  std::unique_ptr<Hdf5File> opened(std::string_view bytes) const {
    if (auto file = open_hdf5(bytes)) return file;
    fail(diagnostics_, name_, "this is no file of HDF5, or it is damaged");
  }

  [[noreturn]] void fail_at(const std::string& array, const std::string& message) const {
    fail(diagnostics_, name_, formats::quoted(array) + ": " + message);
  }

  static std::string array_of(VtkGrid::List list) {
    switch (list) {
      case VtkGrid::List::points:
        return "Points";
      case VtkGrid::List::corners:
        return "Connectivity";
      case VtkGrid::List::faces:
        return "PolyhedronToFaces";
      default:
        return "FaceConnectivity";
    }
  }

  void check_type() const {
    const auto type = file_->text(vtkhdf_group, "Type");
    if (!type)
      fail(diagnostics_, name_, "the file has no group VTKHDF with a type, as grids of VTK have it",
           "the file with the numbers of an .xdmf file is read with that one");
    if (*type != "UnstructuredGrid")
      fail(diagnostics_, name_, "this file holds no unstructured grid but " + formats::quoted(*type),
           *type == "ImageData" ? "save it as .vti, for volume()" : "save the results as UnstructuredGrid");
    const auto version = file_->few_numbers(vtkhdf_group, "Version");
    if (version && (version->front() < 1 || version->front() >= 3))
      fail(diagnostics_, name_,
           "version " + format_number(version->front()) + " of VTKHDF is not read; read are 1 and 2");
  }

  bool has_steps() const { return file_->few_numbers(vtkhdf_group + "/Steps", "NSteps").has_value(); }

  std::vector<std::string> times_of_steps() const {
    std::vector<std::string> times;
    for (const double time : numbers("Steps/Values", {})) times.push_back(format_number(time));
    const double stated = file_->few_numbers(vtkhdf_group + "/Steps", "NSteps")->front();
    if (times.empty() || stated != static_cast<double>(times.size()))
      fail_at("Steps/Values",
              "it has " + std::to_string(times.size()) + " times for " + format_number(stated) + " steps");
    return times;
  }

  // Returns rows of an array that must be there.
  std::vector<double> numbers(const std::string& array, Hdf5Rows rows) const {
    std::string problem;
    auto found = file_->numbers(vtkhdf_group + '/' + array, problem, rows);
    if (!found) fail_at(array, problem.empty() ? "there are no such numbers" : problem);
    return std::move(found->values);
  }

  static bool is_count(double number) {
    return number >= 0 && number <= 9007199254740992.0 && number == std::floor(number);  // 2^53
  }
  uint64_t count_in(const std::string& array, uint64_t row) const {
    const std::vector<double> found = numbers(array, {row, 1});
    if (found.empty() || !is_count(found.front())) fail_at(array, "expected a count");
    return static_cast<uint64_t>(found.front());
  }
  std::vector<uint64_t> counts(const std::string& array, Hdf5Rows rows) const {
    std::vector<uint64_t> list;
    for (const double number : numbers(array, rows)) {
      if (!is_count(number)) fail_at(array, "expected counts, found " + format_number(number));
      list.push_back(static_cast<uint64_t>(number));
    }
    return list;
  }

  bool has(const std::string& array) const { return !file_->sizes(vtkhdf_group + '/' + array).empty(); }
  // Returns where a list begins in the step that is read.
  uint64_t offset_of_step(const std::string& array) const {
    return has_steps() ? count_in("Steps/" + array, step_place_) : 0;
  }

  // Returns the number of pieces from the first one of the step. Where the file does not say it, all steps have as
  // many.
  uint64_t pieces_of_step(uint64_t first) const {
    if (has("Steps/NumberOfParts")) return count_in("Steps/NumberOfParts", step_place_);
    const uint64_t all = numbers("NumberOfPoints", {}).size(), steps = numbers("Steps/Values", {}).size();
    if (all % steps != 0 || first != step_place_ * (all / steps))
      fail_at("Steps/NumberOfParts", "there are no such numbers, and the steps share pieces");
    return all / steps;
  }

  void add_pieces() {
    HdfPiece piece;
    piece.number = offset_of_step("PartOffsets");
    piece.points = offset_of_step("PointOffsets");
    piece.cells = offset_of_step("CellOffsets");
    piece.corners = offset_of_step("ConnectivityIdOffsets");
    Hdf5Rows rows{piece.number};
    if (has_steps()) rows.count = pieces_of_step(piece.number);
    const std::vector<uint64_t> points = counts("NumberOfPoints", rows), cells = counts("NumberOfCells", rows),
                                corners = counts("NumberOfConnectivityIds", rows);
    if (points.size() > most_pieces) fail_at("NumberOfPoints", "there are more than 100000 pieces");
    if (points.size() != cells.size() || points.size() != corners.size())
      fail_at("NumberOfCells", "it has another number of pieces than NumberOfPoints");
    begin_fields();
    if (has("PolyhedronToFaces")) skip_faces(piece);
    first_point_ = piece.points;
    first_cell_ = piece.cells;
    for (size_t n = 0; n < points.size(); ++n, ++piece.number) {
      piece.point_count = points[n];
      piece.cell_count = cells[n];
      piece.corner_count = corners[n];
      add_piece(piece);
      piece.points += points[n];
      piece.cells += cells[n];
      piece.corners += corners[n];
    }
    check_lengths(piece);
  }

  // A file without steps has no other rows than those of its pieces.
  void check_lengths(const HdfPiece& end) const {
    if (has_steps()) return;
    const auto check = [&](const std::string& array, uint64_t wanted) {
      const std::vector<uint64_t> sizes = file_->sizes(vtkhdf_group + '/' + array);
      if (!sizes.empty() && sizes.front() != wanted)
        fail_at(array, "it has " + std::to_string(sizes.front()) + " rows; its pieces have " + std::to_string(wanted));
    };
    check("Points", end.points);
    check("Types", end.cells);
    check("Connectivity", end.corners);
    for (const Field& field : fields_) check(field.array, field.is_of_elements ? end.cells : end.points);
  }

  void add_piece(HdfPiece& piece) {
    const std::vector<uint64_t> sizes = file_->sizes(vtkhdf_group + "/Points");
    if (sizes.size() != 2 || sizes[1] != 3) fail_at("Points", "expected three coordinates for each point");
    grid_.begin_piece(numbers("Points", {piece.points, piece.point_count}));
    grid_.add_cells(cells_of(piece));
    for (const Field& field : fields_) add_values(field, piece);
    grid_.end_piece();
  }

  VtkCells cells_of(HdfPiece& piece) const {
    VtkCells cells;
    cells.types = numbers("Types", {piece.cells, piece.cell_count});
    cells.ends = ends_of("Offsets", piece.cells + piece.number, piece.cell_count);
    cells.corners = numbers("Connectivity", {piece.corners, piece.corner_count});
    if (has("CellData/vtkGhostType"))
      cells.ghosts = numbers("CellData/vtkGhostType", {row_of("CellData", "vtkGhostType", piece), piece.cell_count});
    if (has("PolyhedronToFaces"))
      cells.faces = faces_of(piece, cells.types);
    else if (std::ranges::find(cells.types, vtk_polyhedron) != cells.types.end())
      fail_at("PolyhedronToFaces", "there are no faces of polyhedra");
    return cells;
  }

  // Returns the ends of a piece's lists, before which its file has a 0.
  std::vector<double> ends_of(const std::string& array, uint64_t first, uint64_t count) const {
    std::vector<double> ends = numbers(array, {first, count + 1});
    if (ends.front() != 0)
      fail_at(array, "the offsets of a piece begin with " + format_number(ends.front()) + ", not 0");
    ends.erase(ends.begin());
    return ends;
  }

  // Faces have no offsets of steps: those of the pieces before are counted.
  void skip_faces(HdfPiece& piece) const {
    const auto sum_before = [&](const std::string& array) {
      uint64_t sum = 0;
      for (const uint64_t count : counts(array, {0, piece.number})) sum += count;
      return sum;
    };
    piece.polyhedron_faces = sum_before("NumberOfPolyhedronToFaceIds");
    piece.faces = sum_before("NumberOfFaces");
    piece.face_corners = sum_before("NumberOfFaceConnectivityIds");
  }

  std::vector<std::vector<double>> faces_of(HdfPiece& piece, const std::vector<double>& types) const {
    const uint64_t listed = count_in("NumberOfPolyhedronToFaceIds", piece.number),
                   faces = count_in("NumberOfFaces", piece.number),
                   corners = count_in("NumberOfFaceConnectivityIds", piece.number);
    VtkFaces all;
    all.polyhedron_ends = ends_of("PolyhedronOffsets", piece.cells + piece.number, piece.cell_count);
    all.faces = numbers("PolyhedronToFaces", {piece.polyhedron_faces, listed});
    all.face_ends = ends_of("FaceOffsets", piece.faces + piece.number, faces);
    all.corners = numbers("FaceConnectivity", {piece.face_corners, corners});
    piece.polyhedron_faces += listed;
    piece.faces += faces;
    piece.face_corners += corners;
    return grid_.faces_by_cell(all, types);
  }

  struct Field {
    std::string group, name, array;  // "PointData", "u", "PointData/u"
    bool is_of_elements = false;
    size_t components = 1;
  };

  static std::string within(const std::string& group, const std::string& name) {
    std::string path = group;
    path += '/';
    path += name;
    return path;
  }

  void begin_fields() {
    for (const bool is_of_elements : {false, true}) {
      const std::string group = is_of_elements ? "CellData" : "PointData";
      for (const std::string& name : file_->arrays_in(within(vtkhdf_group, group))) {
        const std::string array = within(group, name), path = within(vtkhdf_group, array);
        const std::vector<uint64_t> sizes = file_->sizes(path);
        std::string problem;
        if (sizes.empty() || (!file_->numbers(path, problem, {0, 0}) && problem.empty())) {
          ++without_numbers_;
          continue;
        }
        uint64_t components = 1;
        for (size_t n = 1; n < sizes.size(); ++n) components = std::min<uint64_t>(components * sizes[n], UINT32_MAX);
        fields_.push_back({group, name, array, is_of_elements, components});
      }
    }
  }

  // Returns the row where the values of a piece begin. A step may share values with others.
  uint64_t row_of(const std::string& group, const std::string& name, const HdfPiece& piece) const {
    const bool is_of_elements = group == "CellData";
    const uint64_t begin = is_of_elements ? piece.cells : piece.points;
    const std::string offsets = "Steps/" + group + "Offsets/" + name;
    if (!has_steps() || !has(offsets)) return begin;
    return count_in(offsets, step_place_) + (begin - (is_of_elements ? first_cell_ : first_point_));
  }

  void add_values(const Field& field, const HdfPiece& piece) {
    ResultField added;
    set_name(added, field.name);
    added.is_of_elements = field.is_of_elements;
    added.components = field.components;
    if (!grid_.takes(added)) return;
    const uint64_t count = field.is_of_elements ? piece.cell_count : piece.point_count;
    if (!grid_.add_field(added, numbers(field.array, {row_of(field.group, field.name, piece), count})))
      fail(diagnostics_, name_, "the file has more than " + std::to_string(VtkGrid::most_fields) + " fields");
  }

  const std::string& name_;
  Diagnostics& diagnostics_;
  uint64_t step_ = 0;  // number of the step, or 0
  std::unique_ptr<Hdf5File> file_;
  VtkGrid grid_;
  size_t step_place_ = 0;                      // index of the step that is read
  uint64_t first_point_ = 0, first_cell_ = 0;  // of the step
  std::vector<Field> fields_;
  uint64_t without_numbers_ = 0;
};

}  // namespace

Results read_vtkhdf(const std::string& name, std::string_view bytes, uint64_t step, Diagnostics& diagnostics) {
  try {
    return VtkHdfReader(name, bytes, step, diagnostics).run();
  } catch (const Error& error) {
    fail(diagnostics, name, error.what());
  }
}

}  // namespace ombre::formats
