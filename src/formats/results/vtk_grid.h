// Unstructured grids of VTK as results, from the lists of numbers that its files have.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/results/polyhedra.h"
#include "formats/results/results.h"

namespace ombre::formats {

inline constexpr double vtk_polyhedron = 42;

// The cells of a piece.
struct VtkCells {
  std::vector<double> types;               // numbers of VTK's types, by cell
  std::vector<double> ends;                // where the points of each cell end in `corners`
  std::vector<double> corners;             // numbers of the piece's points
  std::vector<double> ghosts;              // bits that mark cells of other pieces and hidden ones; may be empty
  std::vector<std::vector<double>> faces;  // by cell, of polyhedra: the number of faces, then of each its size and
                                           // points; may be empty
};

// The faces of polyhedra, which are numbered: polyhedra have faces, and faces have points.
struct VtkFaces {
  std::vector<double> polyhedron_ends;  // where the faces of each cell end in `faces`
  std::vector<double> faces;
  std::vector<double> face_ends;  // where the points of each face end in `corners`
  std::vector<double> corners;
};

// Joins the pieces of a grid. Mistakes in a list go to a function that must throw.
class VtkGrid {
 public:
  enum class List { points, corners, faces, face_corners };
  using Fail = std::function<void(List list, const std::string& message)>;

  explicit VtkGrid(Fail fail) : fail_(std::move(fail)) {}

  // Begins a piece with its points, three numbers each.
  void begin_piece(const std::vector<double>& points);
  void add_cells(const VtkCells& cells);
  // Returns false for a field that is too wide, which is left out.
  bool takes(const ResultField& field);
  // Adds the values of the piece's points or cells to the field of that name. Returns false if there are too many
  // fields.
  bool add_field(const ResultField& field, const std::vector<double>& values);
  void end_piece();

  // Returns the results, and warns of what was left out.
  Results take(const std::string& file, Diagnostics& diagnostics);

  // Returns the lists of faces by cell, for VtkCells.
  std::vector<std::vector<double>> faces_by_cell(const VtkFaces& faces, const std::vector<double>& types) const;

  static constexpr size_t most_fields = 1000, most_components = 9;

 private:
  [[noreturn]] void fail(List list, const std::string& message) const;
  // Returns an end in a list of this size that lies behind its beginning.
  size_t checked_end(List list, double end, size_t begin, size_t size) const;
  // Each function adds a cell and returns the number of its elements.
  uint32_t add_cell(const VtkCells& cells, size_t cell);
  uint32_t add_polyhedron(const VtkCells& cells, size_t cell);
  uint32_t point(List list, const char* what, size_t cell, double number) const;
  ResultField& field_of(const ResultField& wanted, size_t before);

  Fail fail_;
  Results results_;
  // The piece that is being added: its first point and element, and how many elements each of its cells became.
  size_t first_point_ = 0, point_count_ = 0, first_element_ = 0;
  std::vector<uint32_t> elements_;
  std::optional<PolyhedronCutter> cutter_;
  uint64_t flat_cells_ = 0, ghost_cells_ = 0, folded_ = 0;
  std::set<std::string> wide_fields_;  // names
};

}  // namespace ombre::formats
