"""Materials of pixels, drawn by their fractions."""
from __future__ import annotations

from typing import Any

import numpy


def drawn_materials(what: str, design: Any, points: numpy.ndarray, names: list[str],
                    random: numpy.random.Generator) -> numpy.ndarray:
    """The number in `names` of the material of each point; -1 outside, and where the draw falls to none of them.

    Raises RuntimeError, with the place, where a fraction is negative or not finite.
    """
    inside = design.distance(points) <= 0
    found = design.material(points)
    shares = numpy.stack([numpy.broadcast_to(found.get(name, 0.0), inside.shape) for name in names])
    bad = inside & ~(numpy.isfinite(shares) & (shares >= 0)).all(axis=0)
    if bad.any():
        x, y, z = (float(c) for c in points[bad][0])
        raise RuntimeError(f"{what}: volume_fractions are negative or not finite at ({x:g}, {y:g}, {z:g})")
    draws, borders = random.random(inside.shape), numpy.cumsum(shares, axis=0)
    chosen = (draws >= borders).sum(axis=0)
    return numpy.where(inside & (chosen < len(names)), chosen, -1)

