"""Projects of slicers from attributes."""
from __future__ import annotations

import os
import re
from typing import Any, NamedTuple

import numpy

import ombre
from pyvcad._attributes import DefaultAttributes
from pyvcad._defined import are_everywhere, given, marked, marker
from pyvcad._grids import centers, slabs
from pyvcad._tree import Node, Unary, as_node

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path, _voxel
from ._filaments import RecipeRules
from ._mixed_projects import BY_COLOUR, BY_FRACTIONS, MixedProject, expect_overlap, project_path, rewrite

_settings = ("INFILL_DENSITY FUZZY_SKIN_POINT_DISTANCE FUZZY_SKIN_THICKNESS BRIDGE_SPEED EXTERNAL_PERIMETER_SPEED "
             "GAP_FILL_SPEED INFILL_SPEED IRONING_SPEED PERIMETER_SPEED SMALL_PERIMETER_SPEED SOLID_INFILL_SPEED "
             "TOP_SOLID_INFILL_SPEED EXTRUSION_WIDTH EXTERNAL_PERIMETER_EXTRUSION_WIDTH INFILL_EXTRUSION_WIDTH "
             "PERIMETER_EXTRUSION_WIDTH SOLID_INFILL_EXTRUSION_WIDTH SUPPORT_MATERIAL_EXTRUSION_WIDTH "
             "TOP_INFILL_EXTRUSION_WIDTH IRONING_FLOWRATE LAYER_HEIGHT PERIMETERS").split()


class PrusaSlicerProjectCompiler(_AttributeCompiler):
    """Writes a .3mf for PrusaSlicer: a body for each band of slicers' attributes (infill_density, perimeter_speed, ...),
    with the settings of the band's middle. Several attributes are crossed, each in so many bands. Places without an attribute are
    bodies without its setting; if there are some, attributes that are everywhere have a band more. The attributes temperature and
    flow_rate become tools of one nozzle, whose changes set them; they need both profiles, and a value everywhere.

    Args:
        root: a node.
        voxel_size: mm; surfaces lie within an eighth of the least of it.
        output_file_path: a file of that name is replaced.
        num_regions: bands of each attribute.
        printer_profile_path, filament_profile_path: .ini files that PrusaSlicer has exported; the project gets their settings.
        enable_color_mix: mixes filaments by "color_rgb", or by "volume_fractions" with `volume_fraction_materials`, as
            FullSpectrumSlicerProjectCompiler does. So does a part with one of them and none of the slicers' attributes.
        color_mix_filaments, color_mix_recipe_preset, max_palette_size, min_component_percent, max_recipe_components,
        direct_physical_delta_e, region_overlap_mm, volume_fraction_materials, material_defs_path: as there.
        total_physical_extruders: mixtures are numbered after it.
    """

    def __init__(self, root: Any, voxel_size: Any, output_file_path: Path, num_regions: int = 10,
                 printer_profile_path: Path = "", filament_profile_path: Path = "", enable_color_mix: bool = False,
                 color_mix_filaments: Any = None, total_physical_extruders: int = 5, color_mix_recipe_preset: str = "expanded",
                 max_palette_size: int = 32, min_component_percent: float = 15, max_recipe_components: int = 3,
                 direct_physical_delta_e: float = 1.0, region_overlap_mm: float = 0.2, volume_fraction_materials: Any = None,
                 material_defs_path: Path = "") -> None:
        name = type(self).__name__
        if isinstance(num_regions, bool) or not isinstance(num_regions, int) or num_regions < 2:
            raise ValueError(f"{name}, num_regions: expected 2 or more, found {num_regions!r}")
        expect_overlap(name, region_overlap_mm)
        rules = RecipeRules(name, color_mix_recipe_preset, max_palette_size, min_component_percent, max_recipe_components,
                            direct_physical_delta_e)
        self._mixed = MixedProject(self, color_mix_filaments, total_physical_extruders, rules, volume_fraction_materials,
                                   material_defs_path)
        self._is_mixing = bool(enable_color_mix or color_mix_filaments or volume_fraction_materials)
        self._profiles = [_profile(name, os.fspath(path)) for path in (printer_profile_path, filament_profile_path) if path]
        self._root, self._voxel, self._bands = as_node(root), _voxel(name, voxel_size), num_regions
        self._path = project_path(name, output_file_path)

    def supported_attributes(self) -> list[str]:
        return [*self._banded(), BY_COLOUR, BY_FRACTIONS]

    @staticmethod
    def _banded() -> list[str]:
        return [*(getattr(DefaultAttributes, name) for name in _settings), *_tools]

    def compile(self) -> None:
        has = self._root.attribute_list()
        chosen = [name for name in self._banded() if name in has]
        if self._is_mixing or not chosen and (BY_COLOUR in has or BY_FRACTIONS in has):
            return self._mix(chosen)
        if not chosen:
            raise RuntimeError("PrusaSlicerProjectCompiler: no node of the tree has one of the attributes "
                               f"{', '.join(self.supported_attributes())}")
        if BY_COLOUR in has:
            raise RuntimeError(f"PrusaSlicerProjectCompiler: the tree has {BY_COLOUR} and {', '.join(chosen)}; a project is "
                               "made of bodies of mixed filaments, or of bodies with settings. Write two projects")
        tools = [name for name in chosen if name in _tools]
        if tools and len(self._profiles) < 2:
            raise RuntimeError(f"PrusaSlicerProjectCompiler: {' and '.join(tools)} of tools need printer_profile_path and "
                               "filament_profile_path")
        self._check_strictly(chosen)
        for name in tools:
            self._check_given(name)
        gaps = self._gaps(chosen)
        root: Node = _Filled(self._root, gaps) if gaps else self._root
        with self._new_file(self._path) as path:
            root._design().mesh(path, by=",".join(chosen), bands=self._bands + bool(gaps), flavour="prusa",
                                tolerance=min(self._voxel) / 8, virtual_tools=bool(tools), progress=self._share)
            if gaps:
                rewrite(path, lambda name, content: _without_settings(content, list(gaps)) if name in _bodies else content)
            self._add_profiles(path)
        self._report(1.0)

    def _gaps(self, names: list[str]) -> dict[str, _Range]:
        """The ranges of the attributes that nothing gives in some places of the part, with a band for these places."""
        partial = [name for name in names if not are_everywhere(self._root, [name])]
        if not partial:
            return {}
        design = self._root._design()
        pitch = max(high - low for low, high in zip(*design.bounds)) / _samples
        found: dict[str, list[numpy.ndarray]] = {name: [] for name in partial}
        has_gap = dict.fromkeys(partial, False)
        for _, grid in slabs(centers(design.bounds, (pitch, pitch, pitch)), lambda share: self._share(0.0)):
            points = grid[design.inside(grid)]
            for name in partial:
                is_given = given(self._root, name, points)
                values = design.attribute(name, points[is_given])
                found[name].append(values[numpy.isfinite(values)])
                has_gap[name] |= not is_given.all()
        values = {name: numpy.concatenate(found[name]) for name in partial if has_gap[name]}
        return {name: self._range(float(of.min()), float(of.max())) for name, of in values.items() if len(of)}

    def _range(self, low: float, high: float) -> _Range:
        width = max((high - low) / self._bands, _least_width * max(abs(low), abs(high), 1))
        return _Range(low, high, high + _beyond * width)

    def _mix(self, banded: list[str]) -> None:
        if banded:
            raise RuntimeError(f"PrusaSlicerProjectCompiler: filaments are mixed by colours or fractions, and the tree has "
                               f"{', '.join(banded)} as well; write two projects")
        with self._new_file(self._path) as path:
            self._mixed.write(self._root, self._voxel, path, "prusa")
            self._add_profiles(path)
        self._report(1.0)

    def _add_profiles(self, path: str) -> None:
        if self._profiles:
            settings = {key: value for profile in self._profiles for key, value in profile.items()}
            rewrite(path, lambda name, content: _extended(content, settings) if name == _config else content)

    def recipes(self) -> list[dict[str, Any]]:
        """The mixtures and filaments of bodies after compile(), each with its part of the whole and how far it is off."""
        return self._mixed.recipes


class _Range(NamedTuple):
    """The least and the greatest number of an attribute, and one for places without it, which is a band farther up."""

    low: float
    high: float
    beyond: float


class _Filled(Unary):
    """The part, whose attributes have their number beyond the range where nothing gives them."""

    def __init__(self, part: Node, ranges: dict[str, _Range]) -> None:
        super().__init__(marked(part))
        self._ranges = ranges

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        solid = solids[0]
        for name, (low, high, beyond) in self._ranges.items():
            is_given = ombre.attribute_of(solids[0], marker(name)).value > 0.5
            value = ombre.clamp(low, ombre.attribute_of(solids[0], name).value, high)
            solid = ombre.attribute(solid, name, ombre.where(is_given, value, beyond))
        return solid


def _without_settings(content: bytes, names: list[str]) -> bytes:
    """The list of bodies, or of their materials, in which those of the last band have no setting by these attributes."""
    text = content.decode()
    for name in names:
        text = re.sub(rf"\b{name} from [^,\"]*", f"without {name}", text)
    return re.sub(r"<volume .*?</volume>", lambda body: _without_keys(body[0], names), text, flags=re.DOTALL).encode()


def _without_keys(body: str, names: list[str]) -> str:
    for name in names:
        # PrusaSlicer's keys are the attributes' names or parts of them.
        keys = [key for key in re.findall(r'key="(\w+)"', body) if key in name]
        if keys and re.search(rf"\bwithout {name}\b", body):
            body = re.sub(rf'<metadata [^>]*key="{max(keys, key=len)}"[^>]*/>\n?', "", body)
    return body


_samples = 96  # points along the longest side of the box, for ranges
_beyond, _least_width = 1.001, 1e-4  # of the band of places without an attribute, in bands; of bands, in the numbers themselves
_bodies = ("3D/3dmodel.model", "Metadata/Slic3r_PE_model.config")
_tools = ("temperature", "flow_rate")
_config = "Metadata/Slic3r_PE.config"
# Settings that a project assumes unless a profile has them, each with the separator between the values of extruders.
_assumed = {"nozzle_diameter": ",", "filament_type": ";"}


def _profile(what: str, path: str) -> dict[str, str]:
    """The settings of an .ini file of PrusaSlicer."""
    with open(path, encoding="utf-8") as file:
        lines = [line.strip() for line in file]
    settings = dict(line.split(" = ", 1) for line in lines if " = " in line and line[0] not in "#;[")
    if not settings:
        raise ValueError(f"{what}: {path} has no settings; export it in PrusaSlicer by File, Export, Export Config")
    return settings


def _extended(config: bytes, settings: dict[str, str]) -> bytes:
    """The project's settings with those of profiles; what the project says of its bodies stays."""
    lines = []
    known = set()
    for line in config.decode().splitlines():
        key, _, value = line.lstrip("; ").partition(" = ")
        known.add(key)
        if key in _assumed and key in settings:
            between = _assumed[key]
            count, given = len(value.split(between)), settings[key].split(between)
            line = f"; {key} = {between.join((given * count)[:count])}"
        lines.append(line)
    lines += [f"; {key} = {value}" for key, value in settings.items() if key not in known]
    return ("\n".join(lines) + "\n").encode()
