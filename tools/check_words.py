#!/usr/bin/env python3
"""Checks that names in the sources keep to the glossary: none has a word that docs/reference/glossary.md lists under "Words
that are not used"."""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
TOPS = ("src", "apps", "bindings", "tests", "tools")
ENDINGS = {".h", ".cpp", ".in", ".py", ".ts", ".mjs"}
LEFT_OUT = {"node_modules", "fixtures", "__pycache__"}
# Names of other libraries.
FOREIGN = re.compile(r"\b(?:os|ast)\.walk\b")
CPP_TEXT = re.compile(r'R"(\w*)\((?:.|\n)*?\)\1"|"(?:\\.|[^"\\\n])*"|//.*|/\*(?:.|\n)*?\*/')
PYTHON_TEXT = re.compile(r'"""(?:.|\n)*?"""|#.*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'')
NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def unused_words():
    """{"told": "reported, noted, requested", ...}"""
    section = (root / "docs/reference/glossary.md").read_text().split("## Words that are not used")[1]
    rows = re.findall(r"^\| ([a-z, ]+) \| (.+) \|$", section, re.MULTILINE)
    return {word: instead for words, instead in rows if words != "not" for word in words.split(", ")}


def without_texts(path):
    """The source with its comments and strings blank, line by line."""
    pattern = PYTHON_TEXT if path.suffix == ".py" else CPP_TEXT
    text = FOREIGN.sub("", path.read_text(encoding="utf-8"))
    return pattern.sub(lambda match: "\n" * match[0].count("\n"), text).splitlines()


def problems(path, words):
    place = path.relative_to(root)
    lines = [(0, path.stem), *enumerate(without_texts(path), 1)]
    for number, line in lines:
        for name in NAME.findall(line):
            for word in {part.lower() for part in WORD.findall(name)} & words.keys():
                where = f"{place}:{number}" if number else f"{place}"
                yield f'{where}: "{name}" has the word "{word}"; write {words[word]}'


def sources():
    for top in TOPS:
        for path in sorted((root / top).rglob("*")):
            if path.suffix in ENDINGS and not LEFT_OUT & set(path.parts):
                yield path


def main():
    words = unused_words()
    found = [problem for path in sources() for problem in problems(path, words)]
    print("\n".join(found) if found else "words: all names keep to the glossary")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
