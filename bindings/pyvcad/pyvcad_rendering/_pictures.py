"""Pictures, and frames of pictures that move."""
from __future__ import annotations

import difflib
import importlib
import math
import os
import shutil
import subprocess
import tempfile
import warnings
from typing import Any

import ombre
from pyvcad._arguments import Point, length, number, vector
from pyvcad._errors import missing
from pyvcad._materials import expect_table
from pyvcad._tree import Node, Unary, as_node

_rays = {"low": 1, "medium": 2, "high": 3, "ultra": 4}
_palettes = {"auto": None, "viridis": "viridis", "plasma": "plasma", "inferno": "inferno", "magma": "magma",
             "grayscale": "gray"}


_used = ("quality", "visualized_attribute", "scale_bar_palette", "scale_bar_visible", "scalar_range_mode", "scalar_range_min",
         "scalar_range_max", "background_color", "transparent_background", "clipping_plane", "clipping_plane_origin",
         "clipping_plane_normal", "camera_position", "camera_focal_point", "show_orientation_marker", "render_mode",
         "use_blending")
# Settings that are accepted, and warned of where they would show something else.
_without_effect = ("show_bbox", "show_origin", "use_vol_shading", "scale_bar_show_annotations", "camera_state",
                   "camera_view_up")


class RenderSettings:
    """Settings of pictures by their names: RenderSettings(quality="high", visualized_attribute="modulus").

    quality (low, medium, high, ultra), visualized_attribute, scale_bar_palette, scale_bar_visible, scalar_range_mode (auto,
    fixed) with scalar_range_min and _max, background_color, transparent_background, clipping_plane with
    clipping_plane_origin and _normal, camera_position with camera_focal_point, which give the direction of view,
    show_orientation_marker.
    """

    def __init__(self, **settings: Any) -> None:
        _check_settings(settings, 3)
        self.__dict__.update(settings)


def _check_settings(settings: Any, depth: int) -> None:
    """Raises TypeError for unknown settings and ValueError for unknown modes; warns of settings without effect."""
    given = settings if isinstance(settings, dict) else vars(settings) if settings is not None else {}
    for name in given:
        if name not in (*_used, *_without_effect):
            close = difflib.get_close_matches(name, [*_used, *_without_effect], 1)
            hint = f"did you mean {close[0]!r}?" if close else f"expected {', '.join(_used)}"
            raise TypeError(f"settings of pictures: there is no {name!r}; {hint}")
    for name, modes in (("render_mode", ("iso_surface", "volumetric")), ("scalar_range_mode", ("auto", "fixed"))):
        if given.get(name) not in (None, *modes):
            raise ValueError(f"{name}: expected {' or '.join(modes)}, found {given[name]!r}")
    idle = [name for name in _without_effect if given.get(name)]
    idle += ["render_mode"] * (given.get("render_mode") == "volumetric") + ["use_blending"] * (given.get("use_blending") is False)
    if idle:
        warnings.warn(f"settings of pictures without effect: {', '.join(idle)}", stacklevel=depth)


def _setting(settings: Any, name: str, default: Any = None) -> Any:
    return settings.get(name, default) if isinstance(settings, dict) else getattr(settings, name, default)


def first_scaled_attribute(node: Node) -> str | None:
    """The first attribute of the tree that is a number and not the same everywhere, by whose values parts are coloured."""
    design = node._design()
    for name in node.attribute_list():
        if name == "volume_fractions" or name not in design.attributes:
            continue
        low, high = design.bounds
        points = [[a + (b - a) * share for a, b, share in zip(low, high, shares)] for shares in _places]
        inside = [p for p, d in zip(points, design.distance(points)) if d <= 0]
        if not inside:
            continue
        values = design.attribute(name, inside)
        if values.ndim == 1 and float(values.max()) > float(values.min()):
            return name
    return None


def shown_attribute(node: Node) -> str | None:
    """The attribute that parts are coloured by: a colour, else the first number that is not the same everywhere."""
    own = node.attribute_list()
    return next((name for name in ("color_rgba", "color_rgb") if name in own), None) or first_scaled_attribute(node)


# Places in a box, off its planes of symmetry.
_places = [((0.31 + 7 * n % 17) / 17, (0.43 + 11 * n % 19) / 19, (0.57 + 5 * n % 23) / 23) for n in range(200)]


def options_of(node: Node, settings: Any, width: int, height: int) -> dict[str, Any]:
    """Returns the options of `ombre render`."""
    _check_settings(settings, 4)
    options: dict[str, Any] = {"size": f"{int(width)}x{int(height)}", "force": True}
    quality = _setting(settings, "quality", "medium")
    if quality not in _rays:
        raise ValueError(f"quality: expected {', '.join(_rays)}, found {quality!r}")
    options["aa"] = _rays[quality]
    _add_colours(node, settings, options)
    plane = _plane(settings)
    if plane and len(_axes_of(plane[1])) == 1:
        options["cut"] = _cut(*plane)
    position, focus = _setting(settings, "camera_position"), _setting(settings, "camera_focal_point", (0, 0, 0))
    if position is not None:
        options["from_"] = _direction([number(a) - number(b) for a, b in zip(position, focus or (0, 0, 0))])
    if _setting(settings, "show_orientation_marker", False):
        options["axes"] = True
    return options


def _add_colours(node: Node, settings: Any, options: dict[str, Any]) -> None:
    name = _setting(settings, "visualized_attribute")
    if name is None and "volume_fractions" not in node.attribute_list():
        name = shown_attribute(node)
    if name and name not in ("none", "Signed Distance", "volume_fractions"):
        options["by"] = name
        options["legend"] = bool(_setting(settings, "scale_bar_visible", True))
        palette = _setting(settings, "scale_bar_palette", "auto")
        if palette not in _palettes:
            raise missing(f"the palette {palette!r}", f"one of {', '.join(_palettes)}")
        if _palettes[palette]:
            options["palette"] = _palettes[palette]
        if _setting(settings, "scalar_range_mode", "auto") == "fixed":
            low, high = _setting(settings, "scalar_range_min"), _setting(settings, "scalar_range_max")
            options["range"] = f"{number(low):g},{number(high):g}"
    if _setting(settings, "transparent_background", False):
        options["background"] = "transparent"
    elif _setting(settings, "background_color") is not None:
        channels = [round(255 * min(1.0, max(0.0, number(c)))) for c in _setting(settings, "background_color")]
        options["background"] = "#" + "".join(f"{c:02x}" for c in channels[:3])


def _plane(settings: Any) -> tuple[Point, Point] | None:
    """A point of the clipping plane and its normal, which points to the side that is taken away."""
    if not _setting(settings, "clipping_plane", False):
        return None
    normal = vector(_setting(settings, "clipping_plane_normal", None) or (1, 0, 0))
    if not any(normal):
        raise ValueError("clipping_plane_normal: expected a direction, found (0, 0, 0)")
    return vector(_setting(settings, "clipping_plane_origin", None) or (0, 0, 0)), normal


def _axes_of(normal: Point) -> list[int]:
    return [n for n, c in enumerate(normal) if abs(c) > 1e-9 * max(abs(other) for other in normal)]


def _cut(origin: Point, normal: Point) -> str:
    """The cut across an axis that takes away the side to which the normal points."""
    axis = _axes_of(normal)[0]
    return f"{'xyz'[axis]}{'>' if normal[axis] > 0 else '<'}{origin[axis]:g}"


class _Clipped(Unary):
    """The child behind a plane."""

    def __init__(self, child: Node, origin: Point, normal: Point) -> None:
        super().__init__(child)
        self._origin, self._normal = origin, normal

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        size = math.sqrt(sum(c * c for c in self._normal))
        offset = sum(a * b for a, b in zip(self._origin, self._normal)) / size
        return ombre.intersection([solids[0], ombre.half_space(self._normal, offset)], materials="first")


def _clipped(root: Any, settings: Any) -> Node:
    """The part, without what lies before a clipping plane that is not across an axis; the others are cuts of pictures."""
    node, plane = as_node(root), _plane(settings)
    return node if plane is None or len(_axes_of(plane[1])) == 1 else _Clipped(node, *plane)


def _direction(way: list[float]) -> str:
    """Azimuth and elevation of a way from the part to the eye."""
    x, y, z = way
    if math.hypot(x, y, z) == 0:
        raise ValueError("camera_position: expected a point other than camera_focal_point")
    return f"{math.degrees(math.atan2(x, -y)) % 360:g},{math.degrees(math.atan2(z, math.hypot(x, y))):g}"


def Render_Image(root: Any, file: str | os.PathLike[str], settings: Any = None, width: int = 1920, height: int = 1080,
                 materials: Any = None) -> None:
    """Writes a picture (.png). `settings` is a RenderSettings or a dict.

    Parts with attributes but no materials have their colours, or those of the first attribute that varies.
    """
    expect_table("Render_Image", materials)
    node = _clipped(root, settings)
    node._ombre_design_(materials).render(os.fspath(file), **options_of(node, settings, width, height))


def _written(frames: list[str], output: str, output_format: str, fps: float) -> None:
    """Joins frames to a moving picture: gif and webp by Pillow, the others by ffmpeg."""
    if output_format in ("gif", "webp"):
        try:
            Image = importlib.import_module("PIL.Image")
        except ImportError:
            raise missing(f"a .{output_format} without Pillow", "install python3-pil, or keep_frames=True") from None
        pictures = [Image.open(frame).convert("RGB") for frame in frames]
        pictures[0].save(output, save_all=True, append_images=pictures[1:], duration=round(1000 / fps), loop=0)
        return
    if shutil.which("ffmpeg") is None:
        raise missing(f"a .{output_format} without ffmpeg", 'output_format="gif"')
    with tempfile.NamedTemporaryFile("w", suffix=".txt", delete=False) as names:
        names.write("".join(f"file '{os.path.abspath(frame)}'\nduration {1 / fps}\n" for frame in frames))
    try:
        subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-f", "concat", "-safe", "0", "-i", names.name, output],
                       check=True)
    finally:
        os.unlink(names.name)


def _formats(output_format: str) -> list[str]:
    known = ["gif", "webp", "mp4", "webm"]
    if output_format not in (*known, "all"):
        raise ValueError(f"output_format: expected {', '.join(known)} or all, found {output_format!r}")
    return known if output_format == "all" else [output_format]


def _animated(name: str, output_dir: Any, make: Any, count: int, fps: float, output_format: str, keep_frames: bool,
              order: list[int]) -> None:
    """Makes frames by `make(number, path)`, and joins them in the order."""
    formats, folder = _formats(output_format), os.fspath(output_dir)
    os.makedirs(folder, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="ombre_") as scratch:
        frames = [os.path.join(scratch, f"{name}_{n:04}.png") for n in range(count)]
        for n, frame in enumerate(frames):
            make(n, frame)
        if keep_frames:
            for frame in frames:
                shutil.copy(frame, folder)
        for one in formats:
            _written([frames[n] for n in order], os.path.join(folder, f"{name}.{one}"), one, fps)


def Render_Turntable_Animation(root: Any, output_dir: Any, duration: float = 3.0, fps: int = 30,
                               distance_multiplier: float = 1.5, elevation_angle_deg: float = 30.0, settings: Any = None,
                               width: int = 1920, height: int = 1080, output_format: str = "gif",
                               keep_frames: bool = False, materials: Any = None) -> None:
    """Writes turntable.gif (or .webp, .mp4, .webm, all): the eye goes once around the part.

    A distance_multiplier of 1.5 shows the part as large as pictures do.
    """
    expect_table("Render_Turntable_Animation", materials)
    node = _clipped(root, settings)
    design, count = node._ombre_design_(materials), max(2, round(length(float(duration)) * fps))
    options = options_of(node, settings, width, height)

    def make(n: int, path: str) -> None:
        own: dict[str, Any] = {**options, "from_": f"{360 * n / count:g},{number(elevation_angle_deg):g}",
                               "zoom": 1.5 / length(float(distance_multiplier))}
        design.render(path, **own)
    _animated("turntable", output_dir, make, count, fps, output_format, keep_frames, list(range(count)))


def Render_Sweep_Animation(root: Any, output_dir: Any, axis: str = "z", duration: float = 3.0, fps: int = 30,
                           loop: bool = False, pause_seconds: float = 0.5, settings: Any = None, width: int = 1920,
                           height: int = 1080, output_format: str = "gif", keep_frames: bool = False,
                           materials: Any = None) -> None:
    """Writes sweep.gif (or .webp, .mp4, .webm, all): a cut across the axis goes through the part; with loop, and back."""
    expect_table("Render_Sweep_Animation", materials)
    if axis not in ("x", "y", "z"):
        raise ValueError(f'axis: expected "x", "y" or "z", found {axis!r}')
    node = _clipped(root, settings)
    design, count = node._ombre_design_(materials), max(2, round(length(float(duration)) * fps))
    options, along = options_of(node, settings, width, height), "xyz".index(axis)
    low, high = design.bounds[0][along], design.bounds[1][along]

    def make(n: int, path: str) -> None:
        at = low + (high - low) * (n + 1) / count
        cuts = clipping + ([] if n + 1 == count else [f"{axis}>{at:.9g}"])
        own: dict[str, Any] = {"cut": cuts} if cuts else {}
        design.render(path, **options, **own)
    clipping = [options.pop("cut")] if "cut" in options else []
    order = list(range(count)) + [count - 1] * round(pause_seconds * fps)
    _animated("sweep", output_dir, make, count, fps, output_format, keep_frames, order + (order[::-1] if loop else []))


def VisualizeSDF(root: Any, z_height: float = 0.0, resolution: int = 256, iso_surface: bool = True,
                 path: str | os.PathLike[str] = "distance.png") -> None:
    """Writes a picture of the distances in a plane z, with a line at the surface; it needs matplotlib.

    Args:
        resolution: points along the longer side.
    """
    try:
        pyplot = importlib.import_module("matplotlib.pyplot")
    except ImportError:
        raise missing("VisualizeSDF without matplotlib", "node.toSignedDistanceArray gives the distances") from None
    import numpy
    node = as_node(root)
    (x0, y0, _), (x1, y1, _) = node._design().bounds
    x, y = numpy.linspace(x0, x1, resolution), numpy.linspace(y0, y1, resolution)
    points = numpy.stack(numpy.meshgrid(x, y, [float(z_height)], indexing="ij"), axis=-1)[:, :, 0]
    distances = node._design().distance(points)
    figure, axes = pyplot.subplots()
    shown = axes.pcolormesh(x, y, distances.T, shading="nearest", cmap="coolwarm")
    figure.colorbar(shown, label="mm")
    if iso_surface:
        axes.contour(x, y, distances.T, levels=[0])
    axes.set_aspect("equal")
    figure.savefig(os.fspath(path))
    pyplot.close(figure)


