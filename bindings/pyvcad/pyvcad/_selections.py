"""Parts of surfaces of triangles: chosen by links, angles, distances and paths."""
from __future__ import annotations

import heapq
import math
from collections import deque
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import numpy

from ._arguments import length, number, vector
from ._vectors import Vec3

Edge = tuple[int, int]


class NearestTriangle(NamedTuple):
    triangle_id: int
    point: Vec3


class RayHit(NamedTuple):
    triangle_id: int
    point: Vec3
    distance: float


class SurfacePath(NamedTuple):
    """Edges of a mesh one after the other, as pairs of numbers of vertices; the length is mm."""

    edges: list[Edge]
    length: float


def _sorted(a: int, b: int) -> Edge:
    return (a, b) if a < b else (b, a)


class Links:
    """Which triangles and vertices of a surface are linked."""

    def __init__(self, vertices: numpy.ndarray, triangles: numpy.ndarray) -> None:
        self.vertices, self.triangles = vertices, triangles
        self.at_edge: dict[Edge, list[int]] = {}
        for n, (a, b, c) in enumerate(triangles.tolist()):
            for edge in (_sorted(a, b), _sorted(b, c), _sorted(c, a)):
                self.at_edge.setdefault(edge, []).append(n)
        ends = vertices[triangles]
        areas = numpy.cross(ends[:, 1] - ends[:, 0], ends[:, 2] - ends[:, 0])
        doubled = numpy.linalg.norm(areas, axis=1)
        self.areas = doubled / 2
        self.normals = areas / numpy.where(doubled > 0, doubled, 1)[:, None]

    def edges_of(self, triangle: int) -> tuple[Edge, Edge, Edge]:
        a, b, c = (int(n) for n in self.triangles[triangle])
        return _sorted(a, b), _sorted(b, c), _sorted(c, a)

    def grown_from(self, seed: int, passes: Callable[[int, int, Edge], bool]) -> set[int]:
        """The triangles that are linked to one over edges that are passed: passes(from, to, edge)."""
        if not 0 <= seed < len(self.triangles):
            raise ValueError(f"seed_triangle: expected one of the {len(self.triangles)} triangles, from 0, found {seed}")
        found, waiting = {seed}, deque([seed])
        while waiting:
            here = waiting.popleft()
            for edge in self.edges_of(here):
                for other in self.at_edge[edge]:
                    if other not in found and passes(here, other, edge):
                        found.add(other)
                        waiting.append(other)
        return found

    def distances_from(self, start: int, blocked: set[Edge], enough: float = math.inf) -> tuple[dict[int, float],
                                                                                              dict[int, int]]:
        """Distances along edges from a vertex, mm, and the vertex before each (E. W. Dijkstra, 1959)."""
        if not 0 <= start < len(self.vertices):
            raise ValueError(f"expected one of the {len(self.vertices)} vertices, from 0, found {start}")
        beside: dict[int, list[tuple[int, float]]] = {}
        for a, b in self.at_edge:
            if (a, b) not in blocked:
                way = float(numpy.linalg.norm(self.vertices[a] - self.vertices[b]))
                beside.setdefault(a, []).append((b, way))
                beside.setdefault(b, []).append((a, way))
        found, before, waiting = {start: 0.0}, dict[int, int](), [(0.0, start)]
        while waiting:
            here, vertex = heapq.heappop(waiting)
            if here > found[vertex] or here > enough:
                continue
            for other, way in beside.get(vertex, ()):
                if here + way < found.get(other, math.inf):
                    found[other], before[other] = here + way, vertex
                    heapq.heappush(waiting, (here + way, other))
        return {vertex: way for vertex, way in found.items() if way <= enough}, before


class MeshSelection:
    """Triangles of a SurfaceMesh. It does not change; grown and shrunk make others."""

    def __init__(self, mesh: Any, ids: Iterable[int]) -> None:
        self._mesh, self._ids = mesh, frozenset(int(n) for n in ids)
        wrong = [n for n in self._ids if not 0 <= n < len(mesh.triangles)]
        if wrong:
            raise ValueError(f"MeshSelection: there is no triangle {wrong[0]}; there are {len(mesh.triangles)}, from 0")

    @property
    def triangle_ids(self) -> list[int]:
        return sorted(self._ids)

    @property
    def triangle_count(self) -> int:
        return len(self._ids)

    @property
    def area(self) -> float:
        """mm2"""
        return float(self._mesh._links().areas[self.triangle_ids].sum())

    def boundary_edges(self) -> list[Edge]:
        """Edges of one of its triangles alone, as pairs of numbers of vertices."""
        links, counts = self._mesh._links(), dict[Edge, int]()
        for n in self._ids:
            for edge in links.edges_of(n):
                counts[edge] = counts.get(edge, 0) + 1
        return sorted(edge for edge, count in counts.items() if count == 1)

    def grown(self, rings: int = 1) -> MeshSelection:
        """With the triangles beside it, `rings` times."""
        return MeshSelection(self._mesh, self._with_rings(self._ids, rings))

    def shrunk(self, rings: int = 1) -> MeshSelection:
        """Without the triangles at its border, `rings` times."""
        others = frozenset(range(len(self._mesh.triangles))) - self._ids
        return MeshSelection(self._mesh, self._ids - self._with_rings(others, rings))

    def _with_rings(self, ids: frozenset[int], rings: int) -> frozenset[int]:
        links = self._mesh._links()
        for _ in range(int(rings)):
            ids = ids | {other for n in ids for edge in links.edges_of(n) for other in links.at_edge[edge]}
        return ids

    def to_triangle_mesh_surface(self, u_axis_hint: Any = None) -> Any:
        from ._surfaces import TriangleMeshSurface
        return TriangleMeshSurface.from_selection(self._mesh, self.triangle_ids, u_axis_hint)


class Selecting:
    """Ways to choose triangles, for SurfaceMesh."""

    _vertices: numpy.ndarray
    _triangles: numpy.ndarray
    _known_links: Links | None = None

    def _links(self) -> Links:
        if self._known_links is None:
            self._known_links = Links(self._vertices, self._triangles)
        return self._known_links

    def nearest_vertex(self, point: Any) -> int:
        """The number of the vertex nearest to a point."""
        return int(numpy.argmin(((self._vertices - numpy.array(vector(point))) ** 2).sum(axis=1)))

    def nearest_triangle(self, point: Any) -> NearestTriangle:
        """The triangle nearest to a point, and its point there."""
        p = numpy.array(vector(point))
        places = _nearest_places(self._vertices[self._triangles], p)
        best = int(numpy.argmin(((places - p) ** 2).sum(axis=1)))
        return NearestTriangle(best, Vec3(*map(float, places[best])))

    def ray_intersection(self, origin: Any, direction: Any) -> RayHit | None:
        """The first triangle that a ray meets, or None (T. Moeller and B. Trumbore, 1997)."""
        o, way = numpy.array(vector(origin)), numpy.array(vector(direction))
        if not way.any():
            raise ValueError("ray_intersection: expected a direction, found (0, 0, 0)")
        way = way / numpy.linalg.norm(way)
        a, b, c = (self._vertices[self._triangles[:, n]] for n in range(3))
        first, second, off = b - a, c - a, o - a
        across, turn = numpy.cross(way, second), numpy.cross(off, first)
        determinant = (first * across).sum(axis=1)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            u, v = (off * across).sum(axis=1) / determinant, (turn @ way) / determinant
            along = (second * turn).sum(axis=1) / determinant
            meets = (determinant != 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (along >= 0)
        if not meets.any():
            return None
        n = int(numpy.argmin(numpy.where(meets, along, math.inf)))
        return RayHit(n, Vec3(*map(float, o + along[n] * way)), float(along[n]))

    def select_triangles(self, ids: Iterable[int]) -> MeshSelection:
        return MeshSelection(self, ids)

    def select_linked(self, seed_triangle: int) -> MeshSelection:
        """The triangles that are linked by edges."""
        return MeshSelection(self, self._links().grown_from(int(seed_triangle), lambda here, other, edge: True))

    def select_linked_by_face_angle(self, seed_triangle: int, max_angle_degrees: float) -> MeshSelection:
        """The triangles that are linked over edges where the surface bends by at most this angle."""
        links, least = self._links(), math.cos(math.radians(number(max_angle_degrees)))

        def passes(here: int, other: int, edge: Edge) -> bool:
            return float(links.normals[here] @ links.normals[other]) >= least - 1e-12
        return MeshSelection(self, links.grown_from(int(seed_triangle), passes))

    def select_linked_constrained(self, seed_triangle: int, triangle_regions: Any = None,
                                  marked_edges: Iterable[Any] = ()) -> MeshSelection:
        """The triangles that are linked, up to marked edges and to triangles with another label."""
        marked = {_sorted(int(a), int(b)) for a, b in marked_edges}
        if triangle_regions is not None and len(triangle_regions) != len(self._triangles):
            raise ValueError(f"triangle_regions: expected a label for each of the {len(self._triangles)} triangles, found "
                             f"{len(triangle_regions)}")

        def passes(here: int, other: int, edge: Edge) -> bool:
            return edge not in marked and (triangle_regions is None or triangle_regions[here] == triangle_regions[other])
        return MeshSelection(self, self._links().grown_from(int(seed_triangle), passes))

    def select_by_geodesic_radius(self, vertex: int, radius: float) -> MeshSelection:
        """The triangles whose vertices are all within a distance along edges from a vertex, mm."""
        near, _ = self._links().distances_from(int(vertex), set(), length(radius))
        return MeshSelection(self, (n for n, corners in enumerate(self._triangles.tolist())
                                    if all(corner in near for corner in corners)))

    def shortest_surface_path(self, a: int, b: int, blocked_edges: Iterable[Any] = ()) -> SurfacePath:
        """The shortest way along edges from one vertex to another."""
        blocked = {_sorted(int(i), int(j)) for i, j in blocked_edges}
        distances, before = self._links().distances_from(int(a), blocked)
        if int(b) not in distances:
            raise RuntimeError(f"shortest_surface_path: no edges lead from the vertex {a} to the vertex {b}")
        edges, at = list[Edge](), int(b)
        while at != int(a):
            edges.append((before[at], at))
            at = before[at]
        return SurfacePath(edges[::-1], distances[int(b)])

    def select_enclosed_region(self, edges: Iterable[Any], seed_triangle: int) -> MeshSelection:
        """The triangles within a closed loop of edges, on the side of the seed."""
        loop = {_sorted(int(a), int(b)) for a, b in edges}
        degrees: dict[int, int] = {}
        for edge in loop:
            for end in edge:
                degrees[end] = degrees.get(end, 0) + 1
        if not loop or any(count != 2 for count in degrees.values()):
            raise RuntimeError("select_enclosed_region: the edges are no closed loop; join paths of shortest_surface_path")
        return self.select_linked_constrained(seed_triangle, marked_edges=loop)


def _nearest_places(corners: numpy.ndarray, p: numpy.ndarray) -> numpy.ndarray:
    """The nearest point of each triangle of the shape (n, 3, 3)."""
    a, first, second = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal, off = numpy.cross(first, second), p - a
    squared = numpy.maximum((normal ** 2).sum(axis=1), 1e-300)
    u = (numpy.cross(off, second) * normal).sum(axis=1) / squared
    v = (numpy.cross(first, off) * normal).sum(axis=1) / squared
    best = a + u[:, None] * first + v[:, None] * second
    least = numpy.where((u >= 0) & (v >= 0) & (u + v <= 1), ((best - p) ** 2).sum(axis=1), math.inf)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        way = corners[:, end] - corners[:, start]
        share = ((p - corners[:, start]) * way).sum(axis=1) / numpy.maximum((way ** 2).sum(axis=1), 1e-300)
        place = corners[:, start] + numpy.clip(share, 0, 1)[:, None] * way
        away = ((place - p) ** 2).sum(axis=1)
        best = numpy.where((away < least)[:, None], place, best)
        least = numpy.minimum(away, least)
    return best
