"""What scripts may name and Ombre does not have yet: each says so where it is made."""
from __future__ import annotations

from typing import Any

from ._errors import missing
from ._tree import Node


class _Missing(Node):
    _instead = ""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        raise missing(type(self).__name__, self._instead)




class Voxels(_Missing):
    """Solid of a grid of voxels."""


class SimulationField(_Missing):
    """Composition from the results of a simulation."""


class PointMap(_Missing):
    """Composition from values at points."""


class Map(_Missing):
    """Coordinates along a surface."""


class Blend(_Missing):
    """Its child's composition, smoothed."""


class Convolution(_Missing):
    """Its child's composition, convolved with a kernel."""

    @staticmethod
    def BlendKernel(x: int, y: int, z: int) -> Any:
        raise missing("Convolution.BlendKernel")

    @staticmethod
    def PassKernel(x: int, y: int, z: int) -> Any:
        raise missing("Convolution.PassKernel")


class TetrahedralMesh:
    """Tetrahedra that fill a design."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        raise missing("TetrahedralMesh")

    @classmethod
    def from_tree(cls, *arguments: Any, **named: Any) -> TetrahedralMesh:
        raise missing("TetrahedralMesh.from_tree")


class HexahedralMesh:
    """Bricks that fill a design."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        raise missing("HexahedralMesh")
