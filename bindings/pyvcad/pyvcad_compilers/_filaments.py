"""Filaments, and mixtures of them that slicers print by changing from layer to layer."""
from __future__ import annotations

import itertools
import math
import os
import re
from typing import Any, NamedTuple

import numpy

from pyvcad._arguments import length, number

_most_filaments = 16
_longest_cycle = 6  # layers; slicers keep the shares of such cycles
_most_parts = 3
_members = {"color_hex", "slot", "nozzle_diameter_mm", "filament_settings_id", "filament_id"}
USUAL_NOZZLE = 0.4  # mm

# Which cycles the words of a preset stand for: numbers of filaments of a mixture in steps of 25 %.
PRESETS = {"conservative": 2, "expanded": 3}


class Filament(NamedTuple):
    slot: int  # its extruder, from 1
    name: str
    colour: tuple[int, int, int]  # red, green and blue, 0 to 255
    id: str
    nozzle: float  # mm


# Layers of filaments in a cycle, by their places in a list of filaments; a filament alone has one.
Recipe = tuple[tuple[int, int], ...]

USUAL = [{"color_hex": colour, "filament_settings_id": name}
         for name, colour in (("cyan", "#00FFFF"), ("magenta", "#FF00FF"), ("yellow", "#FFFF00"), ("black", "#000000"),
                              ("white", "#FFFFFF"))]


def filaments_of(what: str, given: Any) -> list[Filament]:
    """Reads dicts with "color_hex", and perhaps a slot and more, in the order of their slots."""
    entries = USUAL if given is None else list(given)
    if not entries:
        raise ValueError(f"{what}: expected at least one filament, such as {{\"color_hex\": \"#FF0000\", \"slot\": 1}}")
    filaments = sorted(_filament(what, entry, place) for place, entry in enumerate(entries, 1))
    slots = [filament.slot for filament in filaments]
    if len(set(slots)) < len(slots):
        raise ValueError(f"{what}: two filaments have one slot; expected a slot for each, found {slots}")
    return filaments


def _filament(what: str, entry: Any, place: int) -> Filament:
    where = f"{what}, filament {place}"
    if not isinstance(entry, dict):
        raise TypeError(f"{where}: expected a dict with \"color_hex\" and \"slot\", found {type(entry).__name__}")
    if entry.get("filament_profile_path"):
        raise ValueError(f"{where}: its filament_profile_path is not read; leave it out, and choose the profile in the slicer")
    unknown = sorted(set(entry) - _members - {"filament_profile_path"})
    if unknown:
        raise ValueError(f"{where}: there is no member {unknown[0]!r}; expected {', '.join(sorted(_members))}")
    slot = entry.get("slot", place)
    if isinstance(slot, bool) or not isinstance(slot, int) or not 1 <= slot <= _most_filaments:
        raise ValueError(f"{where}: expected a slot from 1 to {_most_filaments}, found {slot!r}")
    nozzle = length(entry.get("nozzle_diameter_mm", USUAL_NOZZLE))
    name = str(entry.get("filament_settings_id") or f"filament {slot}")
    return Filament(slot, name, _colour(where, entry.get("color_hex")), str(entry.get("filament_id") or ""), nozzle)


def _colour(where: str, text: Any) -> tuple[int, int, int]:
    if not isinstance(text, str) or not re.fullmatch("#?[0-9a-fA-F]{6}", text):
        raise ValueError(f"{where}: expected \"color_hex\" with six digits, such as \"#FF8000\", found {text!r}")
    digits = text[-6:]
    return int(digits[:2], 16), int(digits[2:4], 16), int(digits[4:], 16)


def hex_of(colour: Any) -> str:
    return "#" + "".join(f"{round(c):02X}" for c in colour)


class RecipeRules:
    """Which mixtures may be printed."""

    def __init__(self, what: str, preset: str, max_palette_size: int, min_component_percent: float,
                 max_recipe_components: int, direct_physical_delta_e: float) -> None:
        if preset not in PRESETS:
            raise ValueError(f"{what}, color_mix_recipe_preset: expected {' or '.join(map(repr, PRESETS))}, found {preset!r}")
        self.preset = preset
        self.most = _whole(what, "max_palette_size", max_palette_size)
        self.most_parts = min(_whole(what, "max_recipe_components", max_recipe_components), _most_parts)
        self.least_share = number(min_component_percent) / 100
        if not 0 <= self.least_share <= 1:
            raise ValueError(f"{what}, min_component_percent: expected 0 to 100, found {min_component_percent}")
        self.direct = number(direct_physical_delta_e)
        if self.direct < 0:
            raise ValueError(f"{what}, direct_physical_delta_e: expected 0 or more, found {direct_physical_delta_e}")

    def by_preset(self, count: int) -> list[Recipe]:
        """Recipes of so many filaments in steps of 25 %: pairs, and with "expanded" half of one with a quarter of two."""
        most = min(self.most_parts, PRESETS[self.preset])
        return self._recipes(count, most, lambda layers: 4 % layers == 0)

    def by_shares(self, count: int) -> list[Recipe]:
        """Recipes with all shares that a cycle can have."""
        return self._recipes(count, self.most_parts, lambda layers: True)

    def _recipes(self, count: int, most: int, takes: Any) -> list[Recipe]:
        found: list[Recipe] = [((place, 1),) for place in range(count)]
        for parts in range(2, min(most, count) + 1):
            cycles = [layers for layers in itertools.product(range(1, _longest_cycle), repeat=parts)
                      if sum(layers) <= _longest_cycle and math.gcd(*layers) == 1 and takes(sum(layers))
                      and min(layers) / sum(layers) >= self.least_share]
            found += [tuple(zip(places, layers)) for places in itertools.combinations(range(count), parts)
                      for layers in cycles]
        return found


def _whole(what: str, argument: str, value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise ValueError(f"{what}, {argument}: expected a whole number of 1 or more, found {value!r}")
    return value


def shares_of(recipes: list[Recipe], count: int) -> numpy.ndarray:
    """The share of each filament, of the shape (recipes, filaments)."""
    shares = numpy.zeros((len(recipes), count))
    for row, recipe in enumerate(recipes):
        for place, layers in recipe:
            shares[row, place] = layers / sum(layers for _, layers in recipe)
    return shares


def light_of(colour: Any, choose: Any = numpy.where) -> list[Any]:
    """Linear light of red, green and blue from 0 to 1 as sRGB has them (IEC 61966-2-1)."""
    return [choose(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4) for c in colour]


def colour_of(light: numpy.ndarray) -> numpy.ndarray:
    """The colour, 0 to 255, of linear light."""
    return 255 * numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def lab_of(light: Any, choose: Any = numpy.where) -> list[Any]:
    """CIE L*a*b* of linear light, for the white of sRGB (D65)."""
    r, g, b = light
    x = (0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047
    y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b
    z = (0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883
    fx, fy, fz = (choose(t > 216 / 24389, t ** (1 / 3), (24389 / 27 * t + 16) / 116) for t in (x, y, z))
    return [116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)]


class Palette(NamedTuple):
    """The recipes that a part uses."""

    chosen: list[int]  # their places among the candidates
    shares: list[float]  # how much of the part has each
    differences: list[float]  # the mean distance of the values that each stands for


def palette_of(values: numpy.ndarray, counts: numpy.ndarray, candidates: numpy.ndarray, most: int) -> Palette:
    """The candidates nearest to values of the shape (values, n), each of which occurs so often.

    Where more than `most` are nearest to some value, the ones that stand for least are left out one by one.
    """
    distances = numpy.stack([numpy.linalg.norm(values - candidate, axis=1) for candidate in candidates], axis=1)
    nearest = distances.argmin(axis=1)
    use = numpy.bincount(nearest, counts, minlength=len(candidates))
    while numpy.count_nonzero(use) > most:
        least = int(numpy.where(use > 0, use, numpy.inf).argmin())
        distances[:, least] = numpy.inf
        distances[:, use == 0] = numpy.inf
        moved = nearest == least
        nearest[moved] = distances[moved].argmin(axis=1)
        use = numpy.bincount(nearest, counts, minlength=len(candidates))
    chosen = [int(place) for place in numpy.flatnonzero(use)]
    off = numpy.bincount(nearest, counts * distances[numpy.arange(len(values)), nearest], minlength=len(candidates))
    return Palette(chosen, [float(use[place] / counts.sum()) for place in chosen],
                   [float(off[place] / use[place]) for place in chosen])
