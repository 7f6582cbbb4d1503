#!/usr/bin/env python3
"""The guard (tools/guard.py) sees what a build writes: the same twice, a changed design, a changed message.

    python3 tests/run_guard.py build/dev/apps/ombre/ombre
"""
import struct
import sys
import zlib

import program
from program import expect

sys.path.insert(0, str(program.SOURCE / "tools"))
import guard_differences  # noqa: E402
import guard_jobs  # noqa: E402
import guard_run  # noqa: E402

GUARD = program.SOURCE / "tools" / "guard.py"
BLOCK = "rectprism((4, 4, 2), red);\n"
# A corner's voxel is taken out of the upper of two layers, each of 4 x 4 voxels of 1 mm.
WITHOUT_A_CORNER = "difference() { rectprism((4, 4, 2), red); translate(1.5, 1.5, 0.5) cube(0.8); }\n"
COMMAND = "command (in this folder): time ombre slice d.vcad --voxel 1 -o out; ombre probe d.vcad --at 0,0,0\n"


def write_case(folder, text):
    (folder / "block").mkdir(exist_ok=True)
    (folder / "block" / "d.vcad").write_text(text, encoding="utf-8")
    (folder / "block" / "expect.txt").write_text(COMMAND, encoding="utf-8")


def guard(folder, action, *options):
    return program.run([sys.executable, "-B", GUARD, action, folder.path / "record.txt", "--program", folder.ombre, *options])


def builds_that_write_the_same_pass(folder):
    only = ["--quick", "--only", "cone_and_sphere"]
    done = guard(folder, "record", *only, "--threads", "2")
    expect(done.returncode == 0, done.stdout + done.stderr)
    done = guard(folder, "compare", *only)
    expect(done.returncode == 0 and " 0 differ" in done.stdout, done.stdout + done.stderr)


def changed_designs_are_reported(folder):
    cases = folder.path / "cases"
    cases.mkdir()
    write_case(cases, BLOCK)
    done = guard(folder, "record", "--only", "^given/", "--cases", cases)
    expect(done.returncode == 0, done.stdout + done.stderr)
    done = guard(folder, "compare", "--only", "^given/")
    expect(done.returncode == 0, done.stdout + done.stderr)
    write_case(cases, WITHOUT_A_CORNER)
    done = guard(folder, "compare", "--only", "^given/")
    expect(done.returncode == 1, done.stdout + done.stderr)
    for part in ("given/block, given", "out/slice_00001.png: 1 of 16 pixels differ, by 255", "red: 31 voxels",
                 "ombre slice d.vcad --voxel 1 -o out --threads 1"):
        expect(part in done.stdout, f"nothing of {part}: {done.stdout}")
    before, now = (folder.path / "record.txt.differences" / "given" / "block" / "run" / when / "out" for when in ("before", "now"))
    expect((before / "slice_00000.png").read_bytes() == (now / "slice_00000.png").read_bytes(), "the lower layer")
    expect((before / "slice_00001.png").read_bytes() != (now / "slice_00001.png").read_bytes(), "the upper layer")


def jobs_that_are_gone_are_reported(folder):
    only = ["--only", "say-version"]
    guard(folder, "record", *only)
    record = folder.path / "record.txt"
    record.write_text(record.read_text().replace("say-version", "say-version-of-old"))
    done = guard(folder, "compare", *only)
    expect(done.returncode == 1 and "no more: program/ombre say-version-of-old" in done.stdout, done.stdout + done.stderr)


def records_are_checked(folder):
    done = guard(folder, "compare")
    expect(done.returncode == 2 and "./dev guard record" in done.stderr, done.stderr)
    (folder.path / "record.txt").write_text("something\n")
    done = guard(folder, "compare")
    expect(done.returncode == 1 and "is not a record" in done.stderr, done.stderr)


def png_of(rows):
    """A gray image of 8 bits."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    packed = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def differences_are_counted(*_):
    def stl(count):
        return bytes(80) + struct.pack("<I", count) + bytes(50 * count)
    wanted = [
        ("a.png", png_of([[0, 10], [20, 30]]), png_of([[0, 10], [23, 31]]), "2 of 4 pixels differ, by 3 of 255"),
        ("a.png", png_of([[0, 10]]), png_of([[0], [10]]), "1 x 2 pixels, were 2 x 1"),
        ("a.stl", stl(12), stl(14), "14 triangles, were 12"),
        ("a.obj", b"v 0 0 0\nf 1 2 3\n", b"v 0 0 0\nf 1 2 3\nf 1 3 2\n", "2 triangles, were 1"),
        ("a.ply", b"ply\nelement face 5\n", b"ply\nelement face 6\n", "6 triangles, were 5"),
        ("a.off", b"OFF\n4 5 0\n", b"OFF\n4 6 0\n", "6 triangles, were 5"),
        ("a.svg", b"<svg>\n1\n</svg>\n", b"<svg>\n2\n</svg>\n", "-1\n    +2"),
        ("a.npy", b"\0\1\2\3", b"\0\1\3\4", "2 of 4 bytes differ, the first at 2"),
        ("a.glb", b"\0\1", b"\0\1\2", "3 bytes, were 2"),
    ]
    for name, before, now, part in wanted:
        reported = guard_differences.of_contents(name, before, now)
        expect(part in reported, f"{name}: {reported}")
    reported = guard_differences.of_files({"a.npy": b"\0\1", "b": b"", "c": b"\0"},
                                      {"a.npy": b"\0\2", "c": b"\0", "d": b""})
    expect(reported == "1 missing, the first b; 1 new, the first d; "
           "1 of 3 files differ, a.npy: 1 of 2 bytes differ, the first at 1", reported)


def times_and_paths_are_taken_out(folder):
    runner = guard_run.Runner(folder.ombre, 1, folder.path)
    reported = runner.normalised("a\nabout 0:00, 9 KiB of images (gray), at most 2 KiB of memory; nothing was written\n", "x")
    expect(reported == "a\nESTIMATE\n", reported)
    said = f"9 layers written to {folder.path}/x/out; 9 KiB in 1.5e-05 s, 2.5 M voxels/s; 3 mm {guard_jobs.ROOT}/a"
    reported = runner.normalised(said, folder.path / "x")
    expect(reported == "9 layers written to OUT/out; 9 KiB in TIME s, SPEED voxels/s; 3 mm SOURCE/a", reported)


CHECKS = [builds_that_write_the_same_pass, changed_designs_are_reported, jobs_that_are_gone_are_reported, records_are_checked,
          differences_are_counted, times_and_paths_are_taken_out]


if __name__ == "__main__":
    raise SystemExit(program.main(program.Folder, program.named(CHECKS)))
