#!/usr/bin/env python3
"""Checks that folders include only what tools/layers.toml allows them to, and that files within a folder do not include
each other in circles: what two need stands in a third, types apart from who works with them."""
import pathlib
import re
import sys
import tomllib

root = pathlib.Path(__file__).resolve().parent.parent
rules = tomllib.loads((root / "tools/layers.toml").read_text())
include = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def folder_of(path):
    parts = path.relative_to(root).parts
    return parts[1] if parts[0] in ("src", "apps", "bindings") else None


def problems(path):
    own = folder_of(path)
    is_test = path.stem.endswith("_test") or "test_" in path.stem or path.stem.startswith("exercise")
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = include.match(line)
        if not match:
            continue
        bracket, name = match.groups()
        first = name.split("/")[0]
        place = f"{path.relative_to(root)}:{number}"
        if bracket == '"' and first in rules["may_include"]:
            if first != own and first not in rules["may_include"][own] and not is_test:
                yield f"{place}: {own} may not include {first}"
        for prefix, home in rules["third_party"].items():
            if name.startswith(prefix) and own != home:
                yield f"{place}: {name} belongs to {home} alone"


def modules(folder):
    """The files of a folder that each file with its header includes: {"tile": {"lattice"}}."""
    edges = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).with_suffix("").as_posix()
        if path.suffix not in (".h", ".cpp") or name.endswith("_test") or path.name.startswith("test_"):
            continue
        used = edges.setdefault(name, set())
        for line in path.read_text().splitlines():
            match = include.match(line)
            if match and match[1] == '"' and match[2].startswith(folder.name + "/"):
                used.add(match[2].removeprefix(folder.name + "/").rsplit(".", 1)[0])
        used.discard(name)
    return edges


def circles(edges):
    """Sets of modules that all reach each other, by Tarjan's algorithm."""
    number, low, stack, found = {}, {}, [], []

    def visit(name):
        number[name] = low[name] = len(number)
        stack.append(name)
        for used in sorted(edges[name] & edges.keys()):
            if used not in number:
                visit(used)
            if used in stack:
                low[name] = min(low[name], low[used])
        if low[name] == number[name]:
            begin = stack.index(name)
            if len(stack) - begin > 1:
                found.append(frozenset(stack[begin:]))
            del stack[begin:]

    for name in edges:
        if name not in number:
            visit(name)
    return found


def circle_problems(folder):
    """Circles that layers.toml does not list, and those of its lists that are gone."""
    known = [frozenset(circle) for circle in rules["circles"].get(folder.name, [])]
    found = circles(modules(folder))
    for circle in found:
        if not any(circle <= allowed for allowed in known):
            yield f"{folder.relative_to(root)}: include each other in a circle: {', '.join(sorted(circle))}"
    for allowed in known:
        if allowed not in found:
            yield f"tools/layers.toml: {folder.name} has less of a circle by now: {', '.join(sorted(allowed))}"


sources = [f for base in ("src", "apps", "bindings") for f in sorted((root / base).rglob("*"))
           if f.suffix in (".h", ".cpp") and "node_modules" not in f.parts]
found = [p for f in sources for p in problems(f)]
folders = sorted({root / f.relative_to(root).parts[0] / f.relative_to(root).parts[1] for f in sources})
found += [p for folder in folders for p in circle_problems(folder)]
print("\n".join(found) if found else "layers: all includes are allowed")
sys.exit(1 if found else 0)
