#!/usr/bin/env python3
"""Runs clang-tidy on what a build folder compiles together (CMake's unity builds): headers are read once for eight files.

    run_clang_tidy.py build/lint/UnifiedSource

The folder's name matters: by it the static analyser knows that the sources included are no headers.
Status 1 where it found something, which it prints.
"""

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ("src", "apps", "bindings")


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


def main():
    build = (ROOT / sys.argv[1]).resolve()
    jobs = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = Path(entry["file"])
        parts = folder_of(build, source)
        if parts and parts[0] in SOURCES:
            jobs.append(["clang-tidy", "-p", str(build), "--quiet", f"--config-file={ROOT / '.clang-tidy'}",
                         f"--checks={checks_of(parts)}", str(source)])
    if not jobs:
        sys.exit(f"{build}/compile_commands.json names no source of {', '.join(SOURCES)}")

    def run(job):
        return subprocess.run(job, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)

    failed = 0
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        for job, result in zip(jobs, threads.map(run, jobs)):
            if result.returncode:
                failed += 1
                print(result.stdout.strip() or f"clang-tidy failed: {' '.join(job)}", flush=True)
    print(f"clang-tidy: {len(jobs)} sources, {failed} with findings")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
