#!/usr/bin/env python3
"""Checks the sentences of comments, messages and documentation: a comment opens with a sentence or a noun, not with a
fragment that only makes sense beside what stands above it; messages do too; no sentence has more than 40 words.

--count prints how many comments there are, and how many open as fragments. Folders or files may be named."""
import argparse
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
MOST_WORDS = 40

# No sentence and no name of a thing begins with these.
ALWAYS = re.compile(r"(Of|Those|The same|That of|That which|One that|One of|What|Whose|Nothing,|Nothing where|As many|So are)\b")
# With these a clause opens, which a comma has to end, and a main clause to follow.
CLAUSE = re.compile(
    r"(About|After|Along|As|At|Because|Before|Behind|Between|But|By|For|From|If|In|Like|On|Or|Since|So|So that|To|When|Where|"
    r"Which|While|With|Within|Without)\b"
)
MESSAGE = re.compile(r"(Of|Those|What|Whose|of this|of these|what a|what the)\s(?=.* .* )")
COMMENT = re.compile(r"\s*///?(?: (.*))?$")
TRAILING = re.compile(r"\S\s+// (.*)$")
STRING = re.compile(r'"((?:\\.|[^"\\\n])*)"')
SENTENCE_END = re.compile(r"(?<=[.!?:;])\s+(?=[\"'(A-Z`*\[])|\n\s*\n|\n\s*(?=[-*|#]|\d+\. )")


def comments(lines):
    """(line, text, whether it stands beside code)"""
    number = 0
    while number < len(lines):
        match = COMMENT.match(lines[number])
        if match is None:
            beside = TRAILING.search(lines[number])
            if beside and "//" not in lines[number][: beside.start() + 1] and not is_in_string(lines[number], beside.start()):
                yield number + 1, beside[1], True
            number += 1
            continue
        first, text = number, []
        while number < len(lines) and (match := COMMENT.match(lines[number])):
            text.append(match[1] or "")
            number += 1
        yield first + 1, "\n".join(text), False


def is_in_string(line, place):
    return len(STRING.sub(lambda match: "x" * len(match[0]), line)[:place].split('"')) % 2 == 0


def is_fragment(text):
    if ALWAYS.match(text):
        return True
    first = re.split(r"(?<=[.;:])\s", text.replace("\n", " "))[0]
    return bool(CLAUSE.match(text)) and "," not in first and not first.endswith("?")


def long_sentences(text):
    for sentence in SENTENCE_END.split(text):
        words = re.findall(r"[^\s|`*]+", re.sub(r"`[^`]*`|\([^)]*\)|\[([^\]]*)\]", " x ", sentence))
        if len(words) > MOST_WORDS:
            yield f'a sentence of {len(words)} words: "{" ".join(words[:8])} ..."; cut it'


def source_problems(path):
    text = path.read_text(encoding="utf-8")
    for line, comment, beside_code in comments(text.splitlines()):
        if re.match(r"NOLINT|clang-format|namespace\b|={3}|-{3}", comment):
            continue
        if not beside_code and is_fragment(comment):
            opener = " ".join(comment.split()[:6])
            yield line, f'the comment opens as a fragment: "{opener} ..."; write a sentence, or name the thing first'
        for problem in long_sentences(comment):
            yield line, problem
    for number, line in enumerate([] if "_test" in path.stem else text.splitlines(), 1):
        if line.lstrip().startswith("//"):
            continue
        for match in STRING.finditer(line):
            if MESSAGE.match(match[1]):
                yield number, f'the text opens as a fragment: "{match[1][:40]}"; name the thing first'


def page_problems(path):
    text = re.sub(r"```.*?```", lambda match: "\n" * match[0].count("\n"), path.read_text(encoding="utf-8"), flags=re.DOTALL)
    # Tables and indented code are no sentences.
    lines = ["" if re.match(r"\s*\||    ", line) else line for line in text.splitlines()]
    for problem in long_sentences("\n".join(lines)):
        yield 0, problem


def chosen(names):
    listed = subprocess.run(["git", "ls-files", "-z", "--", *names], cwd=root, check=True, capture_output=True, text=True)
    for name in listed.stdout.split("\0"):
        path = root / name
        if not name or not path.is_file() or "/fixtures/" in name:
            continue
        if path.suffix in {".h", ".cpp"} and name.split("/")[0] in {"src", "apps", "bindings"}:
            yield path, source_problems
        elif path.suffix == ".md" and "docs/reference/" not in name and not name.endswith("CHANGELOG.md"):
            yield path, page_problems


def count():
    listed = subprocess.run(["git", "ls-files", "src", "apps", "bindings"], cwd=root, check=True, capture_output=True, text=True)
    paths = [root / name for name in listed.stdout.split() if name.endswith((".h", ".cpp")) and not re.search("_test|test_", name)]
    found = [text for path in paths for _, text, beside in comments(path.read_text().splitlines()) if not beside]
    print(f"{len(found)} comments, {sum(map(is_fragment, found))} open as fragments")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="folders or files (default: all that git knows)")
    parser.add_argument("--count", action="store_true")
    args = parser.parse_args()
    if args.count:
        return count()
    found = [
        f"{path.relative_to(root)}{f':{line}' if line else ''}: {problem}"
        for path, problems in chosen(args.names)
        for line, problem in problems(path)
    ]
    print("\n".join(found) if found else "prose: all comments, messages and pages are sentences")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
