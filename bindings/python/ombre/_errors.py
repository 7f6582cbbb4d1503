"""Exceptions, and how errors are reported."""
import warnings


def _first_error(diagnostics):
    return next((d for d in diagnostics if d["severity"] == "error"), {})


class DesignError(ValueError):
    """A design, or the arguments of a job, are wrong.

    `diagnostics` lists what was found: dictionaries with severity, message, hint, code, values and, where known, file,
    line and column. `code` is that of the first error, as docs/reference/codes.md lists them ("unknown-node"), `values`
    what it is about, {"node": "sphre"}.
    """

    def __init__(self, message, diagnostics=()):
        super().__init__(message)
        self.diagnostics = list(diagnostics)

    @property
    def code(self):
        return _first_error(self.diagnostics).get("code", "")

    @property
    def values(self):
        return dict(_first_error(self.diagnostics).get("values", {}))

    def __reduce__(self):
        return type(self), (str(self), self.diagnostics)


class MachineError(OSError):
    """A file, a disk or the memory failed. `code` and `values` say in which way, as those of DesignError do."""

    code, values = "machine", {}


class CheckError(DesignError):
    """A check of a strict job failed.

    `checks` lists what failed: dictionaries with text (which begins with the place of the node in the script), voxels
    (how many) and first_mm (the lowest point). `point` is that of the first one.
    """

    checks = ()

    @property
    def point(self):
        return tuple(self.checks[0]["first_mm"]) if self.checks else None


class FunctionError(DesignError):
    """A Python function of a design failed.

    `__cause__` is what it raised, `point` the first point of the call (mm), `path` leads to its node
    ("part > union > fgrade"), `place` is the (file, line) that made that.
    """

    def __init__(self, message, point=None, path="", place=None):
        super().__init__(message)
        self.point, self.path, self.place = point, path, place

    def __reduce__(self):
        return type(self), (str(self), self.point, self.path, self.place)


class DesignWarning(UserWarning):
    """Something in a design is allowed, but may not be what was meant."""


def report(diagnostics):
    """Raises the errors among the diagnostics; warns of the others."""
    errors = [d for d in diagnostics if d["severity"] == "error"]
    if errors:
        raise DesignError("\n".join(d["text"].rstrip("\n") for d in diagnostics), diagnostics)
    for diagnostic in diagnostics:
        if diagnostic["severity"] == "warning":
            warnings.warn(diagnostic["text"].rstrip("\n"), DesignWarning, stacklevel=4)


def function_failure(cause, name, point):
    """The exception that stands for one of a design's function; those that end programs stand for themselves."""
    if not isinstance(cause, Exception):
        return cause
    at = ", ".join(f"{c:.6g}" for c in point)
    error = FunctionError(f"the function {name} of the design raised {type(cause).__name__}: {cause} "
                          f"(the first point of the call: ({at}) mm)", point)
    error.__cause__ = cause
    return error


def at_node(failure, path, file, line):
    """The failure, with where in the design and in the script it belongs."""
    if not isinstance(failure, FunctionError):
        return failure
    place = (file, line) if file else None
    at = f"{file}:{line}: " if file else ""
    error = FunctionError(f"{at}{path}: {failure}", failure.point, path, place)
    error.__cause__ = failure.__cause__
    return error
