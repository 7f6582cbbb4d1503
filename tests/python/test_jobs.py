"""Jobs of the package ombre: what they write, their progress, interrupts."""
import signal
import subprocess
import sys
import threading
import time

import numpy
import pytest

import ombre


def test_jobs_write_files(tmp_path):
    part = ombre.sphere(3) | ombre.cube(4, "blue")
    report = part.mesh(tmp_path / "part.3mf", tolerance=0.1, by="materials", force=True)
    assert (tmp_path / "part.3mf").stat().st_size > 1000 and report.events
    part.contours(tmp_path / "part.svg", z=0)
    part.layer(tmp_path / "layer.png", z=1, voxel=0.1)
    part.write_voxels(tmp_path / "part.nrrd", voxel=0.5)
    part.render(tmp_path / "part.png", size="80x60", from_=(30, 20), opacity={"blue": 0.5}, cut=["x=0", "z>1"])
    assert part.render(size="80x60").startswith(b"\x89PNG")
    assert "data:image/png" in part._repr_html_()
    with pytest.raises(ombre.MachineError, match="exists already"):
        part.mesh(tmp_path / "part.3mf")


def test_struts_are_written_as_beams(tmp_path):
    struts = ombre.lattice("bcc", (4, 4, 4), 0.5, material="green")
    ball = ombre.sphere(1).translate(z=5)
    report = (struts - ombre.cylinder(1, 10) | ball).mesh(tmp_path / "part.3mf", tolerance=0.02, beams=True)
    (bodies,) = [event for event in report.events if event["event"] == "bodies"]
    assert (bodies["beams"], bodies["clips"], len(bodies["bodies"])) == (8, 1, 1)
    read = ombre.mesh(tmp_path / "part.3mf")
    assert read.inside([[1.5, 1.5, 1.5], [0.1, 0, 0.3], [0, 0, 5], [1.5, 1.5, 0]]).tolist() == [True, False, True, False]
    with pytest.raises(ombre.DesignError, match="beams are for .3mf"):
        struts.mesh(tmp_path / "part.stl", beams=True)
    with pytest.raises(ombre.DesignError, match="flavour=.prusa. has no beams"):
        struts.mesh(tmp_path / "other.3mf", beams=True, flavour="prusa")
    with pytest.raises(ombre.DesignError, match="no bands"):
        struts.mesh(tmp_path / "other.3mf", beams=True, bands=3)
    with pytest.raises(ombre.DesignError, match="leave beams out"):
        ball.mesh(tmp_path / "other.3mf", beams=True)


def test_parts_are_shown_without_a_display(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "OMBRE_RENDER"):
        monkeypatch.delenv(name, raising=False)
    part = ombre.Design(**{"a <b>": ombre.cube(4, "blue")})
    part.show(size="80x60")
    assert (tmp_path / "ombre.png").read_bytes().startswith(b"\x89PNG")
    part.show("page.html", frames=5, size="80x60")
    page = (tmp_path / "page.html").read_text()
    assert page.count('"iVBORw0KGgo') == 5 and "<title>a &lt;b&gt;</title>" in page
    monkeypatch.setenv("OMBRE_RENDER", "other.png")
    part.show(size="80x60")
    assert (tmp_path / "other.png").exists()
    monkeypatch.delenv("OMBRE_RENDER")
    monkeypatch.setenv("DISPLAY", ":0")
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    part.show(size="80x60", frames=3)
    assert len(opened) == 1 and opened[0].endswith(".html")


def test_progress_is_reported(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    reported = []
    part = ombre.function("sin(9*x)*cos(9*y) + sin(9*y)*cos(9*z) + sin(9*z)*cos(9*x)", min=(-9, -9, -9), max=(9, 9, 9))
    part.slice("slow", progress=reported.append, voxel=0.011, layers=":200", threads=1)
    assert all(0 <= share <= 1 for share in reported)

    def fail(share):
        raise RuntimeError("enough")
    part.slice("slow", progress=True, voxel=0.011, layers=":200", threads=1, force=True)
    if reported:  # there was time to tell
        with pytest.raises(RuntimeError, match="enough"):
            part.slice("slow", progress=fail, voxel=0.011, threads=1, force=True)


class Bar:
    """What tqdm's bar receives, and what of it is used."""

    def __init__(self, unit, unit_scale):
        bars.append(self)
        self.unit, self.n, self.total = unit, 0, None

    def update(self, more):
        self.n += more

    def close(self):
        pass


bars = []


@pytest.mark.parametrize("job, unit", [("slice", " voxels"), ("mesh", " steps"), ("contours", " steps")])
def test_progress_of_each_job(job, unit, tmp_path, monkeypatch):
    from ombre import _commands
    bars.clear()
    monkeypatch.setattr(_commands.Progress, "_find_tqdm", staticmethod(lambda: Bar))
    part = ombre.function("sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)", min=(-9, -9, -9), max=(9, 9, 9))
    options = {"slice": {"voxel": 0.006, "layers": ":600"}, "mesh": {"cell": 0.2},
               "contours": {"layer_height": 0.08, "cell": 0.03, "tolerance": 0.1}}[job]
    path = tmp_path / {"slice": "layers", "mesh": "part.stl", "contours": "part.cli"}[job]
    getattr(part, job)(path, progress=True, threads=1, **options)
    assert [bar.unit for bar in bars] == [unit], "the job was over before there was anything to tell"
    assert bars[0].n == bars[0].total > 0


def test_studies_may_be_dicts(tmp_path):
    study = {"materials": {"red": {"modulus_mpa": 2850, "poissons_ratio": 0.39}},
             "supports": [{"on": "xmin", "fix": "x"}, {"on": "ymin", "fix": "y"}, {"on": "zmin", "fix": "z"}],
             "loads": [{"on": "zmax", "pressure_mpa": -100}]}
    report = ombre.cube(10, "red").fea(tmp_path / "cube.vtu", study=study, cell=5, solve=True)
    solution = next(e for e in report.events if e["event"] == "solution")
    assert solution["greatest_displacement_mm"][2] == pytest.approx(1000 / 2850)  # Hooke's law
    assert (tmp_path / "cube.vtu").read_bytes().startswith(b"<?xml")
    with pytest.raises(ombre.DesignError, match="free to move"):
        ombre.cube(10, "red").fea(study={**study, "supports": []}, cell=5, solve=True)


def test_even_cells_are_as_stiff_as_their_material(tmp_path):
    study = {"materials": {"red": {"modulus_mpa": 2850, "poissons_ratio": 0.39}}}
    report = ombre.cube(10, "red").homogenise(tmp_path / "cube.svg", study=study, cell=5)
    assert report["modulus_mpa"] == pytest.approx([2850] * 3, rel=1e-5)
    assert (tmp_path / "cube.svg").read_text().startswith("<svg")
    with pytest.raises(TypeError, match="did you mean 'tolerance'"):
        ombre.cube(10, "red").homogenise(study=study, cell=5, tolerence=1e-3)


def test_scripts_are_optimised(tmp_path):
    """The least of (x - 0.25)^2, whose place is known."""
    (tmp_path / "least.vcad").write_text("x = 0.9;\necho(cost = (x - 0.25)*(x - 0.25));\ncube(1, red);")
    study = {"variables": {"x": {"from": 0, "to": 1}}, "objectives": [{"minimise": "echo", "name": "cost"}],
             "method": "bobyqa", "evaluations": 40}
    report = ombre.optimise(tmp_path / "least.vcad", tmp_path / "found", study, best=1)
    best, = (e for e in report.events if e["event"] == "best")
    assert best["variables"]["x"] == pytest.approx(0.25, abs=1e-3)
    assert len(list((tmp_path / "found").glob("best_*.vcad"))) == 1
    with pytest.raises(TypeError, match="did you mean 'resume'"):
        ombre.optimise(tmp_path / "least.vcad", tmp_path / "found", study, resum=True)


def test_interrupts_stop_jobs(tmp_path):
    script = tmp_path / "long.py"
    script.write_text("import ombre, sys\n"
                      "part = ombre.function('sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)', min=(-50,)*3, max=(50,)*3)\n"
                      "try:\n    part.slice('layers', voxel=0.02)\n"
                      "except KeyboardInterrupt:\n    print('stopped')\n    part.slice('layers', voxel=0.02, resume=True,"
                      " dry_run=True)\n    print('went on')\n")
    process = subprocess.Popen([sys.executable, script], cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    journal = tmp_path / "layers/journal.jsonl"
    while not journal.exists() and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate()
    assert out == "stopped\nwent on\n"


def test_python_may_exit_during_a_job(tmp_path):
    code = ("import ombre, threading, time\n"
            "part = ombre.sphere(5)\n"
            "threading.Thread(target=lambda: part.slice('layers', voxel=0.005), daemon=True).start()\n"
            "time.sleep(0.3)\n")
    result = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr


# Behaviour as a library.


def test_voxels_may_hold_attributes():
    # The attribute grows by 1 a millimetre along x, from -5 at the left side; 7 is its default outside.
    part = ombre.attribute("heat", "x", ombre.cube(10, "red"), unit="K", default=7)
    grid = part.voxels(1, what="heat")
    assert grid.about["attribute"] == {"name": "heat", "unit": "K", "default": 7}
    assert grid.values.shape == (10, 10, 10) and grid.values.dtype == numpy.float32
    assert grid.values[3, 4] == pytest.approx(numpy.arange(-4.5, 5))
    assert grid.spacing == (1, 1, 1) and grid.origin == (-4.5, -4.5, -4.5)


def test_voxels_of_a_material_that_the_design_lacks_are_zero():
    assert not ombre.cube(2, "red").voxels(1, what="blue").values.any()
    with pytest.raises(ombre.DesignError, match="'rde' is neither"):
        ombre.cube(2, "red").voxels(1, what="rde")


def test_every_kind_of_job_is_there(tmp_path):
    part = ombre.cube(10, "red")
    report = part.probe(at=["0,0,0", (9, 0, 0)])
    assert [e["inside"] for e in report.events if e["event"] == "point"] == [True, False]
    part.slice(tmp_path / "layers", voxel=1)
    ombre.run_job("sheet", folder=tmp_path / "layers", output=tmp_path / "sheet.png")
    assert (tmp_path / "sheet.png").read_bytes().startswith(b"\x89PNG")
    assert "j750" in ombre.run_job("printers").events[0]["name"] + str(ombre.run_job("printers").events)
    with pytest.raises(ombre.DesignError, match='"folder" is required'):
        ombre.run_job("sheet", output=tmp_path / "other.png")
    with pytest.raises(KeyError):
        ombre.run_job("fly")


def test_a_design_in_memory_has_no_variables():
    with pytest.raises(ombre.DesignError, match="neither variables"):
        ombre.cube(10, "red").homogenise(density=0.25, by="side=5:10", cell=5,
                                           study={"materials": {"red": {"modulus_mpa": 1, "poissons_ratio": 0}}})
