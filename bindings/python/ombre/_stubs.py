"""Writes the package's type stub, from the registry of nodes and the commands' options.

    python3 -m ombre._stubs __init__.pyi
"""
import inspect
import keyword
import sys

import ombre

from . import _solid
from ._commands import keywords_of
from ._design import JOBS

_head = '''# Generated from the registry of nodes; do not edit.
import decimal
import fractions
import os
from typing import Any, Callable, Iterator, Literal, Mapping, NamedTuple, Optional, Sequence, Union

import numpy
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[numpy.float64]
Path = Union[str, "os.PathLike[str]"]
Number = Union[float, str, "Expression", Callable[..., Any]]
Numbers = Union[Sequence[Number], NDArray[Any]]
Material = Union[str, int, "Value"]
Argument = Any
Progress = Union[bool, Callable[[float], object], None]
Option = Any
Length = Union[float, str, decimal.Decimal, fractions.Fraction]

__version__: str

class DesignError(ValueError):
    diagnostics: list[dict[str, Any]]
    code: str
    values: dict[str, str]
    def __init__(self, message: str, diagnostics: Sequence[dict[str, Any]] = ...) -> None: ...

class MachineError(OSError):
    code: str
    values: dict[str, str]

class CheckError(DesignError):
    checks: Sequence[dict[str, Any]]
    point: Optional[tuple[float, float, float]]

class FunctionError(DesignError):
    point: Optional[tuple[float, float, float]]
    path: str
    place: Optional[tuple[str, int]]

class DesignWarning(UserWarning): ...

class Expression:
    def __init__(self, text: str) -> None: ...
    def __call__(self, points: ArrayLike) -> Floats: ...
'''
_operators = ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "mod", "rmod", "pow", "rpow", "and",
              "rand", "or", "ror", "lt", "le", "gt", "ge")

_middle = '''
class Samples:
    distance: Floats
    inside: NDArray[numpy.bool_]
    material: dict[str, Floats]
    attribute: dict[str, Floats]
class Voxels:
    values: NDArray[Any]
    spacing: tuple[float, float, float]
    origin: tuple[float, float, float]
    about: dict[str, Any]
    def centers(self) -> Floats: ...

class Materials:
    names: list[str]
    _factory: Any
    def __init__(self, path: Optional[Path] = ..., _factory: Any = ...) -> None: ...
    def colour(self, name: Material) -> tuple[int, int, int, int]: ...
    def use(self) -> "Materials": ...
    def __getitem__(self, key: Material) -> dict[str, Any]: ...
    def __contains__(self, key: Material) -> bool: ...
    def __len__(self) -> int: ...
    def __enter__(self) -> "Materials": ...
    def __exit__(self, *error: Any) -> None: ...

def load(path: Path, materials: Optional[Path] = ..., material_map: Union[None, Path, dict[str, str], Sequence[str]] = ..., **variables: Any) -> Design: ...
def load_text(text: str, name: str = ..., folder: Path = ..., materials: Optional[Path] = ..., **variables: Any) -> Design: ...
def run_job(kind: str, progress: Progress = ..., **options: Option) -> dict[str, Any]: ...
def source_memory(limit: Optional[int] = ...) -> dict[str, int]: ...
def delaunay_edges(points: ArrayLike) -> Floats: ...
def voronoi_edges(points: ArrayLike, min: Optional[ArrayLike] = ..., max: Optional[ArrayLike] = ...) -> Floats: ...
def volume_info(path: Path, series: Optional[str] = ..., channel: Optional[int] = ..., picture: Optional[Path] = ...,
                force: bool = ..., phase: Optional[int] = ..., nan: Optional[float] = ..., regular: bool = ...) -> dict[str, Any]: ...
def option(name: str, default: Any) -> Any: ...
def pointwise(function: Callable[..., float]) -> Callable[..., Any]: ...
def where(condition: Number, yes: Number, no: Number) -> Expression: ...
'''
# Methods that solids and designs share.
_questions = '''    bounds: tuple[tuple[float, float, float], tuple[float, float, float]]
    hash: str
    attributes: list[str]
    materials: Materials
    parts: list[tuple[str, Solid]]
    def tree(self) -> str: ...
    def to_json(self) -> str: ...
    def save(self, path: Path, force: bool = ...) -> None: ...
    def distance(self, points: ArrayLike, threads: int = ...) -> Floats: ...
    def inside(self, points: ArrayLike, threads: int = ...) -> NDArray[numpy.bool_]: ...
    def material(self, points: ArrayLike, threads: int = ...) -> dict[str, Floats]: ...
    def attribute(self, name: str, points: ArrayLike, threads: int = ...) -> Floats: ...
    def sample(self, points: ArrayLike, threads: int = ...) -> Samples: ...
    def gradient(self, points: ArrayLike, step: float = ..., threads: int = ...) -> Floats: ...
    def nearest(self, points: ArrayLike, steps: int = ..., tolerance: float = ..., threads: int = ...) -> Floats: ...
    def show(self, path: Optional[Path] = ..., **options: Option) -> Any: ...
    def view(self, frames: int = ..., **options: Option) -> str: ...
'''
def _safe(name):
    return not keyword.iskeyword(name)


def _keywords(info):
    words = [f"{p['name']}: {p['python']} = ..." for p in info["parameters"] if _safe(p["name"])]
    if info["category"] == "transforms":
        words.append("**components: Number")  # x, y, z; pitch, yaw, roll
    return "".join(", " + word for word in words)


def _docstring(text, indent):
    pad = " " * indent
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    return f'{pad}"""' + ("\n" + pad).join(text.rstrip().splitlines()) + f'\n{pad}"""\n'


# Types of options by the kinds of their values (src/options/option_values.h); each also takes the text of the command line.
_option_kinds = {"flag": "bool", "file": "Path", "whole number": "Union[int, str]", "number": "Union[float, str]",
                 "length": "Length", "lengths": "Union[Length, Sequence[Length]]",
                 "resolutions": "Union[Length, Sequence[Length]]", "size of memory": "Union[int, str]",
                 "numbers": "Union[str, Sequence[float]]", "2 numbers": "Union[str, Sequence[float]]",
                 "4 numbers": "Union[str, Sequence[float]]", "6 numbers": "Union[str, Sequence[float]]"}


def _option_type(option):
    if option.get("choices"):
        # Words that are numbers may be given as numbers.
        kind = "Literal[" + ", ".join(f'"{c}"' + (f", {c}" if c.isdigit() else "") for c in option["choices"]) + "]"
    elif option["name"] == "study":
        kind = "Union[Path, dict[str, Any]]"
    else:
        kind = _option_kinds.get(option.get("kind"), "Option")
    return "Option" if option["takes"] == "several" else kind if option["takes"] == "nothing" else f"Optional[{kind}]"


def _options(command, without=()):
    return "".join(f", {name}: {_option_type(option)}" + " = ..."
                   for name, option in keywords_of(command).items() if name not in without)


# Types of the results of jobs that return no dict.
_job_results = {"render": "Any"}


_parameter_types = {"progress": "Progress", "client": "Any", "shares": "Optional[int]"}


def _parameters(function):
    """Parameters that stand before the options."""
    text = ""
    for name, parameter in list(inspect.signature(function).parameters.items())[1:-1]:
        if name in _parameter_types:
            text += f", {name}: {_parameter_types[name]} = ..."
        else:
            text += f", {name}: Path" if parameter.default is inspect.Parameter.empty else f", {name}: Optional[Path] = ..."
    return text


def _jobs():
    for name, command in JOBS.items():
        function = getattr(ombre.Design, name)
        result = _job_results.get(name, "dict[str, Any]")
        yield (f"    def {name}(self{_parameters(function)}{_options(command)}) -> {result}:\n" +
               _docstring(function.__doc__, 8) + "        ...\n")
    words = _options("voxels", ("voxel", "what"))
    for name, result in (("voxels", "Voxels"), ("volumes", "dict[str, float]"), ("volume", "float")):
        what = ", what: str = ..., progress: Progress = ..." if name == "voxels" else ""
        yield f"    def {name}(self, voxel: Union[float, str, Sequence[float], None] = ...{what}{words}) -> {result}: ...\n"


# Types of parameters of operators; all else takes anything.
_port_types = {"number": "float", "value": "Number", "vector": "Numbers", "material": "Material", "mixture": "Material",
               "text": "str", "image": "str", "solid": "Solid", "truth": "bool", "radius": "float", "length": "float"}


def _operator(info):
    words = "".join(f", {p['name']}: {_port_types.get(p['kind'], 'Any')} = ..."
                    for p in info["parameters"] if _safe(p["name"]))
    result = "Solid" if info["gives"] == "solid" else "Any"
    return (f"    def {info['name']}(self, *arguments: Argument{words}) -> {result}:\n" +
            _docstring(info["sentence"] or info["name"], 8) + "        ...\n")


def _operator_classes():
    """A class for each library, and one that has all of them."""
    libraries = {}
    for info in ombre._core.own_operators():
        libraries.setdefault(info["library"].removeprefix("ombre/").removesuffix(".vcad"), []).append(info)
    names = {library: "_Library_" + "".join(c if c.isalnum() else "_" for c in library) for library in libraries}
    for library, infos in libraries.items():
        yield f"\nclass {names[library]}:\n" + "".join(map(_operator, infos))
    yield "\nclass _Operators:\n    def __getattr__(self, name: str) -> Any: ...\n"
    yield from (f"    {library}: {name}\n" for library, name in names.items() if library.isidentifier())
    yield "operators: _Operators\n"


def stub():
    """The stub's text."""
    out = [_head]
    out += [f"    def __{name}__(self, other: Number) -> Expression: ...\n" for name in _operators]
    out += [f"    def __{name}__(self) -> Expression: ...\n" for name in ("neg", "pos", "abs", "invert")]
    out += [_middle]
    out += ["def optimise(script: Path, folder: Path, study: Union[Path, dict[str, Any]], materials: Optional[Path] = ...," +
            f" progress: Progress = ..., client: Any = ..., shares: Optional[int] = ...{_options('optimise', ('study',))})"
            " -> dict[str, Any]:\n" +
            _docstring(ombre.optimise.__doc__, 4) + "    ...\n"]
    infos = _solid.node_infos()
    jobs = "".join(_jobs())
    out += ["\nclass Solid:\n", _questions, jobs,
            "    type: str\n    metric: str\n    parameters: dict[str, Any]\n    inputs: list[Solid]\n"
            "    place: Optional[tuple[str, int]]\n    _node: Any\n    _info: Any\n    def design(self) -> Design: ...\n"
            "    def grade(self, fractions: Mapping[str, Number], mode: str = ...) -> Solid: ...\n"]
    out += [f"    def __{name}__(self, other: Any) -> Solid: ...\n" for name in ("or", "and", "sub", "add")]
    out += ["    def __invert__(self) -> Solid: ...\n"]
    for info in infos:
        method = info["name"] if hasattr(ombre.Solid, info["name"]) else "with_" + info["name"]
        if info["inputs"]["least"] and hasattr(ombre.Solid, method):
            out.append(f"    def {method}(self, *arguments: Argument{_keywords(info)}) -> Solid: ...\n")
    out += ["\nclass Vector(NamedTuple):\n    x: Expression\n    y: Expression\n    z: Expression\n",
            "\nclass Value(Expression):\n    _node: Any\n"]
    out += ["\nclass Design:\n", _questions, jobs,
            "    _core: Any\n    def __init__(self, *parts: Solid, box: Optional[ArrayLike] = ..., voxel: Any = ..., **named: Solid) "
            "-> None: ...\n    @classmethod\n    def from_json(cls, text: str) -> Design: ...\n"]
    for info in infos:
        base = "Solid" if info["gives"] == "solid" else "Value"
        out.append(f"\nclass {info['name']}({base}):\n" + _docstring(_solid._doc(info), 4) +
                   "".join(f"    {o['name']}: {o['python']}\n" for o in info["outputs"]) +
                   f"    def __init__(self, *arguments: Argument{_keywords(info)}) -> None: ...\n")
    out += _operator_classes()
    out += ["\n"] + [f"{name}: Expression\n" for name in (*ombre._coordinates, "d", "t")]
    out += [f"def {name}(*values: Number) -> Expression: ...\n" for name in ombre._functions
            if name != "if" and name not in ombre._nodes]
    return "".join(out)


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(stub())
