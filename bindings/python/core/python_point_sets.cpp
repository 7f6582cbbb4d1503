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

Coordinates edges_of(const OfPoints<Edge3>& edges) {
  if (!edges.problem.empty()) throw py::value_error(edges.problem);
  Coordinates array({static_cast<py::ssize_t>(edges.list.size()), py::ssize_t{2}, py::ssize_t{3}});
  auto values = array.mutable_unchecked<3>();
  for (py::ssize_t n = 0; n < values.shape(0); ++n)
    for (size_t end = 0; end < 2; ++end)
      for (int axis = 0; axis < 3; ++axis)
        values(n, static_cast<py::ssize_t>(end), axis) = edges.list[static_cast<size_t>(n)][end][axis];
  return array;
}

Coordinates delaunay(const Coordinates& points) { return edges_of(delaunay_edges(points_of(points))); }

Coordinates voronoi(const Coordinates& points, const std::optional<Box>& box) {
  return edges_of(voronoi_edges(points_of(points), box));
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
  module.def("delaunay_edges", &delaunay);
  module.def("voronoi_edges", [](const Coordinates& points) { return voronoi(points, std::nullopt); });
  module.def("voronoi_edges", &voronoi_in_box);
}

}  // namespace ombre::python
