"""What the tests of ombre fea have in common: a folder with designs and a study, and what the program does there."""
import re
import struct

import program
from program import expect

RED = {"modulus_mpa": 2850, "poissons_ratio": 0.39}
CUBE = "rectprism((10, 10, 10), red);"
MIX = 'fgrade(["0.75", "0.25"], [red, blue]) { rectprism((10, 10, 10), red); }'
PULL = {"materials": {"red": RED, "blue": {"modulus_mpa": 50, "poissons_ratio": 0.39}},
        "supports": [{"on": "xmin", "fix": "x"}, {"on": "ymin", "fix": "y"}, {"on": "zmin", "fix": "z"}],
        "loads": [{"on": "zmax", "pressure_mpa": -100}]}


class Folder(program.Folder):
    FILES = {"cube.vcad": CUBE, "mix.vcad": MIX, "pull.json": PULL}

    def run(self, *arguments, **options):
        return super().run("fea", *arguments, **options)

    def events(self, *arguments, **options):
        return {event["event"]: event for event in super().events(*arguments, **options)}

    def array(self, name, field):
        return array(self.path / name, field)


def array(path, field, kind="f"):
    """The numbers of a field of a .vtu file."""
    data = path.read_bytes()
    tag = re.search(rb'Name="' + re.escape(field.encode()) + rb'" NumberOfComponents="\d+" format="appended" '
                    rb'offset="(\d+)"', data)
    expect(tag, f"{path.name} has no {field}")
    begin = data.index(b'<AppendedData encoding="raw">\n_') + 31 + int(tag[1])
    size = struct.unpack_from("<Q", data, begin)[0]
    return struct.unpack_from(f"<{size // struct.calcsize(kind)}{kind}", data, begin + 8)


def has_tetrahedra(folder):
    return "built without CGAL" not in program.run(
        [folder.ombre, "fea", "cube.vcad", "--study", "pull.json", "--elements", "tet4", "--size", "5", "--solve"],
        cwd=folder.path).stderr
