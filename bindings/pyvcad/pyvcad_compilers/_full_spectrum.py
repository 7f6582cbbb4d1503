"""Projects of Snapmaker Orca with mixed filaments."""
from __future__ import annotations

from typing import Any

from pyvcad._tree import as_node

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path, _voxel
from ._filaments import RecipeRules
from ._mixed_projects import BY_COLOUR, BY_FRACTIONS, MixedProject, expect_overlap, project_path

_profiles = ("base_project_settings_path", "orca_machine_profile_path", "orca_process_profile_path",
             "orca_default_filament_profile_path", "orca_profile_search_paths")


class FullSpectrumSlicerProjectCompiler(_AttributeCompiler):
    """Writes a .3mf for Snapmaker Orca and OrcaSlicer-FullSpectrum, which mix filaments from layer to layer: a body for each
    mixture that the part needs, by "color_rgb", or by "volume_fractions" with `volume_fraction_materials`.

    A mixture looks like the mean of its layers' light. Of those that the preset has, each colour gets the nearest (CIE 1976);
    of fractions, which are taken of the materials that have a slot, the nearest shares that a cycle of up to six layers has.

    Args:
        root: a node.
        voxel_size: mm; the colours of voxels' centres choose the mixtures, and surfaces lie within an eighth of the least of it.
        output_file_path: a file of that name is replaced.
        filaments: dicts with "color_hex", and perhaps "slot", "nozzle_diameter_mm", "filament_settings_id", "filament_id";
            without them cyan, magenta, yellow, black and white.
        max_palette_size: filaments and mixtures that bodies have at most; those that least of the part has are left out.
        min_component_percent: mixtures with less of a filament are left out.
        max_recipe_components: filaments of a mixture, at most; 3 are the most that can be.
        direct_physical_delta_e: mixtures that are no farther from the colour of a filament are left out.
        region_overlap_mm: changes nothing, since bodies share their borders exactly.
        volume_fraction_materials: {material's name: slot}.
        material_defs_path: the materials file of these names; without it the default ones.
        color_mix_recipe_preset: "conservative" mixes pairs in quarters, "expanded" also a half of one with quarters of two.
    """

    def __init__(self, root: Any, voxel_size: Any, output_file_path: Path, filaments: Any = None, max_palette_size: int = 32,
                 min_component_percent: float = 15, max_recipe_components: int = 3, direct_physical_delta_e: float = 1.0,
                 region_overlap_mm: float = 0.2, *, volume_fraction_materials: Any = None, material_defs_path: Path = "",
                 color_mix_recipe_preset: str = "expanded", **profiles: Any) -> None:
        what = type(self).__name__
        for name, value in profiles.items():
            if name not in _profiles:
                raise TypeError(f"{what} has no argument {name!r}")
            if value:
                raise ValueError(f"{what}, {name}: Orca's profiles are not read; leave it out, open the project, and choose the "
                                 "printer and its profiles there")
        expect_overlap(what, region_overlap_mm)
        rules = RecipeRules(what, color_mix_recipe_preset, max_palette_size, min_component_percent, max_recipe_components,
                            direct_physical_delta_e)
        self._root, self._voxel, self._path = as_node(root), _voxel(what, voxel_size), project_path(what, output_file_path)
        self._mixed = MixedProject(self, filaments, None, rules, volume_fraction_materials, material_defs_path)

    def supported_attributes(self) -> list[str]:
        return [BY_COLOUR, BY_FRACTIONS]

    def compile(self) -> None:
        with self._new_file(self._path) as path:
            self._mixed.write(self._root, self._voxel, path, "snapmaker")
        self._report(1.0)

    def recipes(self) -> list[dict[str, Any]]:
        """The mixtures and filaments of bodies after compile(), each with its part of the whole and how far it is off."""
        return self._mixed.recipes

    def report_stats(self) -> None:
        super().report_stats()
        for recipe in self.recipes():
            print(", ".join(f"{name.replace('_', ' ')} {value}" for name, value in recipe.items()))
