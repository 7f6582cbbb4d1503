"""Says in a line or two how an output differs from what it was."""
import difflib
import io
import re
import struct
import zipfile

from guard_jobs import program  # noqa: F401  puts the tests' helpers on the path
import png

LINES_SHOWN, LETTERS_SHOWN = 6, 160


def of_files(before, now):
    """Of two sets of files (contents by name): how many differ, and how one of them does."""
    lines = []
    for word, names in (("missing", before.keys() - now.keys()), ("new", now.keys() - before.keys())):
        if names:
            lines.append(f"{len(names)} {word}, the first {min(names)}")
    different = sorted(name for name in before.keys() & now.keys() if before[name] != now[name])
    if different:
        # A job's description changes with its images, which say more.
        name = next((each for each in different if not each.endswith((".json", ".jsonl"))), different[0])
        which = name if len(now) == 1 else f"{len(different)} of {len(now)} files differ, {name}"
        lines.append(f"{which}: {of_contents(name, before[name], now[name])}")
    return "; ".join(lines)


def of_contents(name, before, now):
    for describe in (of_pictures, of_meshes, of_texts):
        try:
            lines = describe(name, before, now)
        except (ValueError, KeyError, struct.error, zipfile.BadZipFile):
            lines = ""
        if lines:
            return lines
    return of_bytes(before, now)


def of_pictures(name, before, now):
    if not name.endswith(".png"):
        return ""
    a, b = png.Image(before), png.Image(now)
    if (a.width, a.height) != (b.width, b.height):
        return f"{b.width} x {b.height} pixels, were {a.width} x {a.height}"
    differences = [max(abs(u - v) for u, v in zip(p, q)) for row, other in zip(a.rows, b.rows)
                   for p, q in zip(row, other) if p != q]
    if not differences:
        return "the same pixels, packed in another way"
    return f"{len(differences)} of {a.width * a.height} pixels differ, by {max(differences)} of 255 at most"


def of_meshes(name, before, now):
    counts = [triangles(name, content) for content in (before, now)]
    if None in counts:
        return ""
    return f"{counts[1]} triangles, were {counts[0]}; " + of_bytes(before, now)


def triangles(name, content):
    """Number of triangles in a mesh file, None if it is none."""
    ending = name.rpartition(".")[2]
    if ending == "stl":
        return struct.unpack_from("<I", content, 80)[0]
    if ending == "3mf":
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            return sum(archive.read(each).count(b"<triangle ") for each in archive.namelist() if each.endswith(".model"))
    if ending == "obj":
        return content.count(b"\nf ")
    if ending == "amf":
        return content.count(b"<triangle>")
    if ending in ("ply", "off"):
        found = re.match(rb".*?element face (\d+)" if ending == "ply" else rb"\w*OFF\s+\d+ (\d+)", content, re.S)
        return int(found[1]) if found else None
    return None


def of_texts(_, before, now):
    """The first lines that differ."""
    if b"\0" in before[:4096] + now[:4096]:
        return ""
    lines = difflib.unified_diff(before.decode().splitlines(), now.decode().splitlines(), lineterm="", n=0)
    changed = [line for line in lines if not line.startswith(("---", "+++", "@@"))]
    if not changed:
        return "other line ends"
    shown = [line if len(line) <= LETTERS_SHOWN else line[:LETTERS_SHOWN] + "..." for line in changed[:LINES_SHOWN]]
    more = [f"and {len(changed) - LINES_SHOWN} more lines"] if len(changed) > LINES_SHOWN else []
    return "".join(f"\n    {line}" for line in shown + more)


def of_bytes(before, now):
    if len(before) != len(now):
        return f"{len(now)} bytes, were {len(before)}"
    first = next(i for i, (a, b) in enumerate(zip(before, now)) if a != b)
    return f"{sum(a != b for a, b in zip(before, now))} of {len(now)} bytes differ, the first at {first}"
