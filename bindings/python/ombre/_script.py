"""Designs that are Python scripts."""
import os
import runpy
import sys

from ._errors import DesignError

_running = None  # the script that is run for its design


class _Script:
    def __init__(self, materials, variables):
        self.materials, self.variables = materials, variables
        self.shown = []  # arguments of viewers and exporters: (root, materials)


def is_hosted():
    """Is this script run for its design alone? Then viewers and exporters do nothing but take note."""
    return _running is not None


def take_note(root, materials=None):
    _running.shown.append((root, materials))


def option(name, default):
    """A variable of a script, which `-D name=value` of the command line and `load(..., name=value)` set.

    >>> import ombre
    >>> wall = ombre.option("wall", 1.5)
    >>> wall
    1.5
    """
    if _running is None or name not in _running.variables:
        return default
    return _running.variables[name]


def folders_of(path):
    """Folders of a script's modules: its own, and that of the file that it links to."""
    return list(dict.fromkeys(os.path.dirname(place(path)) for place in (os.path.abspath, os.path.realpath)))


def run_script(path, materials="", variables=()):
    """Runs a script. Returns its names, and what it showed."""
    global _running
    before, path_before = _running, list(sys.path)
    _running = _Script(materials, dict(variables))
    sys.path[:0] = folders_of(path)
    try:
        if materials:
            from ._materials import Materials, using
            with using(Materials(materials)._factory):
                names = runpy.run_path(path, run_name="__main__")
        else:
            names = runpy.run_path(path, run_name="__main__")
        return names, _running.shown
    finally:
        _running = before
        sys.path[:] = path_before


def load_script(path, materials="", variables=()):
    """The compiled design of a script: its `root` (or `design`), else what it showed last."""
    from ._design import Design
    if not os.path.exists(path):
        raise DesignError(f"there is no file {path}")
    names, shown = run_script(path, materials, variables)
    root, used = names.get("root", names.get("design")), names.get("materials")
    if root is None and shown:
        root, used = shown[-1]
    elif shown and shown[-1][0] is root:
        used = shown[-1][1]
    if root is None:
        raise DesignError(f"{path} makes no design: give the solid the name root, for example\n"
                          "    root = ombre.sphere(5)")
    if isinstance(root, Design):
        return root._core
    if hasattr(root, "_ombre_design_"):
        return root._ombre_design_(used)._core
    if hasattr(root, "_node"):
        return root.design()._core
    raise DesignError(f"root of {path} is no solid but a {type(root).__name__}")
