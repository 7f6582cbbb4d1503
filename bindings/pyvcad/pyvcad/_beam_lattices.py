"""Lattices of beams between vertices, as 3MF files describe them."""
from __future__ import annotations

import enum
from typing import Any, NamedTuple

import numpy

import ombre

from ._arguments import length, not_negative, vector
from ._bars import CapMode, Strut
from ._errors import WrongValue
from ._solids import _Leaf, _unset


class Beam(NamedTuple):
    """A beam between two vertices, which are numbered from 0. What is None is that of the lattice; with r1 alone both ends have
    this radius."""

    v1: int
    v2: int
    r1: float | None = None
    r2: float | None = None
    cap1: CapMode | None = None
    cap2: CapMode | None = None


class Ball(NamedTuple):
    """A ball around a vertex."""

    vertex: int
    radius: float | None = None


class BallMode(enum.Enum):
    """Where balls are: nowhere, at the vertices that are listed, or at all vertices of beams."""

    None_ = 0
    Mixed = 1
    All = 2


class BeamLattice(_Leaf):
    """Beams between vertices, and balls around them.

    Args:
        vertices: points, mm.
        beams: Beams, or pairs of numbers of vertices.
        radius: of beams without one, mm.
        min_length: beams that are shorter are left out, mm.
        cap: the ends of beams without one, a CapMode.
        ball_mode: a BallMode.
        ball_radius: of balls without one, mm.
        balls: Balls.
    """

    def __init__(self, vertices: Any, beams: Any, radius: float, min_length: float = 0.0, cap: CapMode = CapMode.Sphere,
                 ball_mode: BallMode = BallMode.None_, ball_radius: float | None = None, balls: Any = ()) -> None:
        super().__init__()
        self._material = _unset
        self._points = [vector(point) for point in vertices]
        self._radius, self._cap = length(radius), CapMode(cap)
        self._least = not_negative(min_length)
        self._beams = [beam for beam in map(self._read_beam, beams) if self._length(beam) >= max(self._least, 1e-12)]
        self._balls = self._read_balls(BallMode(ball_mode), ball_radius, balls)
        if not self._beams and not self._balls:
            raise WrongValue("BeamLattice: no beam is long enough, and there are no balls")

    @property
    def active_beam_count(self) -> int:
        return len(self._beams)

    @property
    def active_ball_count(self) -> int:
        return len(self._balls)

    def _vertex(self, number: Any) -> int:
        if isinstance(number, bool) or int(number) != number or not 0 <= number < len(self._points):
            raise WrongValue(f"BeamLattice: expected one of the {len(self._points)} vertices, from 0, found {number!r}")
        return int(number)

    def _read_beam(self, beam: Any) -> Beam:
        v1, v2, r1, r2, cap1, cap2 = Beam(*beam)
        first = self._radius if r1 is None else length(r1)
        return Beam(self._vertex(v1), self._vertex(v2), first, first if r2 is None else length(r2),
                    self._cap if cap1 is None else CapMode(cap1), self._cap if cap2 is None else CapMode(cap2))

    def _length(self, beam: Beam) -> float:
        return float(numpy.linalg.norm(numpy.subtract(self._points[beam.v1], self._points[beam.v2])))

    def _read_balls(self, mode: BallMode, usual: Any, balls: Any) -> dict[int, float]:
        if mode is BallMode.None_:
            return {}
        radius = self._radius if usual is None else length(usual)
        found = {vertex: radius for beam in self._beams for vertex in (beam.v1, beam.v2)} if mode is BallMode.All else {}
        for ball in balls:
            vertex, own = Ball(*ball)
            found[self._vertex(vertex)] = radius if own is None else length(own)
        return found

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        parts = [Strut(self._points[b.v1], self._points[b.v2], b.r1, b.r2, b.cap1, b.cap2)._make([]) for b in self._beams]
        parts += [ombre.translate(ombre.sphere(radius, self._material), self._points[vertex])
                  for vertex, radius in self._balls.items()]
        return ombre.material(ombre.union(parts, materials="first"), self._material)
