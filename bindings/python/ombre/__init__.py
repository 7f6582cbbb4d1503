"""Ombre: solids whose material varies through their volume.

    import ombre
    from ombre import x

    bar = ombre.rectprism((20, 5, 5)).grade({"red": 0.5 + x/20, "blue": 0.5 - x/20})
    bar.slice("bar/", printer="j750")

Lengths are millimetres, angles degrees; z is up. Every node of `ombre nodes` is a class here, and a method of solids
where it works on one.
"""
import os as _os
from builtins import __dict__ as _builtin_names

from . import _core

_core.check_numpy()
_core.set_package_folder(_os.path.dirname(_os.path.abspath(__file__)))

from ._design import Design, Samples, Voxels, _document_jobs, load, load_text, optimise, run_job, source_memory
from ._errors import CheckError, DesignError, DesignWarning, FunctionError, MachineError
from ._expressions import Expression, d, t, where
from ._expressions import coordinates as _coordinates, functions as _functions
from ._functions import pointwise
from ._info import volume_info
from ._materials import Materials
from ._operators import operators
from ._points import delaunay_edges, voronoi_edges
from ._script import option
from ._solid import Solid, node_classes as _node_classes
from ._values import Value

__version__ = _core.version

_nodes = _node_classes(Value)
_document_jobs()
# A node takes precedence over a function of expressions with the same name.
globals().update({**{n: f for n, f in _functions.items() if n != "if"},
                  **_coordinates, **_nodes})

__all__ = ["Design", "Samples", "Voxels", "load", "load_text", "optimise", "run_job", "source_memory",
           "CheckError", "DesignError", "DesignWarning", "FunctionError", "MachineError",
           "Expression", "d", "t", "where", "pointwise", "Materials", "delaunay_edges", "voronoi_edges", "volume_info", "option", "operators", "Solid",
           "Value",
           *_coordinates, *_nodes,
           *(n for n in _functions if n != "if" and n not in _builtin_names)]
