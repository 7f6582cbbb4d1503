"""What the tests of ombre fea have in common: a folder with designs and a study, and what the program does there."""
import functools
import json
import pathlib
import re
import struct
import tempfile

import program
from program import expect

RED = {"modulus_mpa": 2850, "poissons_ratio": 0.39}
CUBE = "rectprism((10, 10, 10), red);"
MIX = 'fgrade(["0.75", "0.25"], [red, blue]) { rectprism((10, 10, 10), red); }'
PULL = {"materials": {"red": RED, "blue": {"modulus_mpa": 50, "poissons_ratio": 0.39}},
        "supports": [{"on": "xmin", "fix": "x"}, {"on": "ymin", "fix": "y"}, {"on": "zmin", "fix": "z"}],
        "loads": [{"on": "zmax", "pressure_mpa": -100}]}


class Folder:
    def __init__(self, ombre, scratch):
        self.ombre, self.path = ombre, pathlib.Path(scratch)
        self.write("cube.vcad", CUBE)
        self.write("mix.vcad", MIX)
        self.write("pull.json", json.dumps(PULL))

    def write(self, name, text):
        (self.path / name).write_text(text, encoding="utf-8")

    def read(self, name):
        return (self.path / name).read_text(encoding="utf-8")

    def run(self, *arguments, status=0):
        result = program.run([self.ombre, "fea", *arguments], cwd=self.path)
        expect(result.returncode == status, f"status {result.returncode}, not {status}: {result.stderr[-1500:]}")
        return result

    def events(self, *arguments):
        lines = self.run(*arguments, "--json").stdout.splitlines()
        return {event["event"]: event for event in map(json.loads, lines)}

    def array(self, name, field):
        """The floats of a field of a .vtu file."""
        data = (self.path / name).read_bytes()
        tag = re.search(rb'Name="' + re.escape(field.encode()) + rb'" NumberOfComponents="\d+" format="appended" '
                        rb'offset="(\d+)"', data)
        expect(tag, f"{name} has no {field}")
        begin = data.index(b'<AppendedData encoding="raw">\n_') + 31 + int(tag[1])
        size = struct.unpack_from("<Q", data, begin)[0]
        return struct.unpack_from(f"<{size // 4}f", data, begin + 8)


def has_tetrahedra(folder):
    return "built without CGAL" not in program.run(
        [folder.ombre, "fea", "cube.vcad", "--study", "pull.json", "--elements", "tet4", "--size", "5", "--solve"],
        cwd=folder.path).stderr


def check_all(ombre, checks):
    """Each check has a folder of its own."""

    def check(function):
        with tempfile.TemporaryDirectory() as scratch:
            return function(Folder(ombre, scratch))

    return program.check_all([(c.__name__, functools.partial(check, c)) for c in checks])
