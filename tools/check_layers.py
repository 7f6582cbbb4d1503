#!/usr/bin/env python3
"""Checks that folders include only what tools/layers.toml allows them to."""
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


found = [p for base in ("src", "apps", "bindings") for f in sorted((root / base).rglob("*"))
         if f.suffix in (".h", ".cpp") for p in problems(f)]
print("\n".join(found) if found else "layers: all includes are allowed")
sys.exit(1 if found else 0)
