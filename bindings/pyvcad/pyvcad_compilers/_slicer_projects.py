"""Projects of slicers from attributes."""
from __future__ import annotations

import os
import zipfile
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
    with the settings of the band's middle. Several attributes are crossed, each in so many bands. The attributes temperature and
    flow_rate become tools of one nozzle, whose changes set them; they need both profiles.

    Args:
        root: a node.
        voxel_size: mm; surfaces lie within an eighth of the least of it.
        output_file_path: a file of that name is replaced.
        num_regions: bands of each attribute.
        printer_profile_path, filament_profile_path: .ini files that PrusaSlicer has exported; the project gets their settings.
    """

    def __init__(self, root: Any, voxel_size: Any, output_file_path: Path, num_regions: int = 10,
                 printer_profile_path: Path = "", filament_profile_path: Path = "", **options: Any) -> None:
        name = type(self).__name__
        if isinstance(num_regions, bool) or not isinstance(num_regions, int) or num_regions < 2:
            raise ValueError(f"{name}, num_regions: expected 2 or more, found {num_regions!r}")
        for option in options:
            if option not in _mixing:
                raise TypeError(f"{name} has no argument {option!r}")
        if any(options.get(option) for option in ("enable_color_mix", "color_mix_filaments", "volume_fraction_materials")):
            raise missing(f"{name} with mixed colours", "ombre.Design.mesh(path, bands=4, mix_layers=4, flavour=\"prusa\") mixes "
                          "two filaments layer by layer")
        self._profiles = [_profile(name, os.fspath(path)) for path in (printer_profile_path, filament_profile_path) if path]
        self._root, self._voxel, self._bands = as_node(root), _voxel(name, voxel_size), num_regions
        self._path = os.fspath(output_file_path)

    def supported_attributes(self) -> list[str]:
        return [*(getattr(DefaultAttributes, name) for name in _settings), *_tools]

    def compile(self) -> None:
        has = self._root.attribute_list()
        chosen = [name for name in self.supported_attributes() if name in has]
        if not chosen:
            raise RuntimeError("PrusaSlicerProjectCompiler: no node of the tree has one of the attributes "
                               f"{', '.join(self.supported_attributes())}")
        tools = [name for name in chosen if name in _tools]
        if tools and len(self._profiles) < 2:
            raise RuntimeError(f"PrusaSlicerProjectCompiler: {' and '.join(tools)} of tools need printer_profile_path and "
                               "filament_profile_path")
        os.makedirs(os.path.dirname(os.path.abspath(self._path)), exist_ok=True)
        self._root._design().mesh(self._path, by=",".join(chosen), bands=self._bands, flavour="prusa", force=True,
                                  tolerance=min(self._voxel) / 8, virtual_tools=bool(tools), progress=self._share)
        if self._profiles:
            _add_settings(self._path, {key: value for profile in self._profiles for key, value in profile.items()})
        self._report(1.0)


_tools = ("temperature", "flow_rate")
# Arguments of mixed colours, which Ombre does not have; without enable_color_mix they mean nothing.
_mixing = ("enable_color_mix", "color_mix_filaments", "total_physical_extruders", "color_mix_recipe_preset", "max_palette_size",
           "min_component_percent", "max_recipe_components", "direct_physical_delta_e", "region_overlap_mm",
           "volume_fraction_materials", "material_defs_path")
_config = "Metadata/Slic3r_PE.config"


def _profile(what: str, path: str) -> dict[str, str]:
    """The settings of an .ini file of PrusaSlicer."""
    with open(path, encoding="utf-8") as file:
        lines = [line.strip() for line in file]
    settings = dict(line.split(" = ", 1) for line in lines if " = " in line and line[0] not in "#;[")
    if not settings:
        raise ValueError(f"{what}: {path} has no settings; export it in PrusaSlicer by File, Export, Export Config")
    return settings


def _add_settings(path: str, settings: dict[str, str]) -> None:
    """Gives a project the settings that it does not have of its own."""
    with zipfile.ZipFile(path) as archive:
        entries = [(entry, archive.read(entry)) for entry in archive.infolist()]
    beside = f"{path}.{os.getpid()}.part"
    with zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED) as archive:
        for entry, content in entries:
            archive.writestr(entry, _extended(content, settings) if entry.filename == _config else content)
    os.replace(beside, path)


def _extended(config: bytes, settings: dict[str, str]) -> bytes:
    lines = config.decode().splitlines()
    known = {line.lstrip("; ").split(" = ", 1)[0] for line in lines}
    lines += [f"; {key} = {value}" for key, value in settings.items() if key not in known]
    return ("\n".join(lines) + "\n").encode()
