"""Convolutions, blends and voxels of images, in the forms of pyvcad 2 and 3."""
import pathlib

import numpy
import pytest

import ombre
import pyvcad as pv

ROOT = pathlib.Path(__file__).resolve().parents[2]
red, blue = pv.default_materials.id("red"), pv.default_materials.id("blue")


def halves():
    return pv.Union(False, [pv.RectPrism(pv.Vec3(-3, 0, 0), pv.Vec3(6, 6, 2), red),
                            pv.RectPrism(pv.Vec3(3, 0, 0), pv.Vec3(6, 6, 2), blue)])


def test_kernels():
    assert pv.Convolution.BlendKernel(2, 1, 3) == [[[1, 1, 1]], [[1, 1, 1]]]
    kernel = numpy.array(pv.Convolution.PassKernel(3, 4, 5))
    assert kernel.sum() == 1 and kernel[1, 2, 2] == 1
    assert numpy.shape(pv.BoxKernel(1).weights) == (3, 3, 3)
    custom = pv.CustomKernel(range(1, 28), 1, 1, 1).weights
    assert custom[0][0][1] == 2 and custom[1][0][0] == 10


def test_kernels_say_what_is_wrong():
    with pytest.raises(ValueError, match="27 weights, found 3"):
        pv.CustomKernel([1, 2, 3], 1, 1, 1)
    with pytest.raises(ValueError, match="equal length"):
        pv.Convolution([[[1], [2, 3]]], halves())
    with pytest.raises(TypeError, match="expected a BoxKernel or CustomKernel"):
        pv.Convolve(halves(), [], [[[1]]], pv.Vec3(1, 1, 1))
    with pytest.raises(ValueError, match="populate_with_png_stack"):
        pv.Voxels(0.5, pv.Vec3(0, 0, 0)).prepare()


@pytest.mark.parametrize("node", [
    lambda: pv.Convolution(pv.Convolution.BlendKernel(11, 1, 1), halves()), lambda: pv.Blend(1.1, halves()),
    lambda: pv.Blend(halves(), [], pv.Vec3(1.1, 1.1, 1.1)),
    lambda: pv.Convolve(halves(), [], pv.BoxKernel(5), pv.Vec3(1, 1, 1))])
def test_borders_become_ramps(node):
    """A mean over 2.2 mm (11 voxels of 0.2 mm) goes from red to blue in a straight line between x = -1.1 and 1.1. Each
    row of voxels across it has 300 draws, whose share lies within 0.12 of the odds, four times its deviation."""
    colours = node().toRGBAArray(0.2, pv.default_materials, blend=False)
    x = -6 + 0.2 * (numpy.arange(len(colours)) + 0.5)
    share = (colours[..., 0] == 255).mean(axis=(1, 2))
    assert numpy.allclose(share, numpy.clip((1.1 - x) / 2.2, 0, 1), atol=0.12)


def test_attributes_are_filtered():
    part = pv.RectPrism(pv.Vec3(0, 0, 0), pv.Vec3(8, 4, 4), red)
    part.set_attribute(pv.DefaultAttributes.MODULUS, pv.FloatAttribute("if(x < 0, 0, 100)"))
    node = pv.Blend(part, ["modulus"], pv.Vec3(1, 1, 1), num_passes=1)
    grid = pv.TreeSampler(node, pv.Vec3(0.25, 0.25, 0.25)).as_float_array("modulus")
    assert grid.shape == (32, 16, 16)
    assert grid[0, 8, 8] == pytest.approx(0, abs=0.5) and grid[-1, 8, 8] == pytest.approx(100, abs=0.5)
    assert grid[15:17, 8, 8].mean() == pytest.approx(50, abs=3)


def test_voxels_of_images():
    stack = ROOT / "examples" / "models" / "stack"
    by_file = pv.Voxels(str(stack), pv.Vec3(0.5, 0.5, 1), pv.Vec3(0, 0, 0), pv.default_materials)
    filled = pv.Voxels(pv.Vec3(1, 1, 1), pv.Vec3(0, 0, 0))
    filled.populate_with_png_stack(str(stack), pv.Vec3(0, 0, 0), pv.Vec3(0.5, 0.5, 1))
    assert by_file.bounding_box() == filled.bounding_box()
    assert numpy.array_equal(by_file.toRGBAArray(0.5, pv.default_materials), filled.toRGBAArray(0.5, pv.default_materials))
