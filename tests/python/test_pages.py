"""The designs of the pages about volumes and convolution, as they stand there."""
import pathlib
import re

import pytest

import ombre

ROOT = pathlib.Path(__file__).resolve().parents[2]


def designs(page):
    text = (ROOT / "docs" / "user" / page).read_text(encoding="utf-8")
    # Kernels are shown before what they are for.
    return [block for block in re.findall(r"```openscad\n(.*?)```", text, re.S) if "..." not in block]


@pytest.mark.parametrize("page, count", [("volumes.md", 6), ("convolution.md", 2), ("scan-to-print.md", 2)])
def test_designs_of_pages_have_solids(page, count):
    found = designs(page)
    assert len(found) >= count
    earlier: list[str] = []  # later blocks of the guide go on with names of the first
    for block in found:
        # A script's labels are the reader's own.
        block = block.replace("scan.seg.nrrd", "../tests/errors/volumes/segments.seg.nrrd")
        block = block.replace("scan_labels.nrrd", "models/two_lobes.nrrd").replace("examples/models", "models")
        own = [line for line in block.splitlines() if re.match(r"\w+ = ", line)]
        names = {line.split(" ")[0] for line in own}
        before = [line for line in earlier if page == "scan-to-print.md" and line.split(" ")[0] not in names]
        part = ombre.load_text("\n".join([*before, block]), folder=ROOT / "examples")
        assert all(low < high for low, high in zip(*part.bounds)), block
        earlier = before + own
