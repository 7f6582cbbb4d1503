"""Viewer and exporter of pyvcad's scripts.

Neither fails where there is no display. When Ombre runs a script for its design (`ombre slice part.py`), both only
take note of what they were given.
"""
from __future__ import annotations

import os
import sys
from typing import Any

import ombre
from ombre._commands import endings, kind_for
from ombre._script import is_hosted, take_note
from pyvcad._materials import expect_table
from pyvcad._missing import attribute_of
from pyvcad._tree import as_node

from . import vtk_export
from ._diagram_files import Render_Tree_Diagram, Render_Tree_Legend
from ._mesh_selections import load_mesh_selection, resolve_selection_mesh, save_mesh_selection
from ._pictures import (Render_Image, Render_Sweep_Animation, Render_Turntable_Animation, RenderSettings, VisualizeSDF,
                        first_scaled_attribute, shown_attribute)
from .vtk_export import export_iso_surface_vtk, export_volume_vtk

__all__ = ["Render", "Export", "RenderSettings", "Render_Image", "Render_Sweep_Animation", "Render_Tree_Diagram",
           "Render_Tree_Legend", "Render_Turntable_Animation", "VisualizeSDF", "export_iso_surface_vtk",
           "export_volume_vtk", "load_mesh_selection", "resolve_selection_mesh", "save_mesh_selection", "vtk_export"]

# The methods of a design that are not called as their kinds of jobs.
_methods = {"voxels": "write_voxels"}


def _method_for(path: str) -> str | None:
    """The method of a design that writes such a file: "mesh" for part.stl."""
    ending = os.path.splitext(path)[1].lower()
    if ending in ("", ".json"):
        return "save" if ending else "slice"
    kind = kind_for(path)
    return _methods.get(kind, kind) if kind else None


def Render(root: Any, materials: Any = None, path: str | os.PathLike[str] | None = None, **options: Any) -> None:
    """Shows a part.

    In a notebook its picture appears there; with a display the studio opens in the browser, or with options a page that
    turns it; else a picture is written to ombre.png. `path`, or the environment variable OMBRE_RENDER, names a .png or
    .html file to write in any case; OMBRE_RENDER=studio prints the address of the studio.

    Args:
        root: a node.
        materials: a MaterialDefs; without it the default ones.
        path: writes the picture or the page there.
        **options: of `ombre render`: view, size, cut, legend, ...
    """
    expect_table("Render", materials)
    if is_hosted():
        take_note(as_node(root), materials)
        return
    node = as_node(root)
    design = node._ombre_design_(materials)
    # A part with attributes in place of materials has their colours, or those of the first one that varies.
    if "by" not in options and node.attribute_list() and "volume_fractions" not in node.attribute_list():
        if name := shown_attribute(node):
            options["by"] = name
            options.setdefault("legend", True)
    design.show(None if path is None else os.fspath(path), **options)


def Export(root: Any, materials: Any = None, path: str | os.PathLike[str] | None = None, **options: Any) -> None:
    """Writes files, and says which.

    The path, or else the environment variable OMBRE_EXPORT, says what: a folder for slices, .stl .3mf .obj ... for
    surfaces, .svg .cli for outlines, .vdb .npy .nrrd ... for voxels, .png for a picture, .json for the design.
    Without either it says what could be written.

    Args:
        root: a node.
        materials: a MaterialDefs; without it the default ones.
        path: where to.
        **options: of the job: printer, voxel, by, bands, force, ...
    """
    expect_table("Export", materials)
    if is_hosted():
        take_note(as_node(root), materials)
        return
    target = os.fspath(path) if path is not None else os.environ.get("OMBRE_EXPORT", "")
    if not target:
        print('Export: nothing is written without a path; write Export(root, materials, path="part.3mf"), or set the '
              "environment variable OMBRE_EXPORT (a folder for slices, .stl, .3mf, .svg, .vdb, .png, ...)",
              file=sys.stderr)
        return
    method = _method_for(target)
    if method is None:
        raise ombre.DesignError(f"Export: cannot write {target}; known are a folder without an ending for slices, and "
                                + ", ".join(endings()))
    design = as_node(root)._ombre_design_(materials)
    getattr(design, method)(target, **options)
    print(f"written to {target}", file=sys.stderr)


render, export, render_image = Render, Export, Render_Image
render_sweep_animation, render_turntable_animation = Render_Sweep_Animation, Render_Turntable_Animation
render_tree_diagram, render_tree_legend = Render_Tree_Diagram, Render_Tree_Legend
visualize_sdf = VisualizeSDF


def __getattr__(name: str) -> object:
    return attribute_of(__name__, __all__, name)
