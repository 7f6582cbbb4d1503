#!/usr/bin/env python3
"""Checks the rooms of the sources: that each includes only what tools/layers.toml allows, that files within a room do not
include each other in circles (what two need stands in a third, types apart from who works with them), that no room has
more than 45 files beside its tests, and that no two files have the same name."""
import collections
import pathlib
import re
import sys
import tomllib

MOST_FILES = 45
root = pathlib.Path(__file__).resolve().parent.parent
rules = tomllib.loads((root / "tools/layers.toml").read_text())
rooms = sorted(rules["may_include"], key=len, reverse=True)
include = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def is_in(name, room):
    return name == room or name.startswith(room + "/")


def room_of(name):
    """The room of a path such as formats/mesh/stl.cpp; nothing for what is no room's."""
    folder = str(pathlib.PurePosixPath(name).parent)
    return next((room for room in rooms if is_in(folder, room)), None)


def name_of(path):
    return path.relative_to(root / path.relative_to(root).parts[0]).as_posix()


def is_test(path):
    return path.stem.endswith("_test") or "test_" in path.stem or path.stem.startswith("exercise")


def problems(path):
    own = room_of(name_of(path))
    if not own and not is_test(path):
        yield f"{path.relative_to(root)}: its folder is no room of tools/layers.toml"
        return
    allowed = rules["may_include"].get(own, [])
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = include.match(line)
        if not match:
            continue
        bracket, name = match.groups()
        place = f"{path.relative_to(root)}:{number}"
        other = room_of(name) if bracket == '"' else None
        if other and other != own and not is_test(path) and not any(is_in(other, room) for room in allowed):
            yield f"{place}: {own} may not include {other}"
        for prefix, home in rules["third_party"].items():
            if own and name.startswith(prefix) and not is_in(own, home):
                yield f"{place}: {name} belongs to {home} alone"


def modules(room, paths):
    """The files of a room that each file with its header includes: {"tile": {"lattice"}}."""
    edges = {}
    for path in paths:
        used = edges.setdefault(pathlib.PurePosixPath(name_of(path)).relative_to(room).with_suffix("").as_posix(), set())
        for line in path.read_text().splitlines():
            match = include.match(line)
            if match and match[1] == '"' and room_of(match[2]) == room:
                used.add(match[2].removeprefix(room + "/").rsplit(".", 1)[0])
    for name, used in edges.items():
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


def circle_problems(room, paths):
    """Circles that layers.toml does not list, and those of its lists that are gone."""
    known = [frozenset(circle) for circle in rules["circles"].get(room, [])]
    found = circles(modules(room, paths))
    for circle in found:
        if not any(circle <= allowed for allowed in known):
            yield f"{room}: files include each other in a circle: {', '.join(sorted(circle))}"
    for allowed in known:
        if allowed not in found:
            yield f"tools/layers.toml: {room} has less of a circle by now: {', '.join(sorted(allowed))}"


def crowd_problems(paths):
    folders = collections.Counter(path.parent for path in paths)
    for folder, count in folders.items():
        if count > MOST_FILES:
            yield f"{folder.relative_to(root)} has {count} files, at most {MOST_FILES} are a room"


def name_problems(paths):
    folders = collections.defaultdict(set)
    for path in paths:
        folders[path.stem].add(str(path.parent.relative_to(root)))
    for name, where in sorted(folders.items()):
        if len(where) > 1:
            yield f"{name}: files in {' and '.join(sorted(where))} have the same name"


sources = [f for base in ("src", "apps", "bindings") for f in sorted((root / base).rglob("*"))
           if f.suffix in (".h", ".cpp") and "node_modules" not in f.parts]
product = [f for f in sources if not is_test(f)]
found = [p for f in sources for p in problems(f)]
for room in rooms:
    found += circle_problems(room, [f for f in product if room_of(name_of(f)) == room])
found += [*crowd_problems(product), *name_problems(product)]
print("\n".join(found) if found else "layers: all includes are allowed")
sys.exit(1 if found else 0)
