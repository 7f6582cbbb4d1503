#!/usr/bin/env python3
"""Runs clang-tidy on sources that changed, or on all.

    run_clang_tidy.py build/lint/UnifiedSource [--since REF | --all] [--seconds N]

Changed is what differs from REF; without it, from where the branch left its upstream branch, or, where that is HEAD, from
the last commit that is older than a day; with what is not committed yet. A changed header is read with the source of its
name, or with one that includes it; --all reads everything. Where most of what the build folder compiles together (CMake's unity builds) has changed, headers are read once
for all of it. The folder's name matters: by it the static analyser knows that the sources included are no headers.
What changed last is read first; with --seconds no source is begun after that time, and how many are left is printed.
Status 1 where something was found, which is printed.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("src", "apps", "bindings")
INCLUDE = re.compile(r'^\s*#include "([^"]+)"', re.M)


def folder_of(build, source):
    """The folder of a target, of a source of ours or of one that CMake put several into."""
    for base in (build, ROOT):
        if source.is_relative_to(base):
            return source.relative_to(base).parts
    return ()


def checks_of(parts):
    """The checks that the folder's own .clang-tidy adds, which clang-tidy seeks from the build folder in vain."""
    checks = ["-bugprone-suspicious-include"]  # of a .cpp: what unity builds are
    settings = ROOT.joinpath(*parts[:2], ".clang-tidy")
    if settings.is_file():
        checks += [line.split(":", 1)[1].strip() for line in settings.read_text().splitlines() if line.startswith("Checks:")]
    return ",".join(checks)


def git(*arguments):
    done = subprocess.run(["git", "-C", str(ROOT), *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def base_of_branch():
    base = git("merge-base", "HEAD", "@{upstream}") or git("merge-base", "HEAD", "origin/HEAD")
    if base and base != git("rev-parse", "HEAD"):
        return base
    return git("rev-list", "-1", "--before=1 day ago", "HEAD") or git("hash-object", "-t", "tree", "/dev/null")


def changed_files(since):
    """{file: how long ago it was changed, 0 for the last}"""
    base = git("rev-parse", "--verify", "--quiet", f"{since}^{{commit}}") if since else base_of_branch()
    if not base:
        sys.exit(f"there is no commit {since}")
    names = git("ls-files", "--others", "--exclude-standard") + "\n" + git("diff", "--name-only", "HEAD")
    names += "\n" + git("log", "--format=", "--name-only", f"{base}..HEAD") + "\n" + git("diff", "--name-only", base)
    files = {}
    for name in names.split("\n"):
        if name.startswith(tuple(f"{folder}/" for folder in FOLDERS)):
            files.setdefault(ROOT / name, len(files))
    return files


def with_includers(changed, sources):
    """The changed sources, and for each changed header one source that includes it, of its own name if there is one: what
    is found in a header is found there. {source: how long ago it was changed}"""
    found = {path: changed[path] for path in sources if path in changed}
    names = {source: [Path(name) for name in INCLUDE.findall(source.read_text(encoding="utf-8"))] for source in sorted(sources)}
    for header in sorted(path for path in changed if path.suffix == ".h"):
        includers = [source for source, included in names.items() if any(header.match(str(name)) for name in included)]
        if any(source in found for source in includers):
            continue
        own = [source for source in includers if source.stem == header.stem]
        found.update({source: changed[header] for source in (own or includers)[:1]})
    return found


def together(file):
    """The sources that a file of a unity build includes; of another, itself."""
    if file.name.startswith("unity_") and file.is_file():
        return [Path(name) for name in INCLUDE.findall(file.read_text(encoding="utf-8"))]
    return [file]


def alone(entry, source):
    """The entry of one of the sources that are compiled together."""
    command = entry["command"].replace(entry["file"], str(source))
    return {"directory": entry["directory"], "file": str(source), "command": command}


def chosen_entries(entries, build, arguments):
    """What to check, as entries of compile_commands.json, and the folder of each."""
    ours = []
    for entry in entries:
        parts = folder_of(build, Path(entry["file"]))
        if parts and parts[0] in FOLDERS:
            ours.append((entry, parts, together(Path(entry["file"]))))
    if not ours:
        sys.exit(f"{build}/compile_commands.json names no source of {', '.join(FOLDERS)}")
    if arguments.all:
        return [(entry, parts) for entry, parts, _ in ours]
    wanted = with_includers(changed_files(arguments.since), {source for _, _, sources in ours for source in sources
                                                             if source.is_relative_to(ROOT) and source.is_file()})
    chosen = []
    for entry, parts, sources in ours:
        here = {source: wanted.pop(source) for source in sources if source in wanted}  # another target may have it, too
        if len(sources) > 1 and 2 * len(here) > len(sources):
            chosen.append((min(here.values()), entry, parts))
        else:
            chosen += [(age, alone(entry, source), parts) for source, age in here.items()]
    return [(entry, parts) for _, entry, parts in sorted(chosen, key=lambda row: row[0])]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--since", metavar="REF", help="check what differs from this commit")
    parser.add_argument("--all", action="store_true", help="check all sources")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no source after so long")
    arguments = parser.parse_args()
    build = (ROOT / arguments.build).resolve()
    chosen = chosen_entries(json.loads((build / "compile_commands.json").read_text()), build, arguments)

    with tempfile.TemporaryDirectory() as commands:
        (Path(commands) / "compile_commands.json").write_text(json.dumps([entry for entry, _ in chosen]))
        jobs = [["clang-tidy", "-p", commands, "--quiet", f"--config-file={ROOT / '.clang-tidy'}",
                 f"--checks={checks_of(parts)}", entry["file"]] for entry, parts in chosen]

        end = time.monotonic() + arguments.seconds

        def run(job):
            if time.monotonic() > end:
                return None
            return subprocess.run(job, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)

        failed = left = 0
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            for job, result in zip(jobs, threads.map(run, jobs)):
                if result is None:
                    left += 1
                elif result.returncode:
                    failed += 1
                    print(result.stdout.strip() or f"clang-tidy failed: {' '.join(job)}", flush=True)
    print(f"clang-tidy: {len(jobs) - left} sources, {failed} with findings"
          + (f"; {left} were not read within {arguments.seconds:g} s: ./dev lint" if left else ""))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
