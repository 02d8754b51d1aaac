"""Python's sweep: the same table by any executor, and whole though a worker is killed."""

import csv
import os
import pickle
import shutil
import signal
import subprocess
import sys
import threading
from concurrent import futures

import numpy as np
import pytest

import launch
from test_python import BUILT, mortise, solves

pytestmark = solves
SCENE = launch.ROOT / "geo/lift_off.toml"
VARY = {
    "mesh.parameters.n_plate": [16, 20, 24, 0.5],  # the last is no number of elements
    "boundary.2.pressure": [1e6 + 1e4 * k for k in range(62)] + [-2e8, 3e6],  # the last but one opens the contact
}

COARSE = {"mesh.parameters.n_block": 20}


def assert_equal(name, column, other):
    """Bars to 1e-9: functionals that are alike to 1e-10 share their dual solutions with other runs on the same factor."""
    if "error" in name:
        np.testing.assert_allclose(column, other, rtol=1e-9, atol=0, err_msg=name)
    else:
        np.testing.assert_array_equal(column, other, err_msg=name)


def assert_same(table, alone):
    assert list(table) == list(alone)
    for name, column in alone.items():
        if not name.startswith("seconds"):
            assert_equal(name, table[name], column)


@pytest.fixture(scope="module", name="alone")
def by_no_executor():
    return mortise.sweep(SCENE, VARY, changes=COARSE)


def test_the_table_is_that_of_the_program(alone, tmp_path):
    vary = [f"--vary={key}={','.join(map(str, values))}" for key, values in VARY.items()]
    kernel = mortise.solve(SCENE, COARSE).summary["dense_kernel"].split()[-1]  # numpy's: the program chooses by itself
    subprocess.run([launch.MORTISE, "sweep", SCENE, *vary, "--set=mesh.parameters.n_block=20", "-o", tmp_path / "a.csv", "--quiet"],
                   env=os.environ | {"OPENBLAS_CORETYPE": kernel}, check=False)
    with open(tmp_path / "a.csv", newline="") as file:
        names, *rows = csv.reader(file)
    assert list(alone) == names and len(rows) == 256
    assert sum(status == "solved" for status in alone["status"]) == 3 * 63
    for k, name in enumerate(names):
        if name.startswith("seconds"):
            continue
        column = [row[k] for row in rows]
        if name == "status":
            assert list(alone["status"]) == column
        else:
            assert_equal(name, alone[name], [float(text) if text else np.nan for text in column])


def test_threads(alone):
    with futures.ThreadPoolExecutor(2) as threads:
        assert_same(mortise.sweep(SCENE, VARY, threads, COARSE), alone)


def test_processes(alone):
    with futures.ProcessPoolExecutor(2) as processes:
        assert_same(mortise.sweep(SCENE, VARY, processes, COARSE), alone)


def test_a_killed_process_leaves_no_row_out(alone):
    with futures.ProcessPoolExecutor(2) as processes:
        first = processes.submit(os.getpid).result()
        threading.Timer(0.2, os.kill, (first, signal.SIGKILL)).start()
        assert_same(mortise.sweep(SCENE, VARY, processes, COARSE), alone)
        with pytest.raises(futures.BrokenExecutor):
            processes.submit(os.getpid)


def test_a_run_that_ends_its_process_is_an_error(monkeypatch):
    monkeypatch.setattr(mortise, "_rows", lambda *_: os.kill(os.getpid(), signal.SIGKILL))  # in processes that are forked
    with futures.ProcessPoolExecutor(2) as processes, pytest.raises(futures.BrokenExecutor, match="ends each process"):
        mortise.sweep(SCENE, {"boundary.2.pressure": [1e6]}, processes)


def test_what_a_worker_raises_is_raised(monkeypatch):
    def fail(*_):
        raise MemoryError("of a worker")

    monkeypatch.setattr(mortise, "_rows", fail)
    with futures.ThreadPoolExecutor(2) as threads, pytest.raises(MemoryError, match="of a worker"):
        mortise.sweep(SCENE, {"boundary.2.pressure": [1e6]}, threads)


def test_a_dict_is_swept():
    """Its mesh is found by workers elsewhere."""
    tables = {
        "mesh": {"file": os.path.relpath(launch.ROOT / "geo/punch.geo")},
        "materials": {"steel": {"young": 210e9, "poisson": 0.3}},
        "bodies": {"block": "steel", "punch": "steel"},
        "boundary": [
            {"on": ["ground"], "displacement": {"x": 0, "y": 0}},
            {"on": ["head"], "displacement": {"x": 0}},
            {"on": ["head"], "pressure": 10e6},
        ],
        "contact": [{"between": ["foot", "block_top"]}],
    }
    with futures.ProcessPoolExecutor(1, initializer=os.chdir, initargs=("/",)) as elsewhere:
        table = mortise.sweep(tables, {"boundary.2.pressure": [10e6, 20e6]}, elsewhere, {"title": "two"})
    assert list(table["status"]) == ["solved", "solved"] and list(table["boundary.2.pressure"]) == [10e6, 20e6]
    np.testing.assert_allclose(table["contact.0.pressure.max"][1], 2 * table["contact.0.pressure.max"][0], rtol=1e-9)


def test_dask(alone, monkeypatch):
    """And a worker that is killed: dask does what it had again."""
    monkeypatch.setenv("PYTHONPATH", str(BUILT))
    distributed = pytest.importorskip("distributed", reason="python3-distributed is not installed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = client.run(os.getpid)
        threading.Timer(0.5, os.kill, (min(workers.values()), signal.SIGKILL)).start()
        assert_same(mortise.sweep(SCENE, VARY, client.get_executor(), COARSE), alone)
        assert client.run(os.getpid) != workers


def test_mpi(alone, monkeypatch, tmp_path):
    pytest.importorskip("mpi4py", reason="python3-mpi4py is not installed")
    if shutil.which("mpirun") is None:
        pytest.skip("mpirun is not installed")
    (tmp_path / "sweep.py").write_text(
        "import pickle\nimport mortise\nfrom mpi4py.futures import MPIPoolExecutor\n"
        "if __name__ == '__main__':\n"
        "    with MPIPoolExecutor() as ranks:\n"
        f"        table = mortise.sweep({str(SCENE)!r}, {VARY!r}, ranks, {COARSE!r})\n"
        "    pickle.dump(table, open('table', 'wb'))\n"
    )
    for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"):
        monkeypatch.setenv(name, "1")
    monkeypatch.setenv("PYTHONPATH", str(BUILT))
    mpirun = ["mpirun", "--oversubscribe", "-n", "3", sys.executable, "-m", "mpi4py.futures", "sweep.py"]
    done = subprocess.run(mpirun, cwd=tmp_path, capture_output=True, text=True, timeout=200, check=False)
    assert done.returncode == 0, done.stderr
    assert_same(pickle.loads((tmp_path / "table").read_bytes()), alone)
