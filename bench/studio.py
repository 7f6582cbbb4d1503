#!/usr/bin/env python3
"""Times the answers of the studio through its API, and measures the server's memory after many edits.

    python3 bench/studio.py build/release/apps/ombre/ombre
    python3 bench/studio.py build/release/apps/ombre/ombre --edits 30 --only 'gear|knob'

bench/README.md explains the columns. Nothing is asserted: figures are for this machine, now.
"""
import argparse
import base64
import contextlib
import json
import math
import os
import pathlib
import re
import secrets
import shutil
import socket
import statistics
import struct
import subprocess
import sys
import time
import urllib.parse

import programs
from table import Table, seconds

PRINTER = {"printer": "j750"}
QUICK = {"width": 120, "height": 90, "samples": 1}     # as the page begins with designs that take it long
FIRST = {"width": 360, "height": 270, "samples": 1}    # as it begins with others
LONG = 0.12                                            # of the first picture, seconds
SCREEN = {"width": 1200, "height": 900, "samples": 1}  # as fine as its view on a usual screen
SLIDER_FRAMES = 15

# Hollow, graded along x, and nearly as wide and as high as the tray of the J750.
TRAY = """inner = 20;
fgrade(["x / 490", "1 - x / 490"], [red, blue])
  translate(245, 195, 100) difference() { cylinder(radius=190, height=200); cylinder(radius=inner, height=201); }
"""


class Refused(Exception):
    """The studio answered with an error."""


class Connection:
    """A WebSocket to the studio (RFC 6455), for one request at a time."""

    def __init__(self, url):
        address = urllib.parse.urlsplit(url)
        self.socket = socket.create_connection((address.hostname, address.port), timeout=600)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.stream = self.socket.makefile("rb")
        key = base64.b64encode(secrets.token_bytes(16)).decode()
        self.socket.sendall((f"GET /api?{address.query} HTTP/1.1\r\nHost: {address.netloc}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        status = self.stream.readline().decode().strip()
        if " 101 " not in status:
            raise Refused(status)
        while self.stream.readline().strip():
            pass
        self.last = 0
        self.jobs = {}  # the last event of each

    def _send(self, kind, payload):
        length = len(payload)
        head = bytes([0x80 | kind])
        if length < 126:
            head += bytes([0x80 | length])
        elif length < 65536:
            head += struct.pack(">BH", 0x80 | 126, length)
        else:
            head += struct.pack(">BQ", 0x80 | 127, length)
        self.socket.sendall(head + bytes(4) + payload)  # the mask is zero: nothing between here and there is misled

    def _frame(self):
        first, second = self.stream.read(2)
        length = second & 0x7f
        if length == 126:
            length, = struct.unpack(">H", self.stream.read(2))
        elif length == 127:
            length, = struct.unpack(">Q", self.stream.read(8))
        return first & 0x80, first & 0x0f, self.stream.read(length)

    def _message(self):
        """The next message: what JSON says, and the bytes behind it."""
        payload, opcode = b"", 0
        while True:
            is_last, kind, part = self._frame()
            if kind == 9:
                self._send(10, part)
            elif kind == 8:
                raise Refused("the studio closed the connection")
            elif kind in (0, 1, 2):
                payload += part
                opcode = kind or opcode
                if is_last:
                    break
        if opcode == 1:
            return json.loads(payload), b""
        length, = struct.unpack("<I", payload[:4])
        return json.loads(payload[4:4 + length]), payload[4 + length:]

    def _hear(self):
        told, data = self._message()
        if told.get("event") == "job":
            self.jobs[told["job"]["id"]] = told["job"]
        return told, data

    def ask(self, what, **members):
        self.last += 1
        self._send(1, json.dumps({"id": self.last, "do": what, **members}).encode())
        while True:
            told, data = self._hear()
            if told.get("id") != self.last:
                continue
            if "error" in told:
                raise Refused(f"{what}: {told['error']}: {told.get('message')}")
            return told, data

    def finish(self, job):
        """Waits for the end of a job; returns its last event."""
        while self.jobs.get(job, {}).get("state") not in ("done", "failed", "cancelled"):
            self._hear()
        if self.jobs[job]["state"] != "done":
            raise Refused(self.jobs[job]["message"])
        return self.jobs[job]


class Example:
    """A script, and the number of it that edits change."""

    def __init__(self, name, variable, text):
        self.name, self.variable, self.text = name, variable, text
        self.edits = 0

    @property
    def file(self):
        return f"{self.name}.vcad"

    def edited(self):
        """The script with the number a little greater than it ever was, so that nothing is known of it."""
        self.edits += 1
        def greater(found):
            return f"{found[1]}{float(found[2]) * (1 + 1e-5 * self.edits):.9g}"
        text, count = re.subn(rf"(?m)^({self.variable}\s*=\s*)([0-9.]+)", greater, self.text, count=1)
        if count != 1:
            raise programs.Failed(f"{self.file} has no number called {self.variable}")
        return text


def examples():
    chosen = [("knob", "diameter"), ("gear", "core"), ("wheel", "axle"), ("gyroid_block", "size"),
              ("organic_lattice", "radius")]
    return [Example(name, variable, (programs.ROOT / "examples" / f"{name}.vcad").read_text(encoding="utf-8"))
            for name, variable in chosen]


@contextlib.contextmanager
def studio(ombre, folder):
    environment = dict(os.environ, OMBRE_DATA=str(programs.ROOT), NO_COLOR="1")
    command = [ombre, "studio", folder, "--no-browser", "--json"]
    with programs.child(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                        env=environment) as process:
        try:
            for line in process.stdout:
                if line.startswith("{") and json.loads(line).get("event") == "studio":
                    yield process, Connection(json.loads(line)["url"])
                    return
            raise programs.Failed(f"the studio did not begin; see what {' '.join(map(str, command))} says")
        finally:
            process.terminate()
            process.wait()


def load(connection, example):
    loaded, _ = connection.ask("load", file=example.file, text=example.edited())
    if not loaded["ok"]:
        raise programs.Failed(f"{example.file}: {loaded['diagnostics']}")
    return loaded["design"]


def timed(work):
    began = time.monotonic()
    result = work()
    return time.monotonic() - began, result


def window(count):
    """A tile of at most 1024 x 1024 voxels that is well within the design."""
    size = [min(1024, n) for n in count[:2]]
    return {"x": (count[0] - size[0]) // 3, "y": (count[1] - size[1]) // 2, "width": size[0], "height": size[1]}


def after_an_edit(connection, example, then, runs=5):
    def once():
        return then(load(connection, example))
    return statistics.median(timed(once)[0] for _ in range(runs))


def slider(connection, design, plan, place):
    """The median time of a frame while layers go by."""
    layers = [round(plan["count"][2] * (n + 1) / (SLIDER_FRAMES + 1)) for n in range(SLIDER_FRAMES)]
    return statistics.median(
        timed(lambda layer=layer: connection.ask("tile", design=design, layer=layer, **window(plan["count"]), **PRINTER,
                                                 **place))[0] for layer in layers)


def first_tile(connection, design, place):
    plan, _ = connection.ask("plan", design=design, **PRINTER, **place)
    connection.ask("tile", design=design, layer=plan["count"][2] // 2, **window(plan["count"]), **PRINTER, **place)
    return plan


def full_slice(connection, design, example, folder):
    started, _ = connection.ask("export", design=design, folder=f"{example.name}_slices", file=example.file,
                                replace=True, **PRINTER)
    connection.finish(started["job"]["id"])
    written = sum(f.stat().st_size for f in (folder / f"{example.name}_slices").iterdir())
    shutil.rmtree(folder / f"{example.name}_slices")
    return written


def picture_sizes(connection, example):
    """Sizes of the pictures that the page requests, in order: it begins with a smaller one if the first took long."""
    design = load(connection, example)
    duration, _ = timed(lambda: connection.ask("render", design=design, **FIRST))
    return [QUICK, FIRST, SCREEN] if duration > LONG else [FIRST, SCREEN]


def row(connection, example, folder, place, is_sliced):
    """The figures of a line of the table."""
    figures = {"design": example.name}
    sizes = picture_sizes(connection, example)
    figures["pixels"] = sizes[0]["width"] * sizes[0]["height"]
    figures["picture"] = after_an_edit(connection, example, lambda d: connection.ask("render", design=d, **sizes[0]))
    figures["screen"] = after_an_edit(connection, example, lambda d: [
        connection.ask("render", design=d, **size) for size in sizes])
    figures["tile"] = after_an_edit(connection, example, lambda d: first_tile(connection, d, place))
    design = load(connection, example)
    plan = first_tile(connection, design, place)
    figures["voxels"] = math.prod(plan["count"])
    figures["slider"] = slider(connection, design, plan, place)
    if is_sliced:
        figures["slice"], figures["bytes"] = timed(
            lambda: full_slice(connection, load(connection, example), example, folder))
        return figures
    figures["estimate"], (told, _) = timed(lambda: connection.ask("estimate", design=design, **PRINTER, **place))
    figures["slice"], figures["bytes"] = told["seconds"], told["bytes"]
    return figures


def resident(process):
    """Bytes of memory that the server has."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
    return int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]) * 1024


def memory(process, connection, chosen, edits):
    """Memory of the server after a third of the edits and after all; each edit is viewed as the page does."""
    points = []
    for n in range(1, edits + 1):
        example = chosen[n % len(chosen)]
        design = load(connection, example)
        connection.ask("render", design=design, **FIRST)
        connection.ask("render", design=design, **SCREEN)
        first_tile(connection, design, {})
        if n in (edits // 3, 2 * edits // 3, edits):
            points.append({"edits": n, "bytes": resident(process)})
    return points


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ombre", type=pathlib.Path, help="the program")
    parser.add_argument("--edits", type=int, default=300, help="edits after which memory is looked at (default 300)")
    parser.add_argument("--only", metavar="PATTERN", help="examples whose names hold this regular expression")
    parser.add_argument("--no-tray", action="store_true", help="leave out the full tray")
    parser.add_argument("--scratch", metavar="DIR", default=programs.memory_disk(),
                        help="where jobs are written and removed (default: /dev/shm if there is room)")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="also write all figures there")
    return parser.parse_args()


def show(table, figures, is_sliced):
    waits = [f"{1000 * figures[name]:.1f}" for name in ("picture", "screen", "tile", "slider")]
    table.row(figures["design"], f"{figures['voxels']:.2g}", *waits, seconds(figures["slice"], not is_sliced),
              f"{figures['bytes'] / 1e6:,.0f}")


def main():
    a = arguments()
    programs.stop_on_signals()
    chosen = [example for example in examples() if not a.only or re.search(a.only, example.name)]
    if not chosen:
        raise programs.Failed(f"no example is named like {a.only}")
    results = {"rows": []}
    with programs.scratch_folder(a.scratch) as folder, studio(a.ombre.resolve(), folder) as (process, connection):
        shutil.copytree(programs.ROOT / "examples" / "models", folder / "models")
        for example in chosen:
            (folder / example.file).write_text(example.text, encoding="utf-8")
        print(f"{os.cpu_count()} cores; times since an edit, of a frame since its question; ~ marks an estimate\n")
        table = Table(("design, J750", 16), ("voxels", 8), ("first picture\nms", 14), ("screen\nms", 7),
                      ("first slice\nms", 12), ("z-slider frame\nms", 15), ("full slice\ns", 11), ("files\nMB", 8))
        for example in chosen:
            results["rows"].append(row(connection, example, folder, {}, True))
            show(table, results["rows"][-1], True)
        if not a.no_tray:
            results["rows"].append(row(connection, Example("full tray", "inner", TRAY), folder, {"tray": True}, False))
            show(table, results["rows"][-1], False)
        table.row("Foundry, Table 1", "3-16e9", "", "", "160-460", "", "7.5-23.3", "")
        print("(its own designs, on its machine; its full slice is one cross-section, ours is all files of the job)\n")
        if a.edits >= 3:
            results["memory"] = memory(process, connection, chosen, a.edits)
            print("memory of the server: " + ", ".join(
                f"{point['bytes'] / 1e6:.0f} MB after {point['edits']} edits" for point in results["memory"]))
    if a.json:
        a.json.write_text(json.dumps(results, indent=1))


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
    except (programs.Failed, Refused) as problem:
        sys.exit(f"bench: {problem}")
