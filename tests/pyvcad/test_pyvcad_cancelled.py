"""Compilers that are cancelled write nothing, and can begin again."""
import contextlib

import pytest

import pyvcad as pv
import pyvcad_compilers as pvc
from pyvcad_compilers._compilers import _Compiler
from pyvcad_parts import blue, graded_bar, origin, red


def part(**attributes):
    made = pv.RectPrism(origin, pv.Vec3(8, 8, 8))
    for name, value in attributes.items():
        made.set_attribute(name, value)
    return made


fractions = {"volume_fractions": pv.VolumeFractionsAttribute([(0.5, red), (0.5, blue)])}
table = pv.default_materials
filaments = [{"color_hex": "#ff0000", "slot": 1}, {"color_hex": "#0000ff", "slot": 2}]
compilers = {
    "direct": lambda to: pvc.DirectMaterialCompiler(graded_bar(), 0.5, table, to, "a"),
    "gray": lambda to: pvc.GrayscaleCompiler(graded_bar(), 0.5, pv.Vec3(20, 4, 4), blue, red, to, "a"),
    "mesh": lambda to: pvc.MeshCompiler(graded_bar(), 0.5, to, "a", 2),
    "inkjet": lambda to: pvc.MaterialInkjetCompiler(part(**fractions), 0.5, to, "a", table),
    "colours": lambda to: pvc.ColorInkjetCompiler(part(color_rgba=pv.Vec4Attribute(1, 0, 0, 1)), 0.5, to, "a"),
    "vat": lambda to: pvc.VatCompiler(part(intensity=pv.FloatAttribute(1)), 0.5, to, "a"),
    "vats": lambda to: pvc.MultiMaterialVatCompiler(part(**fractions), to / "a", table, ["red", "blue"], layer_thickness=2,
                                                     output_mode=pvc.MultiMaterialVatOutputMode.ZIP),
    "myerson": lambda to: pvc.MyersonCompiler(0.5, 50.8, 50.8, 0, 0, to, part(**fractions)),
    "bricks": lambda to: pvc.SimulationCompiler(part(), pvc.SimulationCompilerSettings(output_directory=to)),
    "prusa": lambda to: pvc.PrusaSlicerProjectCompiler(part(infill_density=pv.FloatAttribute("50 + 5 * x")), 0.5, to / "a.3mf", 2),
    "mixed": lambda to: pvc.FullSpectrumSlicerProjectCompiler(part(color_rgb=pv.Vec3Attribute(1, 0, 0)), 0.5, to / "a.3mf", filaments),
}


@pytest.mark.parametrize("kind", compilers)
def test_what_is_cancelled_at_the_end_leaves_nothing(tmp_path, monkeypatch, kind):
    new_files = _Compiler._new_files

    @contextlib.contextmanager
    def cancelled_once_all_is_made(compiler, folder):
        with new_files(compiler, folder) as made:
            yield made
            compiler.cancel()

    compiler = compilers[kind](tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(_Compiler, "_new_files", cancelled_once_all_is_made)
        with pytest.raises(RuntimeError, match="cancelled"):
            compiler.compile()
    assert list(tmp_path.iterdir()) == []
    compiler.compile()
    assert any(tmp_path.iterdir())


@pytest.mark.parametrize("kind", ["gray", "myerson", "vats"])
def test_an_error_after_some_layers_leaves_nothing(tmp_path, kind):
    def fail(share):
        if share > 0:
            raise ValueError("the callback fails")

    compiler = compilers[kind](tmp_path)
    compiler.set_progress_callback(fail)
    with pytest.raises(ValueError, match="the callback fails"):
        compiler.compile()
    assert list(tmp_path.iterdir()) == []
