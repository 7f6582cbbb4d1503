"""Volumes: grids of numbers from files of OpenVDB, DICOM and PNG, as attributes take them."""
from __future__ import annotations

import enum
import os
from typing import Any

import numpy

import ombre

from ._arguments import Optional, Point, boolean, instance_of, length, number, read, size, text
from ._vectors import Vec2, Vec3, Vec4


class Volume:
    """A grid of numbers, or of several in each voxel. Beyond the grid they are those at its side."""

    _type, _size = "", 1

    def __init__(self, path: str, options: dict[str, Any] | None = None, center: bool = False, series: str = "",
                 change: tuple[float, float] = (1.0, 0.0), margin: float = 0.0) -> None:
        """`change` converts the file's numbers by a factor and a sum; `margin` is the number of voxels at each
        side that are not from the file."""
        self._path, self._options, self._series, self._change = path, dict(options or {}), series, change
        info = ombre.volume_info(path, series or None, None if self._size == 1 else 0)
        if self._size > 1 and info["channels"] < self._size:
            raise ValueError(f"{type(self).__name__}: expected {self._size} values in each voxel of {path}, found "
                             f"{info['channels']:.0f}")
        self._count = tuple(int(n) for n in info["size"])
        self._steps = self._read_steps(info)
        self._origin = numpy.array(self._options.get("origin", info.get("origin_mm", (0.0, 0.0, 0.0))), dtype=float)
        self._margin = margin
        self._range = info["least"], info["greatest"]
        self._values: dict[int, ombre.Expression] = {}
        if center:
            low, high = self._corners()
            self._origin = self._origin - (low + high) / 2
            self._options["origin"] = tuple(float(v) for v in self._origin)

    def _read_steps(self, info: dict[str, Any]) -> numpy.ndarray:
        steps = numpy.array(info.get("steps_mm", numpy.eye(3)), dtype=float)
        if "spacing" in self._options:
            lengths = numpy.linalg.norm(steps, axis=1)
            steps = steps * (numpy.array(self._options["spacing"]) / lengths)[:, None]
        elif "steps_mm" not in info:
            raise ValueError(f"{self._path} does not say how large its voxels are")
        return steps

    def _corners(self) -> tuple[numpy.ndarray, numpy.ndarray]:
        rim = 0.5 - self._margin
        ends = numpy.array([(-rim, n - 1 + rim) for n in self._count])
        corners = numpy.array([[ends[0][i & 1], ends[1][i >> 1 & 1], ends[2][i >> 2]] for i in range(8)])
        places = corners @ self._steps + self._origin
        return places.min(axis=0), places.max(axis=0)

    def _component(self, channel: int) -> ombre.Expression:
        """One of its numbers, as a value over space."""
        if channel not in self._values:
            options: dict[str, Any] = {**self._options, "clamp": True}
            if self._series:
                options["series"] = self._series
            if self._size > 1:
                options["channel"] = channel
            value: Any = ombre.volume(self._path, **options)
            factor, add = self._change
            self._values[channel] = value.value if (factor, add) == (1.0, 0.0) else factor * value.value + add
        return self._values[channel]

    def _sample(self, x: float, y: float, z: float) -> list[float]:
        """Interpolates linearly between voxels' centres along each axis."""
        return [float(self._component(n)([[x, y, z]])[0]) for n in range(self._size)]

    def bounding_box(self) -> tuple[Vec3, Vec3]:
        """The least and the greatest corner of a box that encloses its voxels, mm."""
        low, high = self._corners()
        return Vec3(*map(float, low)), Vec3(*map(float, high))

    def grid_type(self) -> str:
        return self._type

    def clone(self) -> Any:
        """Returns the volume itself: volumes do not change."""
        return self


class FloatVolume(Volume):
    """A number in each voxel."""

    _type = "float"

    def sample(self, x: float, y: float, z: float) -> float:
        return self._sample(x, y, z)[0]


class Vec2sVolume(Volume):
    """Two numbers in each voxel."""

    _type, _size = "vec2s", 2

    def sample(self, x: float, y: float, z: float) -> Vec2:
        return Vec2(*self._sample(x, y, z))


class Vec3sVolume(Volume):
    """Three numbers in each voxel."""

    _type, _size = "vec3s", 3

    def sample(self, x: float, y: float, z: float) -> Vec3:
        return Vec3(*self._sample(x, y, z))


class Vec4sVolume(Volume):
    """Four numbers in each voxel: red, green, blue and opacity of colours."""

    _type, _size = "vec4s", 4

    def sample(self, x: float, y: float, z: float) -> Vec4:
        return Vec4(*self._sample(x, y, z))


def _found(what: str, path: str) -> str:
    """A file or folder, relative to the script, then to the working directory. Raises FileNotFoundError."""
    from ._tree import _call_place
    script = _call_place()[0]
    for folder in (os.path.dirname(os.path.abspath(script)), os.getcwd()):
        if os.path.exists(os.path.join(folder, path)):
            return os.path.normpath(os.path.join(folder, path))
    raise FileNotFoundError(f"{what}: there is no {path}, neither beside {os.path.basename(script)} nor in {os.getcwd()}")


def _load(kind: type[Volume], name: str, arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
    form = {"path": text, "grid": text, "center": Optional(boolean, False)}
    values = read(name, (form,), arguments, named)
    return kind(_found(name, values["path"]), None, values["center"], values["grid"], margin=1.0)


class vdb_loader:
    """Named grids of a .vdb file: vdb_loader.load_float_volume(path, grid, center=False)."""

    @staticmethod
    def load_float_volume(*arguments: Any, **named: Any) -> FloatVolume:
        volume: FloatVolume = _load(FloatVolume, "load_float_volume", arguments, named)
        return volume

    @staticmethod
    def load_vec3s_volume(*arguments: Any, **named: Any) -> Vec3sVolume:
        volume: Vec3sVolume = _load(Vec3sVolume, "load_vec3s_volume", arguments, named)
        return volume

    @staticmethod
    def load_vec4s_volume(*arguments: Any, **named: Any) -> Vec4sVolume:
        volume: Vec4sVolume = _load(Vec4sVolume, "load_vec4s_volume", arguments, named)
        return volume


class DICOMLoader:
    """A scan: DICOMLoader(directory, center=False); slope, intercept and lengths in mm that are given go before the
    files'. Places are the scanner's: x to the patient's left, y to the back, z to the head."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        given = Optional(number, None)
        form = {"directory": text, "center": Optional(boolean, False), "rescale_slope": given, "rescale_intercept": given,
                "slice_thickness": Optional(length, None), "x_pixel_spacing": Optional(length, None),
                "y_pixel_spacing": Optional(length, None)}
        values = read("DICOMLoader", (form,), arguments, named)
        self._path = _found("DICOMLoader", values["directory"])
        info = ombre.volume_info(self._path)
        own = float(info["slope"]), float(info["intercept"])
        self._slope = own[0] if values["rescale_slope"] is None else values["rescale_slope"]
        self._intercept = own[1] if values["rescale_intercept"] is None else values["rescale_intercept"]
        factor = self._slope / own[0]
        lengths = [float(numpy.linalg.norm(step)) for step in info["steps_mm"]]
        for axis, name in enumerate(("x_pixel_spacing", "y_pixel_spacing", "slice_thickness")):
            lengths[axis] = lengths[axis] if values[name] is None else values[name]
        self._lengths = lengths
        self._volume = FloatVolume(self._path, {"spacing": tuple(lengths)}, values["center"],
                                   change=(factor, self._intercept - factor * own[1]))

    def as_volume(self) -> FloatVolume:
        """Numbers of the scan, with slope and intercept."""
        return self._volume

    def get_bounding_box(self) -> tuple[Vec3, Vec3]:
        return self._volume.bounding_box()

    def get_dimensions(self) -> tuple[int, ...]:
        """Columns, rows and slices."""
        return self._volume._count

    def get_voxel_size(self) -> Vec3:
        return Vec3(*self._lengths)

    def get_min_max_hu(self) -> tuple[float, float]:
        factor, add = self._volume._change
        low, high = sorted(factor * value + add for value in self._volume._range)
        return low, high

    def get_rescale_slope(self) -> float:
        return self._slope

    def get_rescale_intercept(self) -> float:
        return self._intercept


class PNGColorMode(enum.Enum):
    COLOR_RGB = 3
    COLOR_RGBA = 4


_mode = instance_of(PNGColorMode)


class PNGLoader:
    """Coloured images: PNGLoader.FromImage(path, voxel_size, depth_mm, mode, center=False), the same picture at all
    depths, and PNGLoader.FromStack(directory, voxel_size, mode, center=False), in the order of the numbers in their
    names, from the lowest layer up. x grows to the right and y upwards; the first voxel begins at the origin."""

    def __init__(self, path: str, lengths: Point, mode: PNGColorMode, center: bool) -> None:
        self._path, self._mode, self._center = path, mode, center
        self._options = {"spacing": lengths, "origin": tuple(step / 2 for step in lengths)}

    @staticmethod
    def FromImage(*arguments: Any, **named: Any) -> PNGLoader:
        form = {"path": text, "voxel_size": size, "depth_mm": length, "mode": _mode, "center": Optional(boolean, False)}
        values = read("PNGLoader.FromImage", (form,), arguments, _with_mode(named))
        x, y, _ = values["voxel_size"]
        return PNGLoader(_found("PNGLoader", values["path"]), (x, y, values["depth_mm"]), values["mode"],
                         values["center"])

    @staticmethod
    def FromStack(*arguments: Any, **named: Any) -> PNGLoader:
        form = {"directory": text, "voxel_size": size, "mode": _mode, "center": Optional(boolean, False)}
        values = read("PNGLoader.FromStack", (form,), arguments, _with_mode(named))
        return PNGLoader(_found("PNGLoader", values["directory"]), values["voxel_size"], values["mode"], values["center"])

    def as_rgba_volume(self) -> Vec4sVolume:
        """Red, green, blue and opacity, 0 to 1; images without opacity are opaque."""
        if self._mode is not PNGColorMode.COLOR_RGBA:
            raise ValueError("as_rgba_volume: this loader drops opacity; use PNGColorMode.COLOR_RGBA")
        return Vec4sVolume(self._path, self._options, self._center, change=(1 / 255, 0.0))

    def as_rgb_volume(self) -> Vec3sVolume:
        """Red, green and blue, 0 to 1."""
        return Vec3sVolume(self._path, self._options, self._center, change=(1 / 255, 0.0))


def _with_mode(named: dict[str, Any]) -> dict[str, Any]:
    """Returns the mode, whatever its name is."""
    return {"mode" if isinstance(value, PNGColorMode) else name: value for name, value in named.items()}
