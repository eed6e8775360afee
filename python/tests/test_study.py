# SPDX-License-Identifier: BSD-3-Clause
"""Studies: the same to the bit whoever runs them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import shearfront as sf

GRID = {"shear_rate.values[0]": [2.0, 2.4, 2.8], "shear_rate.values[1]": np.linspace(0.2, 0.6, 7)}
OUTPUTS = ["t_star", "t_c(1)", "phi(0.5;0.4)", "M(1;0.3)", "mixing(1)", "height(1)"]


def same(a: sf.Study, b: sf.Study) -> None:
    for table, other in ((a.entries, b.entries), (a.outputs, b.outputs)):
        assert list(table) == list(other)
        for name in table:
            assert table[name].tobytes() == other[name].tobytes(), name
    assert a.failures == b.failures


def double_mass(scene: sf.Scene) -> dict[str, float]:
    return {"twice": 2 * scene.mass}


def half_of(fit: sf.Fit) -> dict[str, float]:
    return {"half": float(fit.estimates[0]) / 2}


def test_numbers_of_a_study(may: sf.Scene) -> None:
    found = sf.study(may, GRID, OUTPUTS)
    assert len(found) == 21
    assert list(found.outputs) == OUTPUTS
    for i in (0, 8, 20):
        scene = may.with_({name: found[name][i] for name in GRID})
        events = scene.events()
        assert found["t_star"][i] == events.t_star
        assert found["t_c(1)"][i] == events.t_c
        assert found["phi(0.5;0.4)"][i] == scene.phi(0.4, 0.5)
        assert found["M(1;0.3)"][i] == scene.M(0.3, 1.0)
        assert found["mixing(1)"][i] == scene.bed([1])["mixing"][0]
        assert found["height(1)"][i] == scene.bed([1])["height"][0]


def test_executors_change_nothing(may: sf.Scene) -> None:
    here = sf.study(may, GRID, OUTPUTS)
    with ThreadPoolExecutor(3) as pool:
        same(sf.study(may, GRID, OUTPUTS, executor=pool, batch=2), here)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        same(sf.study(may, GRID, OUTPUTS, executor=pool, batch=4), here)
        same(sf.study(may, GRID, OUTPUTS, executor=pool), here)
        same(sf.study(may, GRID, double_mass, executor=pool, batch=5), sf.study(may, GRID, double_mass))


def test_studies_of_fits(may: sf.Scene) -> None:
    seen = may.observe([0.5, 1, 2], [0.2, 0.4, 0.6], quantity="cumulative", noise=0.001)
    problem = sf.problem(may, seen, "shear_rate.values", start=[1, 1])
    points = {"initial.breaks[0]": [0.48, 0.5, 0.52]}
    here = sf.study(problem, points)
    assert list(here.outputs) == ["shear_rate.values[0]", "shear_rate.values[1]", "misfit"]
    assert here["misfit"].argmin() == 1, "the height the data were made with"
    np.testing.assert_array_equal(here["shear_rate.values[1]"][1], problem.run().estimates[1])
    same(sf.study(problem.run(), points), here)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        same(sf.study(problem, points, executor=pool, batch=1), here)
    assert list(sf.study(problem, points, half_of).outputs) == ["half"]


def test_failures_are_told(may: sf.Scene) -> None:
    found = sf.study(may, {"initial.breaks[0]": [0.5, 2.0, 0.6]})
    assert list(found.failures) == [1]
    assert "inside the domain" in found.failures[1]
    assert np.isnan(found["t_star"]).tolist() == [False, True, False]
    with pytest.raises(sf.InputError, match="no entry"):
        sf.study(may, {"shear_rate.valuse[0]": [1]})
    with pytest.raises(sf.InputError, match="must be one of"):
        sf.study(may, GRID, ["t_start"])


def test_points_as_tables(may: sf.Scene) -> None:
    pandas = pytest.importorskip("pandas")
    rows = [{"shear_rate.values[0]": 2.0, "initial.breaks[0]": 0.4}, {"shear_rate.values[0]": 3.0, "initial.breaks[0]": 0.6}]
    same(sf.study(may, pandas.DataFrame(rows)), sf.study(may, rows))
    assert sf.study(may, rows).to_dataframe()["failure"].tolist() == ["", ""]
    with pytest.raises(sf.InputError, match="the same entries"):
        sf.study(may, [rows[0], {"initial.breaks[0]": 0.6}])


@pytest.mark.slow
def test_dask_workers(may: sf.Scene) -> None:
    distributed = pytest.importorskip("distributed")
    here = sf.study(may, GRID, OUTPUTS)
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        same(sf.study(may, GRID, OUTPUTS, executor=client.get_executor(), batch=4), here)


MPI = """
import sys, pickle
from mpi4py.futures import MPIPoolExecutor
import shearfront as sf
if __name__ == "__main__":
    scene, grid, outputs, path = pickle.load(sys.stdin.buffer)
    with MPIPoolExecutor() as pool:
        found = sf.study(scene, grid, outputs, executor=pool, batch=4)
    pickle.dump(found, open(path, "wb"))
"""


@pytest.mark.slow
def test_mpi_ranks(may: sf.Scene, tmp_path: Path) -> None:
    import pickle

    pytest.importorskip("mpi4py.MPI", exc_type=ImportError)  # it is there but finds another MPI's library
    mpiexec = shutil.which("mpiexec")
    if not mpiexec:
        pytest.skip("no mpiexec")
    (tmp_path / "study.py").write_text(MPI)
    root = ["--allow-run-as-root", "--oversubscribe"] if os.geteuid() == 0 and "Open" in _version(mpiexec) else []
    subprocess.run(
        [mpiexec, *root, "-n", "2", sys.executable, "-m", "mpi4py.futures", str(tmp_path / "study.py")],
        input=pickle.dumps((may, GRID, OUTPUTS, str(tmp_path / "found"))), check=True, timeout=120,
    )  # fmt: skip
    same(pickle.loads((tmp_path / "found").read_bytes()), sf.study(may, GRID, OUTPUTS))


def _version(mpiexec: str) -> str:
    return subprocess.run([mpiexec, "--version"], capture_output=True, text=True, check=False).stdout
