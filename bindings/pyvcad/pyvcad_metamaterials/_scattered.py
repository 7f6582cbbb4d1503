"""Struts and walls between points that are scattered in a body."""
from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy

import ombre
from ombre._points import delaunay_faces
from pyvcad import FloatAttribute, Vec3
from pyvcad._arguments import length, not_negative, vector
from pyvcad._cell_maps import control
from pyvcad._errors import missing
from pyvcad._tree import Node, Unary, as_node


class ScatteredPoints:
    """Points in a body, as a sequence of Vec3, with the numbers of candidates that were tried and refused."""

    def __init__(self, points: numpy.ndarray, candidate_count: int) -> None:
        self._points = points
        self.candidate_count, self.rejected_count = candidate_count, candidate_count - len(points)

    def __len__(self) -> int:
        return len(self._points)

    def __getitem__(self, index: int) -> Vec3:
        return Vec3(*map(float, self._points[index]))

    def __iter__(self) -> Iterator[Vec3]:
        return (self[n] for n in range(len(self)))

    def __array__(self, dtype: Any = None, copy: Any = None) -> numpy.ndarray:
        return numpy.array(self._points, dtype=dtype or float)


def _field(value: Any, what: str) -> Callable[[numpy.ndarray], numpy.ndarray]:
    """A length or a density at points."""
    if isinstance(value, FloatAttribute):
        found = value._value
        if not isinstance(found, (int, float)):
            formula = found if isinstance(found, ombre.Expression) else ombre.formula(found)
            return lambda points: numpy.asarray(formula(points), dtype=float)
        value = found
    size = length(float(value))
    return lambda points: numpy.full(len(points), size)


class _Neighbours:
    """Points by the cubes of a lattice, for the question which are nearer than a distance."""

    def __init__(self, side: float) -> None:
        self._side, self._cubes = side, dict[tuple[int, int, int], list[tuple[float, float, float]]]()

    def _cube(self, point: tuple[float, float, float]) -> tuple[int, int, int]:
        x, y, z = (math.floor(c / self._side) for c in point)
        return x, y, z

    def has_nearer(self, point: tuple[float, float, float], distance: float) -> bool:
        reach, (x, y, z) = math.ceil(distance / self._side), self._cube(point)
        steps = range(-reach, reach + 1)
        return any(math.dist(point, other) < distance for i, j, k in itertools.product(steps, steps, steps)
                   for other in self._cubes.get((x + i, y + j, z + k), ()))

    def add(self, point: tuple[float, float, float]) -> None:
        self._cubes.setdefault(self._cube(point), []).append(point)


def sample_points_in_host(host: Any, spacing: Any = None, density: Any = None, seed: int = 0,
                          max_count: int | None = None, relaxation: int = 0,
                          boundary_clearance: float = 0.0) -> ScatteredPoints:
    """Scatters points in a body; equal seeds give equal points.

    Args:
        host: a node.
        spacing: least distance between points, mm, a number or a FloatAttribute. Points are added until hundred
            candidates in turn, and as many as there are points, find no room.
        density: points in a mm3, in place of the spacing; their least distance is then 0.7 times the mean one.
        max_count: most points.
        relaxation: times that each point is moved to the middle of the places that are nearest to it.
        boundary_clearance: least distance from the surface, mm.
    """
    if (spacing is None) == (density is None):
        raise TypeError("sample_points_in_host: expected either a spacing or a density")
    design, clearance = as_node(host)._design(), not_negative(float(boundary_clearance))
    field = _field(spacing if density is None else density, "spacing")
    random = numpy.random.default_rng(int(seed))
    low, high = (numpy.array(corner) for corner in design.bounds)

    def inside(count: int) -> tuple[numpy.ndarray, numpy.ndarray]:
        points = random.uniform(low, high, (count, 3))
        points = points[design.distance(points) <= -clearance]
        values = field(points) if len(points) else numpy.zeros(0)
        if not (values > 0).all() or not numpy.isfinite(values).all():
            raise ValueError("sample_points_in_host: the spacing or density is not above 0 everywhere in the body")
        return points, values
    batch = 4096
    first, values = inside(8 * batch)
    if len(first) == 0:
        raise RuntimeError("sample_points_in_host: no point of the body is so far from its surface")
    wanted = max_count
    if density is not None:
        share = len(first) / (8 * batch) * float(numpy.prod(high - low))
        wanted = min(round(share * float(values.mean())), max_count or 10**9)
    chosen, tried = _spread(inside, density is not None, wanted, batch)
    for _ in range(relaxation):
        samples = inside(batch * 4)[0]
        nearest = numpy.array([int(numpy.argmin(((chosen - s) ** 2).sum(axis=1))) for s in samples])
        chosen = numpy.array([samples[nearest == n].mean(axis=0) if (nearest == n).any() else point
                              for n, point in enumerate(chosen)])
        keep = design.distance(chosen) <= -clearance
        chosen = chosen[keep]
    return ScatteredPoints(chosen, tried)


def _spread(inside: Callable[[int], tuple[numpy.ndarray, numpy.ndarray]], is_density: bool, wanted: int | None,
            batch: int) -> tuple[numpy.ndarray, int]:
    """Chooses points that keep their distance, and counts the candidates."""
    neighbours: _Neighbours | None = None
    chosen: list[tuple[float, float, float]] = []
    tried = failed = 0
    while wanted is None or len(chosen) < wanted:
        points, values = inside(batch)
        distances = 0.7 * values ** (-1 / 3) if is_density else values
        if neighbours is None and len(points):
            neighbours = _Neighbours(float(distances.min()))
        for (x, y, z), distance in zip(points.tolist(), distances.tolist()):
            tried += 1
            assert neighbours is not None
            point = float(x), float(y), float(z)
            if neighbours.has_nearer(point, distance):
                failed += 1
                if failed > 100 + len(chosen):
                    return numpy.array(chosen), tried
                continue
            failed = 0
            neighbours.add(point)
            chosen.append(point)
            if len(chosen) == wanted:
                break
    return numpy.array(chosen), tried


class _Within(Unary):
    """What a function makes of a body, such as struts that lie in it; of the body's materials and attributes."""

    def __init__(self, host: Node, make: Callable[[ombre.Solid], ombre.Solid]) -> None:
        super().__init__(host)
        self._of = make

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return _cut(solids[0], self._of(solids[0]))


def _places(what: str, points: Any) -> list[list[float]]:
    places = [list(vector(point)) for point in points]
    if len(places) < 5:
        raise ValueError(f"{what}: expected at least 5 points, found {len(places)}")
    return places


def _is_closed(what: str, boundary: str) -> bool:
    if boundary not in ("open", "closed"):
        raise ValueError(f'{what}, boundary: expected "open" or "closed", found {boundary!r}')
    return boundary == "closed"


def _cut(host: ombre.Solid, lattice: ombre.Solid) -> ombre.Solid:
    return ombre.intersection(host, lattice, materials="first")


def _balls(edges: list[Any], radius: float) -> ombre.Solid:
    """Balls at the ends of edges: struts that are shorter than any detail."""
    short = 1e-6
    ends = {tuple(round(c, 9) for c in end) for edge in edges for end in edge}
    return ombre.lattice(edges=[[[x, y, z], [x, y, z + short]] for x, y, z in sorted(ends)], radius=radius)


def _struts(what: str, host: Any, places: list[list[float]], edges: list[Any], of_points: Any, beam_thickness: float,
            node_radius: float | None, boundary: str, blend: float) -> Node:
    """Struts along edges; `of_points` is the node of ombre that closes them at the surface of a body, and rounds seams."""
    radius, closes = length(float(beam_thickness)) / 2, _is_closed(what, boundary)
    fillet = not_negative(float(blend))
    if not edges:
        raise ValueError(f"{what}: no edge lies between these points")
    balls = None if node_radius is None else length(float(node_radius))

    def make(body: ombre.Solid) -> ombre.Solid:
        if closes or fillet:
            struts = of_points(places, radius, region=body, closed=closes, **({"blend": fillet} if fillet else {}))
        else:
            struts = ombre.lattice(edges=edges, radius=radius)
        return struts if balls is None else ombre.union(struts, _balls(edges, balls), materials="first")
    return _Within(as_node(host), make)


def voronoi_graph_lattice(host: Any, points: Any, beam_thickness: float, node_radius: float | None = None,
                          boundary: str = "open", member_blend_radius: float = 0.0) -> Node:
    """Struts along the edges between the cells of points, cut at the surface of the body.

    Args:
        points: what sample_points_in_host gives, or points.
        beam_thickness: diameter of struts, mm.
        node_radius: radius of balls where struts meet, mm; none: no balls.
        boundary: "open", or "closed" with struts along the surface where walls between cells meet it.
        member_blend_radius: radius of fillets along the seams of struts, mm; 0: sharp seams.
    """
    places = _places("voronoi_graph_lattice", points)
    low, high = (numpy.array(corner) for corner in as_node(host)._design().bounds)
    margin = float(beam_thickness) + 0.1 * float((high - low).max())
    edges = ombre.voronoi_edges(numpy.array(places), low - margin, high + margin).tolist()
    return _struts("voronoi_graph_lattice", host, places, edges, ombre.voronoi_struts, beam_thickness, node_radius, boundary,
                   member_blend_radius)


def delaunay_graph_lattice(host: Any, points: Any, beam_thickness: float, node_radius: float | None = None,
                           boundary: str = "open", mode: str = "mesh_edges", member_blend_radius: float = 0.0) -> Node:
    """Struts from each point to its neighbours, cut at the surface of the body; arguments as for voronoi_graph_lattice.

    Args:
        mode: "mesh_edges", or "vertex_centroid" for struts from the middle of each triangle between neighbours to its corners.
    """
    what = "delaunay_graph_lattice"
    places = _places(what, points)
    if mode == "vertex_centroid":
        return _to_middles(what, host, places, beam_thickness, node_radius, boundary, member_blend_radius)
    if mode != "mesh_edges":
        raise missing(f"{what} with the mode {mode!r}", 'mode="mesh_edges" or "vertex_centroid", or voronoi_graph_lattice, '
                      "whose struts join the centres of the balls around tetrahedra")
    edges = ombre.delaunay_edges(numpy.array(places)).tolist()
    return _struts(what, host, places, edges, ombre.delaunay_struts, beam_thickness, node_radius, boundary,
                   member_blend_radius)


def _to_middles(what: str, host: Any, places: list[list[float]], beam_thickness: float, node_radius: float | None,
                boundary: str, blend: float) -> Node:
    if _is_closed(what, boundary) or blend:
        raise missing(f"{what} to the middles of faces with closed ends or fillets", 'boundary="open" without fillets')
    faces = delaunay_faces(numpy.array(places))
    middles = numpy.broadcast_to(faces.mean(axis=1, keepdims=True), faces.shape)
    edges = numpy.stack([middles, faces], axis=2).reshape(-1, 2, 3).tolist()
    return _struts(what, host, places, edges, None, beam_thickness, node_radius, boundary, 0.0)


def _walls(what: str, make: Any, host: Any, points: Any, wall_thickness: Any, boundary: str, blend: float) -> Node:
    _no_blend(what, blend)
    places, thickness, closes = _places(what, points), control(wall_thickness), _is_closed(what, boundary)
    return _Within(as_node(host), lambda body: make(places, thickness, region=body, closed=closes))


def voronoi_plate_lattice(host: Any, points: Any, wall_thickness: Any, boundary: str = "open",
                          member_blend_radius: float = 0.0) -> Node:
    """Walls between the cells of points, cut at the surface of the body; "closed" adds a skin inside of it.

    Args:
        wall_thickness: mm, a number or a FloatAttribute.
    """
    return _walls("voronoi_plate_lattice", ombre.voronoi_walls, host, points, wall_thickness, boundary, member_blend_radius)


def delaunay_plate_lattice(host: Any, points: Any, wall_thickness: Any, boundary: str = "open",
                           member_blend_radius: float = 0.0) -> Node:
    """The faces of the tetrahedra between points as walls; arguments as for voronoi_plate_lattice."""
    return _walls("delaunay_plate_lattice", ombre.delaunay_walls, host, points, wall_thickness, boundary, member_blend_radius)


def _no_blend(what: str, radius: float) -> None:
    if radius:
        raise missing(f"{what} with blended joints", "the graph lattices take it")
