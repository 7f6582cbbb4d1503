"""Materials by id: what designs name, and the tables that say which they are."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any

import ombre
from ombre._materials import current_factory, data_folder

from ._vectors import Vec4


class MaterialDefs:
    """A table of materials; id 0 is void, the others count from 1 in the order of the file.

    Args:
        path: a materials file (.json).

    Calling a table gives it back, so both `default_materials` and `default_materials()` work.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        if not os.path.exists(path):
            raise FileNotFoundError(f"MaterialDefs: there is no file {os.fspath(path)}")
        self._path: str | None = os.fspath(path)
        self._read: ombre.Materials | None = None
        self._colors: dict[int, tuple[int, int, int, int]] = {}  # colours that were changed

    def __call__(self) -> MaterialDefs:
        return self

    def _table(self) -> ombre.Materials:
        """The materials as files have them."""
        if self._read is None:
            self._read = ombre.Materials(self._path)
        return self._read

    def _materials(self) -> ombre.Materials:
        """The table that designs are compiled with; the same object until a colour changes."""
        if not self._colors:
            return self._table()
        if self._changed is None:
            self._changed = table_of([{"name": entry["name"], **_channels(self.color(entry["id"])),
                                       **entry["properties"]} for entry in self._entries()[1:]])
        return self._changed

    _changed: ombre.Materials | None = None

    def _entries(self) -> list[dict[str, Any]]:
        return [self._table()[i] for i in range(len(self._table()))]

    def _entry(self, key: int | str) -> dict[str, Any]:
        try:
            return self._table()[key if isinstance(key, str) else int(key)]
        except KeyError as error:
            raise KeyError(error.args[0]) from None

    def id(self, name: Any) -> int:
        """The id of a material by its name, whose case does not matter, or by its colour as a Vec4. Raises KeyError."""
        if isinstance(name, Vec4):
            return self._id_of_color(name)
        if not isinstance(name, str):
            raise TypeError(f"id: expected a material's name, found {type(name).__name__}")
        return int(self._entry(name)["id"])

    def _id_of_color(self, color: Vec4) -> int:
        scale = 255.0 if all(0 <= c <= 1 for c in color) else 1.0
        wanted = tuple(round(scale * c) for c in color)
        for entry in self._entries():
            if tuple(round(c) for c in self.color(entry["id"])) == wanted:
                return int(entry["id"])
        raise KeyError(f"there is no material of the colour {color!r}")

    def name(self, id: int) -> str:
        """The name of a material. Raises KeyError."""
        return str(self._entry(int(id))["name"])

    def color(self, key: int | str) -> Vec4:
        """Red, green, blue and opacity, 0 to 255, of an id or a name. Raises KeyError."""
        entry = self._entry(key)
        return Vec4(*self._colors.get(entry["id"], entry["colour"]))

    def contains(self, key: int | str) -> bool:
        return key in self._table()

    def num_materials(self) -> int:
        """How many there are, without void."""
        return len(self._table()) - 1

    def palette(self) -> dict[int, Vec4]:
        """{id: colour}, with void."""
        return {entry["id"]: self.color(entry["id"]) for entry in self._entries()}

    def prescaled_color_list(self) -> list[Vec4]:
        """The colours by id, 0 to 255, with void."""
        return list(self.palette().values())

    def update_color(self, key: int | str, color: Any) -> None:
        """Changes a colour: red, green, blue and perhaps opacity, 0 to 255."""
        channels = [round(c) for c in color]
        if len(channels) == 3:
            channels.append(255)
        if len(channels) != 4 or not all(0 <= c <= 255 for c in channels):
            raise ValueError(f"update_color: expected red, green, blue and opacity, 0 to 255, found {tuple(color)}")
        entry = self._entry(key)
        if entry["id"] == 0:
            raise ValueError("update_color: void has no colour to change")
        red, green, blue, opacity = channels
        self._colors[entry["id"]] = red, green, blue, opacity
        self._changed = None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(self._table().names[1:])})"


class _DefaultMaterials(MaterialDefs):
    """The materials that come with Ombre, or those of the `ombre.Materials` in use."""

    def __init__(self) -> None:
        self._path = None
        self._read = None
        self._colors = {}

    def _table(self) -> ombre.Materials:
        factory = current_factory()
        if self._read is None or self._read._factory is not factory:
            self._read, self._changed = ombre.Materials(_factory=factory), None
        return self._read


class _ShippedMaterials(MaterialDefs):
    """A file of the folder `materials`, read when it is first asked for."""

    def __init__(self, name: str, other_names: dict[str, str]) -> None:
        self._path = os.path.join(resources_path(), "materials", name + ".json")
        self._read = None
        self._colors = {}
        self._other_names = other_names

    def _entry(self, key: int | str) -> dict[str, Any]:
        return super()._entry(self._other_names.get(key.lower(), key) if isinstance(key, str) else key)

    def contains(self, key: int | str) -> bool:
        return super().contains(self._other_names.get(key.lower(), key) if isinstance(key, str) else key)


def expect_table(what: str, value: Any) -> MaterialDefs | None:
    """A MaterialDefs or None. Raises TypeError."""
    if value is not None and not isinstance(value, MaterialDefs):
        raise TypeError(f"{what}: expected a MaterialDefs, found {type(value).__name__}; "
                        "write for example pyvcad.default_materials")
    return value


def _channels(color: Vec4) -> dict[str, int]:
    return {channel: int(value) for channel, value in zip("rgba", color)}


def table_of(entries: list[dict[str, Any]]) -> ombre.Materials:
    """A table made from the members of a materials file."""
    with tempfile.TemporaryDirectory(prefix="ombre_") as folder:
        path = os.path.join(folder, "materials.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"materials": entries}, file)
        return ombre.Materials(path)


def numbered(count: int) -> ombre.Materials:
    """A table of `count` materials that are known by their ids only."""
    return table_of([{"name": f"material {i}", "r": 128, "g": 128, "b": 128, "a": 255} for i in range(1, count + 1)])


def resources_path() -> str:
    """The folder that holds materials and printers."""
    return str(data_folder())


default_materials = _DefaultMaterials()
j750_materials = _ShippedMaterials("j750", {"veroyl-v": "VeroYellow", "verocy-v": "VeroCyan", "veromgt-v": "VeroMagenta",
                                            "veromgnt": "VeroMagenta"})
