"""Layers that the workers of an executor, or of Dask, make have the bytes of one process."""
import concurrent.futures
import hashlib
import linecache
import multiprocessing
import threading

import pytest

import ombre


def part():
    return ombre.Design(ombre.sphere(3) | ombre.cube(4, "blue"))


def contents(folder):
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(folder.iterdir())}


@pytest.fixture
def alone(tmp_path):
    part().slice(tmp_path / "alone", voxel=0.1)
    return contents(tmp_path / "alone")


def processes(count):
    return concurrent.futures.ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn"))


def test_threads(tmp_path, alone):
    shown = []
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        report = part().slice(tmp_path / "shared", client=pool, shares=7, progress=shown.append, voxel=0.1)
    assert contents(tmp_path / "shared") == alone
    assert shown == [n / 7 for n in range(1, 8)] and report["complete"]


def test_processes(tmp_path, alone):
    with processes(2) as pool:
        part().slice(tmp_path / "shared", client=pool, voxel=0.1)
    assert contents(tmp_path / "shared") == alone


def test_dask(tmp_path, alone):
    distributed = pytest.importorskip("distributed")
    with distributed.Client(n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None) as client:
        part().slice(tmp_path / "shared", client=client, shares=5, voxel=0.1)
    assert contents(tmp_path / "shared") == alone


def test_errors_of_workers_come_back(tmp_path):
    with processes(1) as pool, pytest.raises(ombre.DesignError, match="voxel"):
        part().slice(tmp_path / "shared", client=pool, shares=3, voxel=-1)


def test_wrong_calls(tmp_path):
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        with pytest.raises(TypeError, match="resume does not go with client"):
            part().slice(tmp_path / "shared", client=pool, resume=True)
        with pytest.raises(ValueError, match="shares is a whole number from 1 on, not 0"):
            part().slice(tmp_path / "shared", client=pool, shares=0)
    with pytest.raises(TypeError, match="shares are for a client"):
        part().slice(tmp_path / "shared", shares=3)


def test_threads_may_read_a_file_of_code_at_once(monkeypatch):
    """Messages quote the line that made a node. Two threads that quote a new file first once crashed."""
    both = threading.Barrier(2)
    monkeypatch.setattr(linecache, "getlines", lambda file: both.wait() and [] or ["line\n"] * 3)
    code = compile("\nmade = ombre.sphere(3)\n", "no_file_that_is_there.py", "exec")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for future in [pool.submit(exec, code, {"ombre": ombre}) for _ in range(2)]:
            future.result()


STUDY = {"variables": {"x": {"from": -10, "to": 10, "start": 5}},
         "objectives": [{"minimise": "echo", "name": "near"}, {"minimise": "echo", "name": "far"}],
         "evaluations": 96}


@pytest.fixture
def schaffer(tmp_path):
    path = tmp_path / "schaffer.vcad"
    path.write_text("x = 5;\necho(near = x * x, far = (x - 2) * (x - 2));\nsphere(1);\n")
    return path


def test_searches_are_shared(tmp_path, schaffer):
    ombre.optimise(schaffer, tmp_path / "alone", STUDY)
    with processes(2) as pool:
        report = ombre.optimise(schaffer, tmp_path / "shared", STUDY, client=pool, shares=3)
    assert (tmp_path / "shared/history.csv").read_text() == (tmp_path / "alone/history.csv").read_text()
    assert (tmp_path / "shared/front.csv").read_bytes() == (tmp_path / "alone/front.csv").read_bytes()
    best = [event for event in report.events if event["event"] == "best"]
    assert best and all(-0.1 <= event["variables"]["x"] <= 2.1 for event in best)  # Schaffer's front is 0 to 2
    assert not list(tmp_path.glob("shared.*.json"))


def test_wrong_calls_of_searches(tmp_path, schaffer):
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        with pytest.raises(TypeError, match="resume does not go with client"):
            ombre.optimise(schaffer, tmp_path / "shared", STUDY, client=pool, resume=True)
        with pytest.raises(ombre.DesignError, match="topology"):
            ombre.optimise(schaffer, tmp_path / "shared", {"topology": {}}, client=pool)
    with pytest.raises(TypeError, match="shares are for a client"):
        ombre.optimise(schaffer, tmp_path / "shared", STUDY, shares=3)
    assert not list(tmp_path.glob("shared.*.json"))
