"""Projects of slicers from attributes."""
from __future__ import annotations

import os
from typing import Any

from pyvcad._attributes import DefaultAttributes
from pyvcad._errors import missing
from pyvcad._tree import as_node

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path, _voxel

_settings = ("INFILL_DENSITY FUZZY_SKIN_POINT_DISTANCE FUZZY_SKIN_THICKNESS BRIDGE_SPEED EXTERNAL_PERIMETER_SPEED "
             "GAP_FILL_SPEED INFILL_SPEED IRONING_SPEED PERIMETER_SPEED SMALL_PERIMETER_SPEED SOLID_INFILL_SPEED "
             "TOP_SOLID_INFILL_SPEED EXTRUSION_WIDTH EXTERNAL_PERIMETER_EXTRUSION_WIDTH INFILL_EXTRUSION_WIDTH "
             "PERIMETER_EXTRUSION_WIDTH SOLID_INFILL_EXTRUSION_WIDTH SUPPORT_MATERIAL_EXTRUSION_WIDTH "
             "TOP_INFILL_EXTRUSION_WIDTH IRONING_FLOWRATE LAYER_HEIGHT PERIMETERS").split()


class PrusaSlicerProjectCompiler(_AttributeCompiler):
    """Writes a .3mf for PrusaSlicer: a body for each band of slicers' attributes (infill_density, perimeter_speed, ...),
    with the settings of the band's middle. Several attributes are crossed, each in so many bands.

    Args:
        root: a node.
        voxel_size: mm; surfaces lie within an eighth of the least of it.
        output_file_path: a file of that name is replaced.
        num_regions: bands of each attribute.
    """

    def __init__(self, root: Any, voxel_size: Any, output_file_path: Path, num_regions: int = 10,
                 printer_profile_path: Path = "", filament_profile_path: Path = "", **options: Any) -> None:
        name = type(self).__name__
        if isinstance(num_regions, bool) or not isinstance(num_regions, int) or num_regions < 2:
            raise ValueError(f"{name}, num_regions: expected 2 or more, found {num_regions!r}")
        if printer_profile_path or filament_profile_path or options:
            raise missing(f"{name} with profiles, virtual extruders or mixed colours",
                          "leave them out, and load the profiles in the slicer")
        self._root, self._voxel, self._bands = as_node(root), _voxel(name, voxel_size), num_regions
        self._path = os.fspath(output_file_path)

    def supported_attributes(self) -> list[str]:
        return [getattr(DefaultAttributes, name) for name in _settings]

    def compile(self) -> None:
        has = self._root.attribute_list()
        chosen = [name for name in self.supported_attributes() if name in has]
        if not chosen:
            raise RuntimeError("PrusaSlicerProjectCompiler: no node of the tree has one of the attributes "
                               f"{', '.join(self.supported_attributes())}")
        os.makedirs(os.path.dirname(os.path.abspath(self._path)), exist_ok=True)
        self._root._design().mesh(self._path, by=",".join(chosen), bands=self._bands, flavour="prusa", force=True,
                                  tolerance=min(self._voxel) / 8, progress=self._share)
        self._report(1.0)
