"""Projects of slicers whose bodies have mixed filaments, by colours or by fractions."""
from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Callable
from typing import Any

import numpy

import ombre
from ombre._materials import current_factory
from pyvcad._arguments import not_negative
from pyvcad._grids import centers, slabs
from pyvcad._materials import MaterialDefs, default_materials, table_of
from pyvcad._tree import Node, Unary

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path
from ._filaments import (USUAL_NOZZLE, Filament, Recipe, RecipeRules, colour_of, filaments_of, hex_of, lab_of, light_of,
                         palette_of, shares_of)

_report = "Metadata/ombre_recipes.json"
_steps = 127  # values within one of so many steps of their range count as their mean
BY_COLOUR, BY_FRACTIONS = "color_rgb", "volume_fractions"


def project_path(what: str, path: Path) -> str:
    """The name of a file for a project. Raises ValueError if it is none of a .3mf file."""
    name = os.fspath(path)
    if not name.lower().endswith(".3mf"):
        raise ValueError(f"{what}, output_file_path: expected a name that ends in .3mf, found {name!r}")
    return name


def expect_overlap(what: str, value: Any) -> None:
    """Raises ValueError if it is no region_overlap_mm. Bodies meet in one surface, so nothing has to overlap."""
    try:
        not_negative(value)
    except ValueError as error:
        raise ValueError(f"{what}, region_overlap_mm: {error}") from None


class _Scored(Unary):
    """The child, with the numbers by which recipes are chosen, as attributes."""

    def __init__(self, child: Node, numbers: Callable[[ombre.Solid], list[Any]]) -> None:
        super().__init__(child)
        self._numbers = numbers

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        solid = solids[0]
        for place, value in enumerate(self._numbers(solids[0])):
            solid = ombre.attribute(solid, _score_name(place), value)
        return solid


def _score_name(place: int) -> str:
    return f"recipe_{place}"


class _Mixed(Unary):
    """A scored child, of the recipe whose numbers are nearest: the material `names[i]` where `recipes[i]` is."""

    def __init__(self, child: Node, names: list[str], recipes: numpy.ndarray, reach: float) -> None:
        super().__init__(child)
        self._names, self._recipes, self._reach = names, recipes, reach

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        at = [ombre.attribute_of(solids[0], _score_name(place)).value for place in range(self._recipes.shape[1])]
        # The greatest share is the one of the nearest recipe; none is negative within the reach.
        shares = [1 - sum((x - float(c)) ** 2 for x, c in zip(at, recipe)) / self._reach**2 for recipe in self._recipes]
        return ombre.material(solids[0], [ombre.mix_many(self._names, shares).mixture])

    def _fractions(self) -> set[int] | None:
        return set()


class MixedProject:
    """What a compiler with mixed filaments does, from its arguments."""

    def __init__(self, compiler: _AttributeCompiler, filaments: Any, total: int | None, rules: RecipeRules,
                 volume_fraction_materials: Any, material_defs_path: Path) -> None:
        self._compiler, self._what, self._rules = compiler, type(compiler).__name__, rules
        self.filaments = filaments_of(self._what, filaments)
        last = self.filaments[-1].slot
        if total is not None and last > total:
            raise ValueError(f"{self._what}, total_physical_extruders: a filament has the slot {last}, found {total}")
        self._total = total or last
        self._table = MaterialDefs(material_defs_path) if os.fspath(material_defs_path) else default_materials
        self._places = self._places_of(volume_fraction_materials)
        self.recipes: list[dict[str, Any]] = []

    def _places_of(self, materials: Any) -> dict[int, int]:
        """The place among the filaments of each material that fractions name, by its id."""
        by_slot = {filament.slot: place for place, filament in enumerate(self.filaments)}
        places = {}
        for name, slot in dict(materials or {}).items():
            if not self._table.contains(name):
                raise KeyError(f"{self._what}, volume_fraction_materials: there is no material {name!r}; material_defs_path "
                               "names a file of others")
            if slot not in by_slot:
                raise ValueError(f"{self._what}, volume_fraction_materials: no filament has the slot {slot!r} of {name!r}; "
                                 f"expected {', '.join(map(str, by_slot))}")
            places[self._table.id(name)] = by_slot[slot]
        return places

    def _kind(self, root: Node) -> str:
        has = root.attribute_list()
        if self._places:
            if BY_FRACTIONS not in has:
                raise RuntimeError(f"{self._what}: volume_fraction_materials are given, and no node of the tree has "
                                   f"{BY_FRACTIONS}")
            return BY_FRACTIONS
        if BY_COLOUR in has:
            return BY_COLOUR
        if BY_FRACTIONS in has:
            raise RuntimeError(f"{self._what}: volume_fractions need volume_fraction_materials, which say the slot of each "
                               "material's filament; write for example volume_fraction_materials={\"red\": 1, \"blue\": 2}")
        raise RuntimeError(f"{self._what}: no node of the tree has the attribute {BY_COLOUR} or {BY_FRACTIONS}; colours are "
                           "Vec3Attribute(red, green, blue), each 0 to 1")

    def write(self, root: Node, voxel: Any, path: str, flavour: Any) -> None:
        kind = self._kind(root)
        share = self._compiler._share
        self._compiler._check_given(kind)
        candidates, points, numbers = self._by_colour() if kind == BY_COLOUR else self._by_shares()
        scored = _Scored(root, numbers)
        values, counts = self._values(scored, voxel, points, lambda done: share(done / 2))
        palette = palette_of(values, counts, points, self._rules.most)
        chosen = [candidates[place] for place in palette.chosen]
        table, names = self._materials(chosen)
        reach = 2 * max(float(numpy.ptp(numpy.vstack([values, points]), axis=0).max()), 1e-6) * points.shape[1] ** 0.5
        mixed = _Mixed(scored, names, points[palette.chosen], reach)
        mixed._ombre_design_(table).mesh(path, by="materials", flavour=flavour, tolerance=min(voxel) / 8,
                                         progress=lambda done: share(0.5 + done / 2))
        measure = "mean_delta_e" if kind == BY_COLOUR else "mean_difference_of_shares"
        self.recipes = [{"name": name, "slots": [self.filaments[place].slot for place, _ in recipe],
                         "layers": [layers for _, layers in recipe],
                         "color_hex": hex_of(self._colours([recipe])[0]), "share_of_part": round(part, 6),
                         measure: round(off, 4)}
                        for name, recipe, part, off in zip(names, chosen, palette.shares, palette.differences)]
        self._finish(path, flavour)

    # Candidates, their points among the numbers by which they are chosen, and these numbers of a solid.

    def _by_colour(self) -> tuple[list[Recipe], numpy.ndarray, Callable[[ombre.Solid], list[Any]]]:
        candidates = self._rules.by_preset(len(self.filaments))
        points = numpy.array(lab_of(list(self._light(candidates).T))).T
        pure = points[:len(self.filaments)]
        far = [len(recipe) == 1 or float(numpy.linalg.norm(pure - point, axis=1).min()) > self._rules.direct
               for recipe, point in zip(candidates, points)]

        def numbers(solid: ombre.Solid) -> list[Any]:
            colour = ombre.attribute_of(solid, BY_COLOUR).vector
            return lab_of(light_of([colour.x, colour.y, colour.z], ombre.where), ombre.where)
        return [recipe for recipe, is_far in zip(candidates, far) if is_far], points[far], numbers

    def _by_shares(self) -> tuple[list[Recipe], numpy.ndarray, Callable[[ombre.Solid], list[Any]]]:
        candidates = self._rules.by_shares(len(self.filaments))

        def numbers(solid: ombre.Solid) -> list[Any]:
            names = ombre.Materials(_factory=current_factory()).names
            given = [(place, ombre.composition_of(solid, names[id]).share) for id, place in self._places.items()]
            total = sum(share for _, share in given)
            shares = [ombre.formula(sum(share for place, share in given if place == own) / total)
                      for own in range(len(self.filaments))]
            least = self._rules.least_share - 1e-9
            kept = [ombre.formula(ombre.where(share >= least, share, 0)) for share in shares]
            rest = ombre.formula(sum(kept[1:], kept[0]))
            return [ombre.where(rest > 0, part / rest, share) for part, share in zip(kept, shares)]
        return candidates, shares_of(candidates, len(self.filaments)), numbers

    def _light(self, recipes: list[Recipe]) -> numpy.ndarray:
        """Linear light of recipes: the mean of their layers'."""
        light = numpy.array(light_of(numpy.array([filament.colour for filament in self.filaments]).T / 255)).T
        return shares_of(recipes, len(self.filaments)) @ light

    def _colours(self, recipes: list[Recipe]) -> numpy.ndarray:
        return colour_of(self._light(recipes))

    def _values(self, scored: Node, voxel: Any, points: numpy.ndarray,
                progress: Callable[[float], Any]) -> tuple[numpy.ndarray, numpy.ndarray]:
        """The different values within the part, and how often each occurs."""
        design = scored._ombre_design_(self._table)
        scale = numpy.ptp(points, axis=0).max() / _steps or 1.0
        found: dict[tuple[int, ...], numpy.ndarray] = {}  # sums of values, and their counts
        for _, places in slabs(centers(design.bounds, voxel), progress):
            inside = places[design.inside(places)]
            if len(inside) == 0:
                continue
            values = numpy.stack([design.attribute(_score_name(n), inside) for n in range(points.shape[1])], axis=-1)
            bad = ~numpy.isfinite(values).all(axis=1)
            if bad.any():
                x, y, z = (float(c) for c in inside[bad][0])
                raise RuntimeError(f"{self._what}: there is no colour, or no filament's material, at ({x:g}, {y:g}, {z:g})")
            steps, places_of = numpy.unique(numpy.rint(values / scale).astype(int), axis=0, return_inverse=True)
            sums = numpy.zeros((len(steps), points.shape[1] + 1))
            numpy.add.at(sums, places_of.reshape(-1), numpy.concatenate([values, numpy.ones((len(values), 1))], axis=1))
            for row, total in zip(steps.tolist(), sums):
                step = tuple(int(n) for n in row)
                found[step] = found[step] + total if step in found else total
        if not found:
            raise RuntimeError(f"{self._what}: no voxel's centre lies in the part; choose a smaller voxel_size")
        totals = numpy.array([found[key] for key in sorted(found)])
        return totals[:, :-1] / totals[:, -1:], totals[:, -1]

    def _materials(self, recipes: list[Recipe]) -> tuple[MaterialDefs, list[str]]:
        """A table of the tree's materials, the filaments and mixtures, and the names of the recipes' materials in it."""
        taken: set[str] = set()
        filaments = [_free(filament.name, taken) for filament in self.filaments]
        # The tree names its materials by their ids.
        entries: list[dict[str, Any]] = [{"name": _free(entry["name"], taken), **_channels(entry["colour"])}
                                         for entry in self._table._entries()[1:]]
        entries += [{"name": name, "extruder": filament.slot, **_channels(filament.colour)}
                    for name, filament in zip(filaments, self.filaments)]
        if self._total > self.filaments[-1].slot:
            entries.append({"name": _free(f"filament {self._total}", taken), "extruder": self._total,
                            **_channels((128, 128, 128))})
        names = []
        for recipe, colour in zip(recipes, self._colours(recipes)):
            if len(recipe) == 1:
                names.append(filaments[recipe[0][0]])
                continue
            layers = {filaments[place]: count for place, count in recipe}
            names.append(_free(" + ".join(f"{count} {name}" for name, count in layers.items()), taken))
            entries.append({"name": names[-1], "mix_layers": layers, **_channels(colour)})
        return _OfEntries(entries), names

    def _finish(self, path: str, flavour: str) -> None:
        """Adds the report, and what the filaments say besides their colours."""
        report = json.dumps({"recipes": self.recipes}, indent=1).encode() + b"\n"
        rewrite(path, lambda name, content: self._extended(name, content, flavour), {_report: report})

    def _extended(self, name: str, content: bytes, flavour: str) -> bytes:
        by_slot = {filament.slot: filament for filament in self.filaments}
        slots = [by_slot.get(slot, Filament(slot, f"filament {slot}", (128, 128, 128), "", USUAL_NOZZLE))
                 for slot in range(1, self._total + 1)]
        nozzles, names = [f"{filament.nozzle:g}" for filament in slots], [filament.name for filament in slots]
        if name == "Metadata/Slic3r_PE.config":
            quoted = [name.replace("\\", "\\\\").replace('"', '\\"') for name in names]
            own = {"nozzle_diameter": ",".join(nozzles), "filament_settings_id": ";".join(f'"{name}"' for name in quoted)}
            return "".join(_with_value(line, own) for line in content.decode().splitlines(keepends=True)).encode()
        if name != "Metadata/project_settings.config":
            return content
        settings = json.loads(content)
        settings["nozzle_diameter"], settings["filament_settings_id"] = nozzles, names
        if any(filament.id for filament in slots):
            settings["filament_ids"] = [filament.id for filament in slots]
        return json.dumps(settings, indent=2).encode() + b"\n"


def _with_value(line: str, values: dict[str, str]) -> str:
    """A line of PrusaSlicer's settings, with its value of these."""
    key = line.removeprefix("; ").split(" = ", 1)[0]
    return f"; {key} = {values[key]}\n" if key in values else line


def _channels(colour: Any) -> dict[str, int]:
    return {channel: int(round(float(value))) for channel, value in zip("rgba", colour)}


def _free(name: str, taken: set[str]) -> str:
    """The name, or one with a number where it is taken; names do not depend on case."""
    free, n = name, 2
    while free.lower() in taken:
        free, n = f"{name} {n}", n + 1
    taken.add(free.lower())
    return free


class _OfEntries(MaterialDefs):
    """A table from the members of a materials file."""

    def __init__(self, entries: list[dict[str, Any]]) -> None:
        self._path = None
        self._read = table_of(entries)
        self._colors = {}


def rewrite(path: str, change: Callable[[str, bytes], bytes], added: dict[str, bytes] | None = None) -> None:
    """Changes the entries of an archive, and adds others, in place of the file; equal contents give equal bytes."""
    with zipfile.ZipFile(path) as archive:
        entries = [(entry, archive.read(entry)) for entry in archive.infolist()]
    beside = f"{path}.{os.getpid()}.part"
    with zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED) as archive:
        for entry, content in entries:
            archive.writestr(entry, change(entry.filename, content))
        for name, content in (added or {}).items():
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    os.replace(beside, path)
