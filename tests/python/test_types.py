"""The stubs of ombre and the packages beside it, as mypy reads them."""
import os
import pathlib
import subprocess
import sys

import pytest

import ombre

pytest.importorskip("mypy")

PACKAGES = pathlib.Path(ombre.__file__).parent.parent
GOOD = ("import ombre\nfrom ombre import x\n"
        "part = ombre.sphere(radius=5).translate(z=3) | ombre.cube(3)\n"
        "values = part.distance([[0.0, 0.0, 0.0]]) + 1\n"
        "part.grade({'red': 0.5 + x / 20, 'blue': 0.5}).slice('out', printer='j750', progress=True)\n")
BAD = GOOD + "ombre.sphere(radus=3)\npart.slice('out', prnter='j750')\n"


def test_types(tmp_path):
    def check(*files):
        return subprocess.run([sys.executable, "-m", "mypy", "--follow-imports=silent", *files], cwd=tmp_path,
                              capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(PACKAGES)})
    (tmp_path / "good.py").write_text(GOOD)
    (tmp_path / "bad.py").write_text(BAD)
    packages = [PACKAGES / name for name in ("libvcad", "pyvcad", "pyvcad_attribute_resolver", "pyvcad_compilers", "pyvcad_medical", "pyvcad_metamaterials", "pyvcad_rendering", "pyvcadviz")]
    right = check("good.py", *packages)
    assert right.returncode == 0, right.stdout
    assert check("bad.py").stdout.count("error:") == 2
