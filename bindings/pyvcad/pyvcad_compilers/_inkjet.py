"""The compilers of material inkjet printers: of fractions of materials, and of colours."""
from __future__ import annotations

import enum
import json
import os
import struct
import tempfile
import time
from typing import Any, Literal

import ombre
from pyvcad._arguments import number
from pyvcad._defined import FRACTIONS, are_everywhere, marked, marked_design, marker
from pyvcad._keep_out import KeepOut
from pyvcad._materials import MaterialDefs, default_materials, expect_table, j750_materials
from pyvcad._resolvers import numbers_of
from pyvcad._solids import with_unset
from pyvcad._tree import Node, Unary, as_node

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path, _place, _voxel


class MaterialInkjetExportMode(enum.Enum):
    STOCHASTIC = 0
    DITHERED_3D = 1


class ColorInkjetExportMode(enum.Enum):
    STOCHASTIC = 0
    DITHERED_3D = 1


class _InkjetCompiler(_AttributeCompiler):
    """Writes an image for each layer, in the colours of the materials.

    Layers that are empty at both ends are left out. Images are not flipped, and draws have the seed 0, so that two runs give
    the same bytes.
    """

    _materials: MaterialDefs | None

    def __init__(self, root: Any, voxel_size: Any, output_directory: Path, file_prefix: str, mode: enum.Enum) -> None:
        self._root, self._voxel = as_node(root), _voxel(type(self).__name__, voxel_size)
        (self._folder, self._prefix), self._mode = _place(output_directory, file_prefix), mode
        self._counts: dict[int, int] = {}
        self._resolution = (0, 0, 0)
        self._stats: list[tuple[str, Any]] = []

    def _tree(self) -> Node:
        """Returns the tree with materials that is printed."""
        raise NotImplementedError

    def compile(self) -> None:
        self._check_attributes()
        begin = time.monotonic()
        self._check_strictly(self._required)
        design = self._tree()._ombre_design_(self._materials)
        prepared = time.monotonic()
        dither: Literal["stochastic", "diffusion"] = "stochastic" if self._mode.name == "STOCHASTIC" else "diffusion"
        with self._new_files(self._folder) as made, tempfile.TemporaryDirectory(prefix="ombre_", dir=self._folder) as work:
            job = os.path.join(work, "job")
            self._share(0.0)
            design.slice(job, voxel=self._voxel, dither=dither, progress=self._share)
            self._take(job, made)
        self._stats = [("box", design.bounds), ("voxel size, mm", self._voxel), ("pixels and layers", self._resolution),
                       ("voxels", sum(self._counts.values())), ("preparing, s", round(prepared - begin, 3)),
                       ("slicing and writing, s", round(time.monotonic() - prepared, 3))]
        self._report(1.0)

    def resolution(self) -> tuple[int, int, int]:
        return self._resolution

    def material_voxel_counts(self) -> dict[int, int]:
        return dict(self._counts)

    def report_stats(self) -> None:
        """Prints figures of the last compile()."""
        for name, value in self._stats:
            print(f"{name}: {value}")

    def _take(self, job: str, made: str) -> None:
        """Moves the images out of the job into the folder, and counts."""
        with open(os.path.join(job, "job.json"), encoding="utf-8") as file:
            ids = [material["id"] for material in json.load(file)["materials"]][1:]
        with open(os.path.join(job, "journal.jsonl"), encoding="utf-8") as file:
            entries = [json.loads(line) for line in file]
        layers = sorted((entry for entry in entries if "layer" in entry), key=lambda entry: int(entry["layer"]))
        filled = [n for n, entry in enumerate(layers) if sum(entry["voxels"])]
        kept = layers[filled[0]:filled[-1] + 1] if filled else []
        width = height = 0
        for n, entry in enumerate(kept):
            path = os.path.join(made, f"{self._prefix}{n}.png")
            os.replace(os.path.join(job, entry["files"][0]["file"]), path)
            if n == 0:
                with open(path, "rb") as image:
                    width, height = struct.unpack(">II", image.read(24)[16:])
        self._counts = {id: count for i, id in enumerate(ids) if (count := sum(entry["voxels"][i] for entry in kept))}
        self._resolution = (width, height, len(kept))


class MaterialInkjetCompiler(_InkjetCompiler):
    """Writes images of "volume_fractions": PREFIX0.png, ...

    Args:
        liquid_keep_out_distance: mm from the surface, within which mixtures hold no liquid; 0: it may be anywhere.
    """

    _required = ("volume_fractions",)

    def __init__(self, root: Any, voxel_size: Any, output_directory: Path, file_prefix: str, material_defs: Any,
                 liquid_keep_out_distance: float = 0.0,
                 export_mode: MaterialInkjetExportMode = MaterialInkjetExportMode.STOCHASTIC) -> None:
        super().__init__(root, voxel_size, output_directory, file_prefix, export_mode)
        self._materials = expect_table("MaterialInkjetCompiler", material_defs)
        self._keep_out = number(liquid_keep_out_distance)
        self._fallback = 0

    def set_fallback_material_id(self, id: int) -> None:
        """Sets the material of places without any; 0, the void, at first."""
        (self._materials or default_materials).name(id)  # raises an error if there is none
        self._fallback = id

    def _tree(self) -> Node:
        tree: Node = self._root
        if not are_everywhere(tree, [FRACTIONS]):
            tree = _Completed(tree, self._fallback)
        return KeepOut(tree, self._keep_out, self._materials) if self._keep_out > 0 else tree


class _Completed(Unary):
    """The part, of the fallback material where nothing says of what it is."""

    def __init__(self, part: Node, fallback: int) -> None:
        super().__init__(with_unset(marked(part), fallback))
        self._is_said = marker(FRACTIONS) in marked_design(part).attributes
        self._fallback = fallback

    def _fractions(self) -> set[int] | None:
        return {*self._inputs()[0].material_list(), self._fallback}

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        said, filled = solids[0], ombre.material(solids[0], self._fallback)
        if not self._is_said:
            return filled
        low, high = said.bounds
        gaps = ombre.function(ombre.attribute_of(said, marker(FRACTIONS)).value - 0.5, self._fallback, min=low, max=high)
        # The first one lies in the second, so that they have its distances together.
        return ombre.union([ombre.intersection([filled, gaps], materials="first"), said], materials="first")


_inks = ("VeroCyan", "VeroMagenta", "VeroYellow", "VeroBlack", "VeroPureWht")
_clear = "VeroClear"
_color = "color_rgba"


class _Coloured(Unary):
    """The part, of the materials that show its attribute color_rgba.

    Args:
        fallback: the colour where nothing gives one.
        profile: the path of an ICC profile of cyan, magenta, yellow and black; None: by the mean of their light.
    """

    def __init__(self, part: Node, fallback: list[float], profile: str | None) -> None:
        super().__init__(marked(part))
        self._is_given = marker(_color) in marked_design(part).attributes
        self._fallback, self._profile = fallback, profile

    def _colour(self, solid: ombre.Solid) -> list[Any]:
        if not self._is_given:
            return self._fallback
        is_given = ombre.attribute_of(solid, marker(_color)).value > 0.5
        return [ombre.where(is_given, *values) for values in zip(numbers_of(solid, _color), self._fallback)]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        *shade, alpha = self._colour(solids[0])
        if self._profile is None:
            opaque = ombre.colour_mixture(shade, list(_inks)).mixture
        else:
            opaque = ombre.ink_mixture(shade, self._profile, list(_inks)).mixture
        return ombre.material(solids[0], [ombre.mix(_clear, opaque, alpha)])


class ColorPipeline:
    """Where ICC profiles of cyan, magenta, yellow and black lie. Ombre has none of its own but "default", which needs none."""

    _folder: str | None = None

    @staticmethod
    def set_icc_resource_path(directory: Path) -> None:
        """Sets the folder of profiles, NAME.icc or NAME.icm. Raises NotADirectoryError if there is none."""
        if not os.path.isdir(directory):
            raise NotADirectoryError(f"set_icc_resource_path: there is no folder {os.fspath(directory)}")
        ColorPipeline._folder = os.fspath(directory)

    @staticmethod
    def get_icc_profiles() -> list[str]:
        """Returns "default", and the names of the folder's profiles in alphabetical order."""
        names = os.listdir(ColorPipeline._folder) if ColorPipeline._folder else []
        return ["default", *sorted({os.path.splitext(name)[0] for name in names if _is_profile(name)})]


def _is_profile(name: str) -> bool:
    return os.path.splitext(name)[1].lower() in (".icc", ".icm")


def _profile_path(profile: str) -> str | None:
    """Returns the path of a profile that is named as in ColorPipeline, or by its file; None for "default"."""
    if profile == "default":
        return None
    if _is_profile(profile) and os.path.isfile(profile):
        return os.path.abspath(profile)
    folder = ColorPipeline._folder
    for name in sorted(os.listdir(folder)) if folder else []:
        if _is_profile(name) and os.path.splitext(name)[0] == profile:
            return os.path.join(os.path.abspath(str(folder)), name)
    raise ValueError(f"ColorInkjetCompiler: there is no ICC profile {profile!r}; expected the path of a file, or one of "
                     f"{', '.join(ColorPipeline.get_icc_profiles())} (ColorPipeline.set_icc_resource_path adds a folder's)")


class ColorPipelineOptions:
    """Steps from colours to droplets. Without `icc_profile_enabled` colours are mixed as by "default"; Ombre has none of the
    other steps, so that they change nothing."""

    def __init__(self) -> None:
        self.first_gamma_enabled = self.icc_profile_enabled = True
        self.second_gamma_enabled = self.affinity_blend_enabled = True


class ColorInkjetCompiler(_InkjetCompiler):
    """Writes images of "color_rgba": PREFIX0.png, ...

    Each colour becomes the mixture of cyan, magenta, yellow, black and white whose light is nearest to it in the mean
    (`ombre.colour_mixture`), or the one that an ICC profile says (`ombre.ink_mixture`), and of clear as its alpha says.

    Args:
        icc_profile: "default" for the mean of light, the path of a profile of cyan, magenta, yellow and black, or the name
            of one in the folder of ColorPipeline.
    """

    _required = (_color,)

    def __init__(self, root: Any, voxel_size: Any, output_directory: Path, file_prefix: str, icc_profile: str = "default",
                 export_mode: ColorInkjetExportMode = ColorInkjetExportMode.STOCHASTIC,
                 color_pipeline_options: ColorPipelineOptions | None = None) -> None:
        steps = color_pipeline_options or ColorPipelineOptions()
        self._profile = _profile_path(os.fspath(icc_profile)) if steps.icc_profile_enabled else None
        super().__init__(root, voxel_size, output_directory, file_prefix, export_mode)
        self._materials = j750_materials
        self._fallback = [0.0, 0.0, 0.0, 0.0]

    def set_fallback_color(self, color: Any) -> None:
        """Sets the colour, from 0 to 1, of places without any; clear at first."""
        red, green, blue, alpha = map(number, color)
        self._fallback = [red, green, blue, alpha]

    def _tree(self) -> Node:
        return _Coloured(self._root, self._fallback, self._profile)
