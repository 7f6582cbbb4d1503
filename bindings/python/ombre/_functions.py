"""Python functions in place of expressions: slower, and known to this process alone."""
import inspect

import numpy

_names = ("x", "y", "z", "rho", "phic", "r", "theta", "phis", "d")


def _coordinates(x, y, z, wanted):
    values = {"x": x, "y": y, "z": z}
    if "rho" in wanted:
        values["rho"] = numpy.hypot(x, y)
    if "phic" in wanted or "theta" in wanted:
        values["phic"] = values["theta"] = numpy.arctan2(y, x)
    if "r" in wanted or "phis" in wanted:
        values["r"] = r = numpy.sqrt(x * x + y * y + z * z)
        with numpy.errstate(all="ignore"):
            values["phis"] = numpy.where(r > 0, numpy.arccos(numpy.clip(z / r, -1, 1)), 0.0)
    return values


class Function:
    """A function of arrays of coordinates, by the names of its parameters."""

    def __init__(self, function, child=None):
        self.function, self.child = function, child
        self.names = self._wanted(function)
        if "d" in self.names and child is None:
            raise TypeError(f"{self.__name__} takes d, the distance of the child, which is known in fgrade, "
                            "material and attribute only")

    @property
    def __name__(self):
        return getattr(self.function, "__name__", type(self.function).__name__)

    @property
    def _ombre_function_(self):
        return self

    def _wanted(self, function):
        try:
            parameters = list(inspect.signature(function).parameters.values())
        except (TypeError, ValueError):
            return ("x", "y", "z")
        if any(p.kind is p.VAR_POSITIONAL for p in parameters):
            return ("x", "y", "z")
        names = tuple(p.name for p in parameters if p.default is p.empty and p.kind is not p.VAR_KEYWORD)
        unknown = [name for name in names if name not in _names]
        if unknown:
            raise TypeError(f"{self.__name__} has the parameter {unknown[0]!r}; known are {', '.join(_names)}")
        return names

    def __call__(self, x, y, z):
        values = _coordinates(x, y, z, self.names)
        if "d" in self.names:
            values["d"] = self.child.distance(numpy.stack([x, y, z], axis=-1), threads=1)
        try:
            result = self.function(*(values[name] for name in self.names))
            if result is None:
                raise TypeError("it returned None; a number for each point is needed")
            return numpy.asarray(result, dtype=float)
        except (TypeError, ValueError) as error:
            text = str(error)
            if "only length-1 arrays" in text or "only size-1 arrays" in text or "truth value of an array" in text:
                raise TypeError(f"{self.__name__} is called with arrays of points, but takes single numbers only "
                                f"({text}); use NumPy's functions, or wrap it: ombre.pointwise({self.__name__})"
                                ) from error
            raise


def pointwise(function):
    """A function of single numbers, made to take arrays; much slower than one that takes arrays itself.

    >>> import math, ombre
    >>> part = ombre.function(ombre.pointwise(lambda x, y, z: math.hypot(x, y, z) - 3), min=(-4, -4, -4), max=(4, 4, 4))
    >>> float(part.distance([0, 0, 0]))
    -3.0
    """
    names = Function(function, child=True).names

    def many(*arrays):
        return numpy.array([function(*values) for values in zip(*(a.tolist() for a in arrays))], dtype=float)
    many.__name__ = getattr(function, "__name__", "function")
    many.__signature__ = inspect.Signature([inspect.Parameter(n, inspect.Parameter.POSITIONAL_OR_KEYWORD)
                                            for n in names])
    return many


def adapt(value, child=None):
    """The value, with every Python function in it ready to be called with arrays of x, y and z; dictionaries as pairs."""
    if isinstance(value, dict):
        value = list(value.items())
    if isinstance(value, (list, tuple)):
        return [adapt(element, child) for element in value]
    if callable(value) and not hasattr(value, "_ombre_text_") and not hasattr(value, "_ombre_function_") \
            and not hasattr(value, "_ombre_node_") and not hasattr(value, "tolist") and not isinstance(value, type):
        return Function(value, child)
    return value
