"""Designs: parts and materials, queries, and jobs."""
import dataclasses
import html
import json
import os
import pathlib
import textwrap

import numpy

from . import _core
from ._commands import keywords_of, length_text, members_of, options_of, run, voxel_grids
from ._errors import DesignError
from ._shares import optimise_by, slice_by
from ._solid import Solid, _is_solid, _nodes, wrap


@dataclasses.dataclass(frozen=True)
class Voxels:
    """A grid of voxels.

    Attributes:
        values: array of the shape (z, y, x): `values[k, j, i]`. Material ids, fractions, distances (mm) or an attribute.
        spacing: voxel sizes (x, y, z), mm.
        origin: centre of voxel (0, 0, 0), mm.
        about: what else `ombre voxels` says of it.
    """
    values: numpy.ndarray
    spacing: tuple
    origin: tuple
    about: dict

    def centers(self):
        """Centres of the voxels, mm, of the shape (z, y, x, 3)."""
        axes = [self.origin[a] + self.spacing[a] * numpy.arange(self.values.shape[2 - a]) for a in range(3)]
        z, y, x = numpy.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
        return numpy.stack([x, y, z], axis=-1)


@dataclasses.dataclass(frozen=True)
class Samples:
    """The values of a design at points of the shape (..., 3).

    Attributes:
        distance: signed distance, mm, negative inside; an array of the shape (...).
        inside: truth values.
        material: {material: volume fractions}; 0 outside.
        attribute: {attribute: values}; those of vectors, colours and mixtures have one more axis, as in `attribute()`.
    """
    distance: numpy.ndarray
    inside: numpy.ndarray
    material: dict
    attribute: dict


def _points(points):
    array = numpy.ascontiguousarray(points, dtype=float)
    if array.shape[-1:] != (3,):
        raise ValueError(f"points have the shape (..., 3), mm, not {array.shape}")
    return array.reshape(-1, 3), array.shape[:-1]


def _joined(name, columns):
    """The values of an attribute from its columns, (name, values) each: one number, or several along a last axis."""
    if len(columns) == 1 and columns[0][0] == name:
        return columns[0][1][()]
    return numpy.stack([values for _, values in columns], axis=-1)


def _is_finite(points):
    return numpy.isfinite(numpy.asarray(points, dtype=float)).all(axis=-1)


class Design:
    """A design: named parts, each a solid.

    Args:
        *parts: solids; several are parts that may overlap.
        box: ((x0, y0, z0), (x1, y1, z1)) to sample, mm; without it, what the solids fill.
        voxel: voxel size with the box: a length, or three; mm. Strings are exact: "25.4/600".
        **named: parts by name.

    >>> import ombre
    >>> case = ombre.Design(lid=ombre.cube(4), body=ombre.sphere(3, "blue"))
    >>> [name for name, solid in case.parts]
    ['lid', 'body']
    """

    __slots__ = ("_core", "_text")

    def __init__(self, *parts, box=None, voxel=None, **named):
        solids = [(f"part {n + 1}" if len(parts) > 1 else "part", part) for n, part in enumerate(parts)]
        solids += list(named.items())
        for name, part in solids:
            if not _is_solid(part):
                raise TypeError(f"{name}: expected a solid, found {type(part).__name__}")
        if (box is None) != (voxel is None):
            raise TypeError("a box to sample needs a voxel size, and the other way round")
        self._text = None
        self._core = _core.Design([(name, _nodes(part)[0]) for name, part in solids],
                                  None if box is None else [[float(c) for c in corner] for corner in box],
                                  [] if box is None else _voxel_texts(voxel))

    @classmethod
    def _of(cls, core):
        design = object.__new__(cls)
        design._core, design._text = core, None
        return design

    @classmethod
    def from_json(cls, text):
        """The design of a design file's text."""
        return cls._of(_core.Design.from_json(text))

    @property
    def parts(self):
        """[(name, solid)]"""
        return [(name, wrap(node)) for name, node in self._core.parts]

    @property
    def bounds(self):
        """((x0, y0, z0), (x1, y1, z1)), mm; encloses everything."""
        return self._core.bounds

    @property
    def hash(self):
        """Equal for designs that are the same, however they were written: 32 hexadecimal digits."""
        return self._core.hash()

    @property
    def attributes(self):
        """Names of the attributes that the design gives."""
        return self._core.attributes

    @property
    def materials(self):
        """The materials that the design may name."""
        from ._materials import Materials
        return Materials(_factory=self._core.factory)

    def tree(self):
        """The nodes, indented, for people."""
        return self._core.tree()

    def to_json(self):
        """The design file's text. Raises DesignError for a design with Python functions."""
        return self._core.to_json()

    def save(self, path, force=False):
        """Writes the design file (JSON), which `load` and the command line read."""
        path = pathlib.Path(path)
        text = self.to_json()
        if path.exists() and not force:
            raise FileExistsError(f"{path} exists already; replace it with force=True")
        beside = path.with_name(path.name + f".{os.getpid()}.part")
        try:
            beside.write_text(text, encoding="utf-8")
            os.replace(beside, path)
        finally:
            beside.unlink(missing_ok=True)

    def __eq__(self, other):
        return self.hash == other.hash if isinstance(other, Design) else NotImplemented

    def __hash__(self):
        return hash(self.hash)

    def __reduce__(self):
        return Design.from_json, (self.to_json(),)

    def __repr__(self):
        return f"Design({', '.join(f'{name}={solid!r}' for name, solid in self.parts)})"

    # At points.

    def _sample(self, points, question, threads):
        flat, shape = _points(points)
        return [(kind, name, values.reshape(shape)) for kind, name, values in
                self._core.sample(flat, question, threads)]

    def distance(self, points, threads=0):
        """Signed distance at points of the shape (..., 3): mm, negative inside; an array of the shape (...).

        >>> import ombre
        >>> ombre.sphere(10).distance([[15, 0, 0], [0, 0, 0]])
        array([  5., -10.])
        """
        return self._sample(points, "distance", threads)[0][2][()]

    def inside(self, points, threads=0):
        """True for points of the shape (..., 3), mm, that are inside; an array of truth values."""
        return (_is_finite(points) & (self._sample(points, "inside", threads)[0][2] != 0))[()]

    def material(self, points, threads=0):
        """{material: volume fraction} at points of the shape (..., 3), mm; all are 0 outside."""
        columns = self._sample(points, "material", threads)
        inside = _is_finite(points) & (columns[0][2] != 0)
        return {name: numpy.where(inside, values, 0.0)[()] for _, name, values in columns[1:]}

    def attribute(self, name, points, threads=0):
        """An attribute's values at points of the shape (..., 3), mm. Of vectors, colours and mixtures the result has one
        more axis, for their numbers: x, y, z; red, green, blue, alpha; or the materials, in the order of their ids.
        """
        return _joined(name, [column[1:] for column in self._sample(points, "attribute " + name, threads)])

    def sample(self, points, threads=0):
        """Distance, inside, materials and all attributes at points of the shape (..., 3), mm, in one question: Samples.

        >>> import ombre
        >>> ombre.sphere(10).sample([[15, 0, 0], [0, 0, 0]]).inside
        array([False,  True])
        """
        columns = self._sample(points, "all", threads)
        of_kind = {kind: [values for k, _, values in columns if k == kind] for kind in ("inside", "distance")}
        inside = _is_finite(points) & (of_kind["inside"][0] != 0)
        parts = {}
        for kind, name, values in columns:
            if kind == "attribute":
                parts.setdefault(name.split(".", 1)[0], []).append((name, values))
        return Samples(of_kind["distance"][0][()], inside[()],
                       {name: numpy.where(inside, values, 0.0)[()] for kind, name, values in columns if kind == "fraction"},
                       {name: _joined(name, values) for name, values in parts.items()})

    def gradient(self, points, step=1e-4, threads=0):
        """Gradient of the distance at points of the shape (..., 3), by central differences of `step` mm."""
        flat, shape = _points(points)
        steps = step * numpy.eye(3)
        around = numpy.concatenate([flat[:, None, :] + steps, flat[:, None, :] - steps], axis=1)
        values = self.distance(around, threads)
        return ((values[:, :3] - values[:, 3:]) / (2 * step)).reshape(*shape, 3)

    def nearest(self, points, steps=30, tolerance=1e-9, threads=0):
        """Points of the surface near points of the shape (..., 3), mm: the nearest where the distance is exact.

        Where it is not, Newton's steps along the gradient are taken until the distance is below the tolerance (mm).
        """
        flat, shape = _points(points)
        here = flat.copy()
        for _ in range(steps):
            values = self.distance(here, threads)
            far = numpy.abs(values) > tolerance
            if not far.any():
                break
            slope = self.gradient(here[far], threads=threads)
            square = (slope * slope).sum(axis=1)
            length = numpy.divide(values[far], square, out=numpy.zeros_like(square), where=square > 1e-12)
            here[far] -= length[:, None] * slope
        return here.reshape(*shape, 3)

    # On grids.

    def voxels(self, voxel=None, what="materials", progress=None, **options):
        """The design on a grid, in memory.

        Args:
            voxel: size, mm: a length or three; without it, the design's own, or 0.1.
            what: "materials" (ids as slicing gives them, with its dithering), "distance" (mm), or the name of a
                material, for its fraction, or of an attribute, such as "modulus" or "fibre.x".
            progress: True for a bar, or a function of the share that is done, 0 to 1.
            **options: of `ombre voxels`: box, printer, dither, seed, threads, ...

        Returns:
            Voxels, whose values have the shape (z, y, x).
        """
        if voxel is not None:
            options["voxel"] = ",".join(_voxel_texts(voxel))
        is_material = what not in ("materials", "distance") and self._material(what) is not None
        if not is_material and what not in ("materials", "distance") and what.split(".")[0] not in self.attributes:
            raise DesignError(f"{what!r} is neither materials nor distance nor a material nor an attribute of the design"
                              + (", which has " + ", ".join(self.attributes) if self.attributes else ""))
        grids = voxel_grids({**options, "what": "fractions" if is_material else what}, self._core, progress)
        name = self._material(what) if is_material else None
        about, values = next((g for g in grids if name is None or g[0]["material"]["name"] == name), (None, None))
        if values is None:  # the design has the material nowhere
            about, values = dict(grids[0][0]), numpy.zeros_like(grids[0][1])
            about["material"] = {"name": name}
        return Voxels(values, tuple(about["spacing_mm"]), tuple(about["origin_mm"]), about)

    def _material(self, name):
        """The name of a material, whatever its case; None where it is no material."""
        return next((known for known in self.materials.names if known.lower() == str(name).lower()), None)

    def volumes(self, voxel=None, **options):
        """{material: volume in mm3}, by counting voxels as slicing fills them."""
        if voxel is None and self._core.sampling is None:
            (x0, y0, z0), (x1, y1, z1) = self.bounds
            voxel = max((max(x1 - x0, 1e-9) * max(y1 - y0, 1e-9) * max(z1 - z0, 1e-9) / 8e6) ** (1 / 3), 1e-4)
            voxel = f"{voxel:.3g}"
        grid = self.voxels(voxel, **options)
        counts = numpy.bincount(grid.values.ravel(), minlength=1)
        size = float(numpy.prod(grid.spacing))
        names = self.materials.names
        return {names[i]: int(n) * size for i, n in enumerate(counts) if i and n}

    def volume(self, voxel=None, **options):
        """Volume in mm3, by counting voxels of the given size (mm); without one, 8 million in the bounds."""
        return sum(self.volumes(voxel, **options).values())

    # Jobs.

    def _job(self, kind, path, progress, options):
        own = {} if path is None else {"output": os.fspath(path)}
        return run(kind, own, options, self._core, progress)[0]

    def slice(self, folder, progress=None, client=None, shares=None, **options):
        """Writes a printable slice stack to a folder; see `ombre slice`.

        With a client of Dask, or an executor of concurrent.futures, its workers make the layers, in as many shares,
        and need to see the folder; the bytes are the same.
        """
        if client is not None:
            return slice_by(client, self, folder, shares, progress, options)
        if shares is not None:
            raise TypeError("shares are for a client: slice(folder, client=..., shares=40)")
        if options.get("resume"):
            self.to_json()  # raises for a design with Python functions, which cannot be resumed
        return self._job("slice", folder, progress, options)

    def layer(self, path, **options):
        """Writes one layer as an image, by z=mm or index=n; see `ombre layer`."""
        return self._job("layer", path, None, options)

    def mesh(self, path, progress=None, **options):
        """Writes closed surfaces (.stl, .obj, .ply, .off, .amf, .3mf, .glb); see `ombre mesh`."""
        return self._job("mesh", path, progress, options)

    def contours(self, path, progress=None, **options):
        """Writes outlines of layers (.svg, .cli); see `ombre contours`."""
        return self._job("contours", path, progress, options)

    def fea(self, path=None, progress=None, **options):
        """Writes a finite-element model (.inp, .vtu), and solves it with `solve=True`; see `ombre fea`.

        `study` is a path, or what such a file holds, as a dict.
        """
        return self._job("fea", path, progress, options)

    def homogenise(self, path=None, progress=None, **options):
        """Says how stiff a cell of the design is as a material, or how well it conducts; see `ombre homogenise`.

        `path` is a chart (.svg); `study` a path, or what such a file holds, as a dict. The report has
        `stiffness_mpa`, `modulus_mpa` and so on.
        """
        return self._job("homogenise", path, progress, options)

    def write_voxels(self, path, progress=None, **options):
        """Writes a grid (.vdb, .nvdb, .npy, .nrrd, .raw); see `ombre voxels`."""
        return self._job("voxels", path, progress, options)

    def render(self, path=None, **options):
        """Writes a picture (.png), or returns it as bytes when there is no path; see `ombre render`."""
        if path is not None:
            return self._job("render", path, None, options)
        return run("render", {"output": "-"}, options, self._core)[1]

    def view(self, frames=36, **options):
        """A page for the browser, as text, that holds pictures from all around and turns the part; options of `render`."""
        from ._show import pictures_in, viewer_page
        pictures = pictures_in(run("render", {"output": "-", "frames": frames}, options, self._core)[1])
        return viewer_page(pictures, ", ".join(name for name, _ in self.parts))

    def show(self, path=None, **options):
        """Shows the design: in a notebook there, else in the studio; without a display, `ombre.png` is written.

        `path`, or the environment variable OMBRE_RENDER, names a .png or .html file to write in any case.
        """
        from ._show import show
        return show(self, path, **options)

    def _repr_png_(self):
        return self.render(size="480x360", legend=True)

    def _repr_html_(self):
        import base64
        picture = base64.b64encode(self._repr_png_()).decode("ascii")
        (x0, y0, z0), (x1, y1, z1) = self.bounds
        names = html.escape(", ".join(name for name, _ in self.parts))
        return (f'<div><img alt="{names}" width="480" src="data:image/png;base64,{picture}"/><div>{names}: '
                f"{x1 - x0:.4g} × {y1 - y0:.4g} × {z1 - z0:.4g} mm</div></div>")


def _voxel_texts(voxel):
    if isinstance(voxel, str):
        values = voxel.split(",")
    else:
        values = list(numpy.atleast_1d(voxel if isinstance(voxel, numpy.ndarray) else numpy.asarray(voxel, dtype=object)))
    texts = [length_text(v) for v in values]
    return texts * 3 if len(texts) == 1 else texts


def _map_texts(material_map):
    """A dict as NAME=MATERIAL for each of its pairs; other values are texts or files of such pairs."""
    if material_map is None:
        return []
    if isinstance(material_map, dict):
        return [f"{name}={material}" for name, material in material_map.items()]
    return [os.fspath(material_map)] if isinstance(material_map, (str, os.PathLike)) else [os.fspath(m) for m in material_map]


def load(path, materials=None, material_map=None, **variables):
    """The design of a file: .vcad, .json, .scad, or a Python script (.py), whose `root` it is.

    Args:
        path: the file.
        materials: a materials file, for scripts.
        material_map: materials for the names and colours of an OpenSCAD script: {"PLA white": "white"}, or a .json file.
        **variables: of a script, set before it runs.
    """
    path = os.fspath(path)
    if path.endswith(".py"):
        from ._script import load_script
        if material_map:
            raise ValueError("material_map is for OpenSCAD scripts; a Python script names its materials itself")
        return Design._of(load_script(path, materials or "", variables))
    definitions = [f"{name}={_definition(value)}" for name, value in variables.items()]
    return Design._of(_core.Design.load(path, "" if materials is None else os.fspath(materials), definitions,
                                        material_map=_map_texts(material_map)))


def load_text(text, name="design.vcad", folder="", materials=None, **variables):
    """The design of a text that is no file.

    Args:
        text: a script, or a design file.
        name: what messages call it; its ending, .vcad or .json, says which of both it is.
        folder: where relative paths in it begin; the working folder if it is empty.
        materials, variables: as for `load`.
    """
    if not name.endswith((".vcad", ".json")):
        raise ValueError(f"the name {name!r} does not say what the text is; end it with .vcad or .json")
    path = os.path.join(os.fspath(folder), name)
    definitions = [f"{key}={_definition(value)}" for key, value in variables.items()]
    return Design._of(_core.Design.load(path, "" if materials is None else os.fspath(materials), definitions, text))


def optimise(script, folder, study, materials=None, progress=None, client=None, shares=None, **options):
    """Searches for the values of a script's variables that serve it best; see `ombre optimise`.

    Args:
        script: a .vcad or .scad file, whose variables the study names.
        folder: for the history of the search and the best designs.
        study: a .json file, or what it holds, as a dict; names of files in a dict begin in the working folder.
        materials: a materials file.
        progress: True for a bar, or a function of the share that is done, 0 to 1.
        client: a client of Dask, or an executor of concurrent.futures, whose workers measure the designs of a generation;
            all see the same folder.
        shares: in how many shares these designs are measured; by default as many as there are workers.

    Returns:
        What `--json` would tell; `events` has a "best" for each of the best designs, with `variables` and `measures`.
    """
    place = os.fspath if client is None else os.path.abspath  # workers may have other working folders
    own = {"design": place(script), "output": place(folder)}
    if materials is not None:
        own["materials"] = place(materials)
    if isinstance(study, dict) and isinstance(study.get("fea"), str):
        study = {**study, "fea": os.path.abspath(study["fea"])}
    elif not isinstance(study, dict):
        study = place(study)
    if client is not None:
        return optimise_by(client, {**own, **members_of("optimise", {**options, "study": study})}, shares, progress)
    if shares is not None:
        raise TypeError("shares are for a client: optimise(..., client=..., shares=8)")
    return run("optimise", own, {**options, "study": study}, progress=progress)[0]


def source_memory(limit=None):
    """Files of designs that this process keeps, so that they load quickly again. The least recently used are
    dropped first. The sizes are estimates.

    Args:
        limit: how many bytes to keep from now on; at first a gibibyte.

    Returns:
        A dict: bytes kept, most_bytes to keep, and file_reads, how often a file was read.
    """
    if limit is not None:
        _core.set_source_memory(limit)
    return _core.source_memory()


def _definition(value):
    return value if isinstance(value, str) else json.dumps(value)


def run_job(kind, progress=None, **options):
    """Runs a job of any kind, such as "sheet" or "info"; see `ombre commands`.

    Args:
        kind: its name.
        progress: True for a bar, or a function of the share that is done, 0 to 1.
        **options: those of the command, and what it takes without a name: file, folder, design.

    Returns:
        What `--json` would tell, with all `events`, and `text`: what the command would print.
    """
    known = options_of(kind)
    own = {known[name]["name"]: _plain(options.pop(name)) for name in list(options) if name in known and name not in keywords_of(kind)}
    report, text = run(kind, own, options, progress=progress)
    report["text"] = text.decode("utf-8", "replace")
    return report


def _plain(value):
    return [os.fspath(v) for v in value] if isinstance(value, (list, tuple)) else os.fspath(value)


# Commands that are methods of designs and solids, with their names as commands. All kinds of jobs of a design that have no
# method of their own get one.
JOBS = {"slice": "slice", "layer": "layer", "mesh": "mesh", "contours": "contours", "fea": "fea",
        "homogenise": "homogenise", "write_voxels": "voxels", "render": "render"}
_elsewhere = {"optimise", "bundle", "voxels"}


def _method_of(kind, help_text, has_output):
    if has_output:
        def method(self, path=None, progress=None, **options):
            return self._job(kind, path, progress, options)
    else:
        def method(self, progress=None, **options):
            return self._job(kind, None, progress, options)
    method.__name__ = kind
    method.__doc__ = f"{help_text}; see `ombre {kind}`."
    return method


def _add_other_jobs():
    for kind in _core.jobs():
        name, options = kind["name"], {option["name"] for option in kind["options"]}
        if "design" not in options or name in _elsewhere or hasattr(Design, name):
            continue
        setattr(Design, name, _method_of(name, kind["help"], "output" in options))
        JOBS[name] = name


_add_other_jobs()


def _document_jobs():
    """Adds the commands' options to the jobs' texts."""
    for function, command in ((optimise, "optimise"), *((getattr(Design, method), JOBS[method]) for method in JOBS)):
        lines = [f"    {name}: {option['help']}" for name, option in keywords_of(command).items()]
        function.__doc__ = textwrap.dedent(function.__doc__) + "\n\nOptions:\n" + "\n".join(lines)
