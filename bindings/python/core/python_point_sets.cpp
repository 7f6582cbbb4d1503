// Functions for Python that make edges between points.
#include "base/math/point_sets.h"

#include <pybind11/numpy.h>

#include "design_objects.h"
#include "python_data.h"

namespace ombre::python {
namespace {

using Coordinates = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<Vec3> points_of(const Coordinates& array) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw py::value_error("expected points of three coordinates: an array of shape (n, 3)");
  const auto rows = array.unchecked<2>();
  std::vector<Vec3> points;
  for (py::ssize_t n = 0; n < rows.shape(0); ++n) points.push_back({rows(n, 0), rows(n, 1), rows(n, 2)});
  return points;
}

// Returns an array of the shape (edges or faces, corners, 3).
template <size_t corners>
Coordinates corners_of(const OfPoints<std::array<Vec3, corners>>& found) {
  if (!found.problem.empty()) throw py::value_error(found.problem);
  Coordinates array({static_cast<py::ssize_t>(found.list.size()), static_cast<py::ssize_t>(corners), py::ssize_t{3}});
  auto values = array.template mutable_unchecked<3>();
  for (py::ssize_t n = 0; n < values.shape(0); ++n)
    for (size_t corner = 0; corner < corners; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        values(n, static_cast<py::ssize_t>(corner), axis) = found.list[static_cast<size_t>(n)][corner][axis];
  return array;
}

Coordinates voronoi(const Coordinates& points, const std::optional<Box>& box) {
  return corners_of(voronoi_edges(points_of(points), box));
}

Coordinates voronoi_in_box(const Coordinates& points, const Coordinates& corners) {
  const std::vector<Vec3> ends = points_of(corners);
  if (ends.size() != 2) throw py::value_error("expected two corners");
  const Box box{ends[0], ends[1]};
  if (box.is_empty()) throw py::value_error("expected a lower corner of the box that is nowhere above the upper one");
  return voronoi(points, box);
}

}  // namespace

void add_point_sets(py::module_& module) {
  module.def("delaunay_edges", [](const Coordinates& points) { return corners_of(delaunay_edges(points_of(points))); });
  module.def("delaunay_faces", [](const Coordinates& points) { return corners_of(delaunay_faces(points_of(points))); });
  module.def("voronoi_edges", [](const Coordinates& points) { return voronoi(points, std::nullopt); });
  module.def("voronoi_edges", &voronoi_in_box);
}

}  // namespace ombre::python
