"""Edges between points, for lattices."""
import numpy

from . import _core


def delaunay_edges(points):
    """The edges of the tetrahedra around whose corners no other point lies: an array of shape (m, 2, 3), mm.

    >>> import ombre
    >>> len(ombre.delaunay_edges([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [1, 1, 1]]))
    10
    """
    return _core.delaunay_edges(numpy.asarray(points, dtype=float))


def delaunay_faces(points):
    """The faces of those tetrahedra: an array of shape (m, 3, 3), mm."""
    return _core.delaunay_faces(numpy.asarray(points, dtype=float))


def voronoi_edges(points, min=None, max=None):
    """The edges between the cells of points, each nearest to one: an array of shape (m, 2, 3), mm.

    Edges without an end are left out; between the corners `min` and `max` of a box all are there, cut at its sides.
    """
    points = numpy.asarray(points, dtype=float)
    if min is None and max is None:
        return _core.voronoi_edges(points)
    if min is None or max is None:
        raise TypeError("voronoi_edges takes both min and max, the corners of a box, or neither")
    return _core.voronoi_edges(points, numpy.asarray([min, max], dtype=float))
