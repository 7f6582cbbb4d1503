#!/usr/bin/env python3
"""Filters over voxels and their parts against SciPy's, on random label maps; stacks of images.

    python3 tests/run_filters.py build/dev/apps/ombre/ombre
"""
import struct
import sys
import zlib

import numpy as np
from scipy import ndimage

import program
from program import expect

sys.path.insert(0, str(program.SOURCE / "tools"))
import make_volumes  # pylint: disable=wrong-import-position

SPACING = (0.5, 0.4, 0.8)  # mm along x, y and z
SHAPE = (15, 13, 9)  # voxels along x, y and z


class Scene(program.Folder):
    """A label map in which about a fifth is void, as a design of two materials and one attribute."""

    def __init__(self, ombre, scratch):
        super().__init__(ombre, scratch)
        rng = np.random.default_rng(31)
        self.labels = rng.choice(3, size=SHAPE, p=(0.2, 0.5, 0.3)).astype(np.uint8)
        # Ends of the lattice hold something, so that it is the whole map.
        self.labels[0, 0, 0] = self.labels[-1, -1, -1] = 1
        header = ("NRRD0004\ntype: uint8\ndimension: 3\nsizes: %d %d %d\nencoding: raw\n"
                  "space: right-anterior-superior\nspace directions: (%g,0,0) (0,%g,0) (0,0,%g)\n"
                  "space origin: (%g,%g,%g)\n\n" % (*SHAPE, *SPACING, *(0.5 * s for s in SPACING)))
        (self.path / "labels.nrrd").write_bytes(header.encode() + self.labels.transpose(2, 1, 0).tobytes())
        self.inside = (self.labels > 0).astype(float)
        self.red, self.blue = ((self.labels == n).astype(float) for n in (1, 2))
        self.value = self.centres(0) + 2 * self.centres(1) * (self.labels == 1)

    def centres(self, axis):
        places = (np.arange(SHAPE[axis]) + 0.5) * SPACING[axis]
        return places.reshape([-1 if a == axis else 1 for a in range(3)]) * np.ones(SHAPE)

    def sample(self, node, what="fractions"):
        """Grids of the design by their names, with axes x, y, z."""
        text = f"""root((0, 0, 0), ({SHAPE[0] * SPACING[0]}, {SHAPE[1] * SPACING[1]}, {SHAPE[2] * SPACING[2]}),
              ({SPACING[0]}, {SPACING[1]}, {SPACING[2]})) {{
          {node} union() {{
            attribute("load", "x + 2*y") volume_solid("labels.nrrd", "red", label=1);
            attribute("load", "x") volume_solid("labels.nrrd", "blue", label=2);
          }} }}"""
        return self.sample_text(text, what)

    def sample_text(self, text, what):
        (self.path / "part.vcad").write_text(text)
        return self.sample_file(what)

    def sample_file(self, what):
        for old in self.path.glob("part*.npy"):
            old.unlink()
        result = program.run([self.ombre, "voxels", "part.vcad", "-o", "part.npy", "--what", what, "--force"], cwd=self.path)
        expect(result.returncode == 0, result.stderr)
        files = sorted(self.path.glob("part*.npy"))
        return {f.stem.removeprefix("part").strip("-_."): np.load(f).transpose(2, 1, 0) for f in files}

    def shares(self, filtered, count_void=False):
        """Fractions of red and blue after a filter of the three flags; void counts or not; none beyond the map."""
        red, blue = (np.maximum(filtered(m), 0) for m in (self.red, self.blue))
        void = np.maximum(filtered(1 - self.inside, 1), 0) if count_void else 0
        total = red + blue + void
        known, divisor = total > 1e-12, np.maximum(total, 1e-12)
        # Where nothing is left the voxel stays as it is.
        return {"red": np.where(known, self.inside * red / divisor, self.red),
                "blue": np.where(known, self.inside * blue / divisor, self.blue)}


def kernel_text(kernel):
    return "[" + ", ".join("[" + ", ".join("[" + ", ".join(map(str, row)) + "]" for row in plane) + "]"
                           for plane in kernel) + "]"


def correlate(kernel):
    """What ombre's kernels mean: weight n belongs to the voxel n - floor(size / 2)."""
    return lambda values, outside=0: ndimage.correlate(values, kernel, mode="constant", cval=outside)


def compare(found, expected, what):
    for name, grid in expected.items():
        difference = np.abs(found[name] - grid).max()
        expect(difference < 2e-6, f"{what}: {name} differs by {difference}")


def convolutions_are_those_of_scipy(scene):
    rng = np.random.default_rng(5)
    for shape in ((3, 3, 3), (2, 4, 1), (5, 1, 3), (1, 1, 1)):
        kernel = rng.integers(0, 9, shape).astype(float)
        kernel[0, 0, 0] += 1
        found = scene.sample(f"convolve({kernel_text(kernel)})")
        compare(found, scene.shares(correlate(kernel)), f"convolve {shape}")
        found = scene.sample(f"convolve({kernel_text(kernel)}, count_void=true)")
        compare(found, scene.shares(correlate(kernel), True), f"convolve {shape} with void")


def products_of_lists_are_the_same_kernel(scene):
    kernel = np.einsum("i,j,k->ijk", (1.0, 2, 1), (1.0, 3, 2, 0.5), (0.25, 1, 0.5))
    compare(scene.sample(f"convolve({kernel_text(kernel)})"), scene.shares(correlate(kernel)), "separable")


def boxes_are_kernels_of_ones(scene):
    for shape in ((4, 3, 2), (1, 6, 5)):
        expected = scene.shares(correlate(np.ones(shape)))
        compare(scene.sample("blend((%d, %d, %d))" % shape), expected, f"blend {shape}")
        compare(scene.sample(f"convolve({kernel_text(np.ones(shape))})"), expected, f"ones {shape}")


def sharpening_keeps_no_negative_share(scene):
    kernel = -np.ones((3, 3, 3))
    kernel[1, 1, 1] = 35
    compare(scene.sample(f"convolve({kernel_text(kernel)})"), scene.shares(correlate(kernel)), "sharpening kernel")
    sigma = (0.9, 0.7, 1.2)

    def sharpened(values, outside=0):
        return 3 * values - 2 * ndimage.gaussian_filter(values, sigma, mode="constant", cval=outside)
    compare(scene.sample("sharpen(2, sigma_voxels=(0.9, 0.7, 1.2))"), scene.shares(sharpened), "sharpen")


def gaussians_are_those_of_scipy(scene):
    for text, sigma in (("sigma_voxels=(1, 0.5, 2)", (1, 0.5, 2)), ("0.6", tuple(0.6 / s for s in SPACING))):
        def blurred(values, outside=0, sigma=sigma):
            return ndimage.gaussian_filter(values, sigma, mode="constant", cval=outside)
        compare(scene.sample(f"gaussian({text})"), scene.shares(blurred), f"gaussian {text}")
        compare(scene.sample(f"gaussian({text}, count_void=true)"), scene.shares(blurred, True), f"{text} with void")


def attributes_are_filtered_inside(scene):
    kernel = np.ones((3, 2, 1)) + np.arange(6).reshape(3, 2, 1)
    mean = correlate(kernel)(scene.value * scene.inside) / np.maximum(correlate(kernel)(scene.inside), 1e-9)
    found = scene.sample(f"convolve({kernel_text(kernel)}, attributes=[\"load\"])", "load")
    (grid,) = found.values()
    difference = np.abs(grid - mean)[scene.inside > 0].max()
    expect(difference < 1e-5, f"attribute differs by {difference}")


def medians_are_those_of_scipy(scene):
    def middle(values):
        known = np.sort(values[~np.isnan(values)])
        return known[(len(known) - 1) // 2] if len(known) else 0
    masked = np.where(scene.inside > 0, scene.value, np.nan)
    expected = ndimage.generic_filter(masked, middle, size=(3, 3, 3), mode="constant", cval=np.nan)
    (grid,) = scene.sample("median([\"load\"])", "load").values()
    difference = np.abs(grid - expected)[scene.inside > 0].max()
    expect(difference < 1e-5, f"median differs by {difference}")


def majorities_count_materials(scene):
    red, blue = (correlate(np.ones((3, 3, 3)))(m) for m in (scene.red, scene.blue))
    own_red = scene.red > 0
    wins = np.where(red == blue, own_red, red > blue)
    compare(scene.sample("majority((3, 3, 3))"), {"red": scene.inside * wins, "blue": scene.inside * ~wins}, "majority")


def ball(radius):
    reach = [int(radius / s) for s in SPACING]
    axes = np.ogrid[tuple(slice(-r, r + 1) for r in reach)]
    return sum((a * s) ** 2 for a, s in zip(axes, SPACING)) <= radius ** 2 * (1 + 1e-9)


def morphology_is_that_of_scipy(scene):
    solid = scene.inside > 0
    for radius in (0.45, 0.81, 1.3):
        element = ball(radius)
        reach = [n // 2 for n in element.shape]
        wide = np.pad(solid, [(2 * r, 2 * r) for r in reach])
        cut = tuple(slice(2 * r, -2 * r or None) for r in reach)
        operations = {"dilate": ndimage.binary_dilation, "erode": ndimage.binary_erosion,
                      "opening": ndimage.binary_opening, "closing": ndimage.binary_closing}
        for name, operation in operations.items():
            if name in ("erode", "opening") and not operation(wide, element).any():
                continue
            found = sum(scene.sample(f"{name}({radius})").values()) > 0.5
            expected = operation(wide, element)[cut]
            expect((found == expected).all(), f"{name} {radius}: {np.sum(found != expected)} voxels differ")


def smoothing_takes_the_half(scene):
    share = ndimage.gaussian_filter(scene.inside, 1.3, mode="constant")
    clear = np.abs(share - 0.5) > 1e-6
    found = sum(scene.sample("smooth(sigma_voxels=(1.3, 1.3, 1.3))").values()) > 0.5
    expect((found == (share >= 0.5))[clear].all(), "smooth differs")


def smoothing_may_keep_the_volume(scene):
    """Of each label as many voxels as before, and those with the greatest shares of the Gaussian."""
    for label in (1, 2):
        solid = np.pad(scene.labels == label, [(int(np.ceil(0.7 / s)),) * 2 for s in SPACING])
        share = ndimage.gaussian_filter(solid.astype(float), [0.7 / s for s in SPACING], mode="constant")
        corner = [-float(np.ceil(0.7 / s)) * s for s in SPACING]
        end = [c + n * s for c, n, s in zip(corner, solid.shape, SPACING)]
        text = ("root((%r, %r, %r), (%r, %r, %r), (%r, %r, %r)) " % (*corner, *end, *SPACING) +
                f'smooth(0.7, keep_volume=true) volume_solid("labels.nrrd", "red", label={label});')
        found = sum(scene.sample_text(text, "fractions").values()) > 0.5
        expect(found.sum() == solid.sum(), f"label {label}: {found.sum()} voxels of {solid.sum()}")
        expect(share[found].min() >= share[~found].max() - 1e-6, f"label {label}: other voxels than those with most")
    expect((share >= 0.5).sum() < 0.5 * solid.sum(), "one half would keep the volume of the rarer label")


def parts_are_those_of_scipy(scene):
    solid = scene.labels == 1
    labels, count = ndimage.label(solid)
    sizes = np.bincount(labels.reshape(-1))[1:]
    volume = SPACING[0] * SPACING[1] * SPACING[2]
    red = 'volume_solid("labels.nrrd", "red", label=1)'

    def found(call):
        text = (f"root((0, 0, 0), ({SHAPE[0] * SPACING[0]}, {SHAPE[1] * SPACING[1]}, {SHAPE[2] * SPACING[2]}), "
                f"({SPACING[0]}, {SPACING[1]}, {SPACING[2]})) {{ {call} {red}; }}")
        return sum(scene.sample_text(text, "fractions").values()) > 0.5
    expect((found("keep_parts()") == (labels == 1 + sizes.argmax())).all(), "largest part")
    least = int(np.median(sizes)) + 1
    wanted = np.isin(labels, 1 + np.flatnonzero(sizes >= least))
    expect((found(f'keep_parts("above", volume={(least - 0.5) * volume})') == wanted).all(), "parts above a volume")
    place = np.argwhere(labels == count)[0]
    at = [(n + 0.5) * s for n, s in zip(place, SPACING)]
    expect((found(f'keep_parts("at", at=({at[0]}, {at[1]}, {at[2]}))') == (labels == count)).all(), "part at a point")
    filled = ndimage.binary_fill_holes(np.pad(solid, 1))[1:-1, 1:-1, 1:-1]
    expect((found("fill_holes()") == filled).all(), "filled holes")
    expect(filled.sum() > solid.sum(), "the map has no holes")


def a_noisy_scan_becomes_clearer(scene):
    """The phantom of examples/sharpened_scan.vcad, whose truth is known: how much of each voxel is of the right material."""
    i, j, k = np.indices((64, 64, 32))
    spots = np.zeros((64, 64, 32), bool)
    for a, b, c, radius in make_volumes.SPOTS:
        spots |= (i - a)**2 + (j - b)**2 + (k - c)**2 < radius**2
    file = program.SOURCE / "examples" / "models" / "noisy_scan.nrrd"
    solid = (f'volume_solid("{file}", transfer(volume("{file}").value, [[50, "cyan"], [250, "magenta"]]), level=25);')

    def shares(filters):
        grids = scene.sample_text(f"root((-32, -32, -16), (32, 32, 16), (1, 1, 1)) {{ {filters} {solid} }}", "fractions")
        inside = grids["cyan"] + grids["magenta"] > 0.5
        right = np.where(spots, grids["magenta"], grids["cyan"])
        return right[inside].mean(), right[inside & spots].mean()
    before, spots_before = shares("")
    after, spots_after = shares("sharpen(5, sigma=3, pitch=(1, 1, 1)) gaussian(1, pitch=(1, 1, 1))")
    expect(abs(before - 0.92) < 0.005 and abs(spots_before - 0.64) < 0.005, f"before: {before}, {spots_before}")
    expect(abs(after - 0.96) < 0.005 and abs(spots_after - 0.97) < 0.005, f"after: {after}, {spots_after}")


def distances_are_those_of_a_ball(scene):
    (scene.path / "part.vcad").write_text("""root((-7, -7, -7), (7, 7, 7), (0.25, 0.25, 0.25))
      redistance(4, pitch=(0.25, 0.25, 0.25)) function("x^2 + y^2 + z^2 - 16", min=(-4, -4, -4), max=(4, 4, 4));""")
    (grid,) = scene.sample_file("distance").values()
    axis = (np.arange(grid.shape[0]) + 0.5) * 0.25 - 7
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    truth = np.sqrt(x * x + y * y + z * z) - 4
    near = np.max(np.abs([x, y, z]), axis=0) < 5.6
    error = np.abs(grid - truth)[near & (truth > -3.5)].max()
    expect(error < 0.35 * 0.25, f"distances are off by {error}")
    expect(np.abs(grid - truth)[np.abs(truth) < 0.1].max() < 0.1 * 0.25, "near the surface")


def stacks_of_slices_are_read_back(scene):
    (scene.path / "two.vcad").write_text("""root((0, 0, 0), (6, 5, 4), (0.5, 0.25, 0.5)) {
      translate(3, 2.5, 2) sphere(2.4, "red"); translate(4.5, 2.5, 1) sphere(1, "blue"); }""")
    program.run([scene.ombre, "slice", "two.vcad", "-o", "stack", "--format", "rgba"], cwd=scene.path)
    images = sorted((scene.path / "stack").rglob("*.png"))
    (scene.path / "images").mkdir()
    for n, image in enumerate(images):  # names whose order as text is another one
        (scene.path / "images" / f"{n + 8}.png").write_bytes(image.read_bytes())
    expect(len(images) == 8, f"{len(images)} images")
    root = "root((0, 0, 0), (6, 5, 4), (0.5, 0.25, 0.5)) "
    whole = program.run([scene.ombre, "voxels", "two.vcad", "-o", "two.npy"], cwd=scene.path)
    expect(whole.returncode == 0, whole.stderr)
    wanted = np.load(scene.path / "two.npy").transpose(2, 1, 0)
    found = scene.sample_text(root + 'voxel("images", (0.5, 0.25, 0.5));', "materials")
    expect((found[""] == wanted).all(), "materials of a stack")
    shade = scene.sample_text(root + 'voxel("images", (0.5, 0.25, 0.5), materials=[["#ff0000", "green"]]);', "fractions")
    expect((shade["green"] == (wanted == 1)).all(), "a colour that is given another material")
    (scene.path / "images" / "11.png").unlink()
    result = program.run([scene.ombre, "voxels", "part.vcad", "-o", "part.npy", "--force"], cwd=scene.path)
    expect("number 11 is missing" in result.stderr, result.stderr)


def png(pixels):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 16, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def grey_stacks_are_volumes(scene):
    numbers = np.random.default_rng(8).integers(0, 65536, SHAPE)
    (scene.path / "grey").mkdir()
    for k in range(SHAPE[2]):
        (scene.path / "grey" / f"slice_{k}.png").write_bytes(png(np.flipud(numbers[:, :, k].T)))
    x, y, z = (n * s for n, s in zip(SHAPE, SPACING))
    spacing, half = f"({SPACING[0]}, {SPACING[1]}, {SPACING[2]})", [0.5 * s for s in SPACING]
    text = (f'root((0, 0, 0), ({x}, {y}, {z}), {spacing}) attribute("v", volume("grey", spacing={spacing}, '
            f'origin=({half[0]}, {half[1]}, {half[2]})).value) rectprism(({3 * x}, {3 * y}, {3 * z}));')
    (grid,) = scene.sample_text(text, "v").values()
    expect((grid == numbers).all(), "numbers of a grey stack")


CHECKS = [convolutions_are_those_of_scipy, products_of_lists_are_the_same_kernel, boxes_are_kernels_of_ones,
          sharpening_keeps_no_negative_share, gaussians_are_those_of_scipy, attributes_are_filtered_inside,
          medians_are_those_of_scipy, majorities_count_materials, morphology_is_that_of_scipy,
          smoothing_takes_the_half, smoothing_may_keep_the_volume, a_noisy_scan_becomes_clearer, parts_are_those_of_scipy, distances_are_those_of_a_ball,
          stacks_of_slices_are_read_back, grey_stacks_are_volumes]


if __name__ == "__main__":
    raise SystemExit(program.main(Scene, program.named(CHECKS)))
