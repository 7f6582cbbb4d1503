#include "formats/results/vtk_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"

namespace ombre::formats {
namespace {

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

// Returns true if the bits of vtkDataSetAttributes::CellGhostTypes say that a cell belongs to another piece, or is
// hidden.
bool is_ghost(double bits) {
  constexpr unsigned duplicate = 1, hidden = 32;
  return bits > 0 && bits < 256 && (static_cast<unsigned>(bits) & (duplicate | hidden)) != 0;
}

}  // namespace

void VtkGrid::fail(List list, const std::string& message) const {
  fail_(list, message);
  throw DesignError();
}

void VtkGrid::begin_piece(const std::vector<double>& points) {
  first_point_ = results_.points.size();
  first_element_ = results_.kinds.size();
  point_count_ = points.size() / 3;
  elements_.clear();
  if (first_point_ + point_count_ > UINT32_MAX) fail(List::points, "the grid has more than 4294967295 points");
  for (size_t n = 0; n < point_count_; ++n) {
    const Vec3 p{points[3 * n], points[3 * n + 1], points[3 * n + 2]};
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(p[axis]) <= greatest_coordinate))
        fail(List::points, "point " + std::to_string(n) + " has a coordinate that is not finite or beyond 1e15");
    results_.points.push_back(p);
  }
  cutter_.emplace(results_);
}

void VtkGrid::add_cells(const VtkCells& cells) {
  elements_.assign(cells.types.size(), 0);
  for (size_t n = 0; n < cells.types.size(); ++n) {
    if (!cells.ghosts.empty() && is_ghost(cells.ghosts[n]))
      ++ghost_cells_;
    else
      elements_[n] = cells.types[n] == vtk_polyhedron ? add_polyhedron(cells, n) : add_cell(cells, n);
  }
}

uint32_t VtkGrid::add_cell(const VtkCells& cells, size_t cell) {
  const double type = cells.types[cell], begin = cell == 0 ? 0 : cells.ends[cell - 1], end = cells.ends[cell];
  const CellKind* const kind = cell_kind(type, end - begin);
  if (!kind && is_flat_cell(type)) {
    ++flat_cells_;
    return 0;
  }
  if (!kind)
    fail(List::corners, "cell " + std::to_string(cell) + " is of VTK's type " + format_number(type) +
                            "; read are tetrahedra (10, 24, 71), hexahedra (12, 25, 72), voxels (11), wedges (13, "
                            "73), pyramids (14, 74) and polyhedra (42)");
  const size_t size = node_count(kind->kind);
  if (!(begin >= 0) || begin + static_cast<double>(size) != end || end > static_cast<double>(cells.corners.size()))
    fail(List::corners, "cell " + std::to_string(cell) + " has not the " + std::to_string(size) + " nodes of its type");
  std::array<uint32_t, 20> nodes{};
  for (size_t c = 0; c < size; ++c)
    nodes[c] = point(List::corners, "cell ", cell, cells.corners[static_cast<size_t>(begin) + c]);
  if (kind->has_crossed_rows) {
    std::swap(nodes[2], nodes[3]);
    std::swap(nodes[6], nodes[7]);
  }
  results_.add_element(kind->kind, nodes.data());
  return 1;
}

uint32_t VtkGrid::add_polyhedron(const VtkCells& cells, size_t cell) {
  static const std::vector<double> none;
  const std::vector<double>& list = cells.faces.empty() ? none : cells.faces[cell];
  std::vector<PolyhedronCutter::Face> faces;
  for (size_t at = 1; at < list.size();) {
    const double size = list[at++];
    if (!(size >= 3 && size <= static_cast<double>(list.size() - at))) break;
    PolyhedronCutter::Face& face = faces.emplace_back();
    for (const size_t end = at + static_cast<size_t>(size); at < end; ++at)
      face.push_back(point(List::faces, "polyhedron ", cell, list[at]));
  }
  if (list.empty() || faces.size() < 4 || static_cast<double>(faces.size()) != list.front())
    fail(List::faces, "polyhedron " + std::to_string(cell) +
                          " has not the faces that its list promises: four or more, of three corners or more");
  if (results_.points.size() + faces.size() >= UINT32_MAX) fail(List::faces, "there are too many faces");
  return static_cast<uint32_t>(cutter_->add(faces));
}

// Returns the place in the results of a point of the piece that a cell names.
uint32_t VtkGrid::point(List list, const char* what, size_t cell, double number) const {
  if (!(number >= 0 && number < static_cast<double>(point_count_)))
    fail(list, what + std::to_string(cell) + " names point " + format_number(number) + "; there are " +
                   std::to_string(point_count_));
  return static_cast<uint32_t>(first_point_ + static_cast<size_t>(number));
}

size_t VtkGrid::checked_end(List list, double end, size_t begin, size_t size) const {
  if (!(end >= static_cast<double>(begin) && end <= static_cast<double>(size)))
    fail(list, "the faces of a polyhedron lie beyond those of the file");
  return static_cast<size_t>(end);
}

std::vector<std::vector<double>> VtkGrid::faces_by_cell(const VtkFaces& all, const std::vector<double>& types) const {
  std::vector<std::vector<double>> lists(types.size());
  // A face belongs to one polyhedron or to two, so that the lists cannot grow without bound.
  size_t begin = 0, listed = 0;
  for (size_t n = 0; n < types.size(); ++n) {
    const size_t end = checked_end(List::faces, all.polyhedron_ends[n], begin, all.faces.size());
    std::vector<double>& list = lists[n];
    list.push_back(static_cast<double>(end - begin));
    for (size_t f = begin; f < end; ++f) {
      const size_t face = checked_end(List::faces, all.faces[f] + 1, 1, all.face_ends.size()) - 1;
      const size_t first =
          face == 0 ? 0 : checked_end(List::face_corners, all.face_ends[face - 1], 0, all.corners.size());
      const size_t last = checked_end(List::face_corners, all.face_ends[face], first, all.corners.size());
      listed += last - first;
      if (listed > 2 * all.corners.size()) fail(List::faces, "a face belongs to more than two polyhedra");
      list.push_back(static_cast<double>(last - first));
      list.insert(list.end(), all.corners.begin() + static_cast<ptrdiff_t>(first),
                  all.corners.begin() + static_cast<ptrdiff_t>(last));
    }
    begin = end;
  }
  return lists;
}

bool VtkGrid::takes(const ResultField& field) {
  if (field.components >= 1 && field.components <= most_components) return true;
  wide_fields_.insert(field.name);
  return false;
}

bool VtkGrid::add_field(const ResultField& field, const std::vector<double>& values) {
  ResultField& all = field_of(field, field.is_of_elements ? first_element_ : first_point_);
  if (results_.fields.size() > most_fields) return false;
  const size_t count = field.is_of_elements ? elements_.size() : point_count_;
  for (size_t n = 0; n < count; ++n)
    for (uint32_t copy = 0; copy < (field.is_of_elements ? elements_[n] : 1); ++copy)
      all.values.insert(all.values.end(), values.begin() + static_cast<ptrdiff_t>(n * field.components),
                        values.begin() + static_cast<ptrdiff_t>((n + 1) * field.components));
  return true;
}

// Returns the field of the same name in earlier pieces, or a new one without values for them.
ResultField& VtkGrid::field_of(const ResultField& wanted, size_t before) {
  for (ResultField& field : results_.fields)
    if (field.name == wanted.name && field.is_of_elements == wanted.is_of_elements &&
        field.components == wanted.components && field.values.size() == before * wanted.components)
      return field;
  results_.fields.push_back(wanted);
  results_.fields.back().values.assign(before * wanted.components, std::nan(""));
  return results_.fields.back();
}

void VtkGrid::end_piece() {
  for (ResultField& field : results_.fields) {
    const size_t count = field.is_of_elements ? results_.kinds.size() : results_.points.size();
    field.values.resize(count * field.components, std::nan(""));
    if (!field.is_of_elements) cutter_->fill(field);
  }
  folded_ += cutter_->folded();
  cutter_.reset();
}

Results VtkGrid::take(const std::string& file, Diagnostics& diagnostics) {
  leave_out(results_, file, flat_cells_, "points, lines or faces of the grid", diagnostics);
  if (folded_ > 0)
    diagnostics.warning({make_source(file, ""), 0, 0},
                        format_count(folded_) +
                            " polyhedra are not seen whole from their middle; the tetrahedra into which they are cut "
                            "may overlap");
  leave_out(results_, file, ghost_cells_, "cells that are hidden, or belong to another piece,", diagnostics);
  leave_out(results_, file, wide_fields_.size(),
            "fields of more than " + std::to_string(most_components) + " numbers (" +
                join(std::vector<std::string>(wide_fields_.begin(), wide_fields_.end()), ", ") + ")",
            diagnostics);
  return std::move(results_);
}

}  // namespace ombre::formats
