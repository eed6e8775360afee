# SPDX-License-Identifier: BSD-3-Clause
"""The direct problem: shapes, broadcasting, laws, other methods, threads."""

from __future__ import annotations

import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import shearfront as sf

ONE = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))


def fan(z: np.ndarray, t: np.ndarray) -> np.ndarray:
    """phi of one layer before the first wave comes to an end: (1 + (z - 1/2) / t) / 2 inside the fan |z - 1/2| < t < 1/2."""
    return np.clip((1 + (z - 0.5) / t) / 2, 0, 1)


@settings(max_examples=50)
@given(z=st.lists(st.floats(0, 1), min_size=1, max_size=8), t=st.lists(st.floats(0.01, 0.49), min_size=1, max_size=5))
def test_a_fan(z: list[float], t: list[float]) -> None:
    zs, ts = np.array(z), np.array(t)[:, None]
    found = ONE.phi(zs, ts)
    assert found.shape == (len(t), len(z))
    np.testing.assert_allclose(found, fan(zs, ts), atol=2e-14)
    np.testing.assert_array_equal(ONE.solve(t, z).phi, found)


SHAPES = [((), ()), ((3,), ()), ((), (3,)), ((4, 1), (3,)), ((3,), (4, 1)), ((2, 3), (2, 3)), ((2, 1, 3), (4, 1)), ((0,), ())]


@pytest.mark.parametrize(("z_shape", "t_shape"), SHAPES)
def test_broadcasting_as_a_ufunc(may: sf.Scene, z_shape: tuple[int, ...], t_shape: tuple[int, ...]) -> None:
    random = np.random.default_rng(1)
    z, t = random.uniform(0, 1, z_shape), random.uniform(0, 6, t_shape)
    for function in (may.phi, may.M):
        one_by_one = np.vectorize(lambda z, t, f=function: f(float(z), float(t)), otypes=[float])
        found = function(z, t)
        assert np.shape(found) == np.broadcast_shapes(z_shape, t_shape)
        np.testing.assert_array_equal(found, one_by_one(z, t))


def test_results_are_not_copied(may: sf.Scene) -> None:
    solution = may.solve([0.5, 1, 2], np.linspace(0, 1, 11))
    assert solution.phi.base is not None
    assert solution.phi.strides == (11 * 16, 16), "phi and M of the same samples"
    assert solution.M.ctypes.data - solution.phi.ctypes.data == 8
    phi = solution.phi
    del solution
    assert phi[0, 0] == may.phi(0.0, 0.5)


def test_mass_is_kept_and_M_is_the_integral(may: sf.Scene) -> None:
    z = np.linspace(0, 1, 20001)
    solution = may.solve([0, 0.3, 1, 4, "steady"], z)
    np.testing.assert_allclose(solution.M[:, -1], 0.5, rtol=1e-14)
    trapezoids = np.cumsum((solution.phi[:, 1:] + solution.phi[:, :-1]) / 2, axis=1) * (z[1] - z[0])
    np.testing.assert_allclose(solution.M[:, 1:], trapezoids, atol=2e-4)
    assert solution.t[-1] == may.events().t_star


def test_jacobian_against_differences(may: sf.Scene) -> None:
    z, t = np.array([0.2, 0.45, 0.6, 0.8]), np.array([[0.3], [1.1]])
    jacobian = may.jacobian(z, t, ["shear_rate.values", "initial.breaks[0]"])
    assert jacobian.names == ["shear_rate.values[0]", "shear_rate.values[1]", "initial.breaks[0]"]
    assert jacobian.dphi.shape == (2, 4, 3)
    for name in jacobian.names:
        value, step = may.entries[name], 1e-6
        up, down = may.with_({name: value + step}), may.with_({name: value - step})
        np.testing.assert_allclose(jacobian.of_M(name), (up.M(z, t) - down.M(z, t)) / (2 * step), atol=1e-8)
        np.testing.assert_allclose(jacobian[name], (up.phi(z, t) - down.phi(z, t)) / (2 * step), atol=1e-5)
    with pytest.raises(sf.InputError, match="no entry"):
        may.jacobian(z, t, "shear_rate.valuse")
    with pytest.raises(KeyError, match="none of the entries"):
        jacobian["nope"]


def test_events_by_closed_form(may: sf.Scene) -> None:
    events = may.events()
    assert events.t_c == pytest.approx((0.5 - 0.29) / 0.31, rel=1e-14)
    assert events.t0 == pytest.approx((0.5 - 0.29) / 0.31 + 0.29 / 2.4, rel=1e-14)
    assert events.t1 == pytest.approx(0.5 / 0.31, rel=1e-14)
    with pytest.raises(sf.InputError, match="method"):
        may.events(method="engquist-osher")


@pytest.mark.parametrize("method", ["front-tracking", "engquist-osher", "godunov", "muscl", "classical-godunov"])
def test_other_methods_come_near(may: sf.Scene, method: str) -> None:
    z = np.linspace(0, 1, 41)
    difference = may.M(z, 0.5, method=method) - may.M(z, 0.5)
    assert 0 < np.abs(difference).max() < 2e-2


def test_errors_fall_with_the_resolution(may: sf.Scene) -> None:
    table = may.compare([0.5], ["front-tracking", "engquist-osher"], cells=[50, 200], resolutions=[0.1, 0.01])
    assert table.dtype.names == ("method", "resolution", "t", "l1_error", "wall_s", "work")
    for name in ("front-tracking", "engquist-osher"):
        coarse, fine = table["l1_error"][table["method"] == name]
        assert 0 < fine < coarse / 2


def test_tracking_step_by_step(may: sf.Scene) -> None:
    bed = may.track(0.05)
    early = bed.copy()
    seen = 0
    for collisions in bed.steps(until=1.0):
        assert np.all(collisions["t"] == bed.time)
        seen += len(collisions)
    assert bed.time == 1.0
    assert early.time == 0.0
    assert seen == len(bed.collisions()) >= 5
    direct = may.track(0.05)
    direct.advance(1.0)
    np.testing.assert_array_equal(direct.profile().below, bed.profile().below)
    np.testing.assert_array_equal(direct.fronts(), bed.fronts())
    fronts = bed.fronts()
    assert np.all(fronts["t_end"] >= fronts["t_begin"])
    assert np.all((fronts["phi_below"] >= 0) & (fronts["phi_above"] <= 1))
    profile = bed.profile()
    assert np.sum(np.diff(profile.z) * (profile.below + profile.above) / 2) == pytest.approx(0.5, rel=1e-13)
    np.testing.assert_allclose(bed.M(1.0), 0.5, rtol=1e-13)
    phi, z = profile.line()
    assert phi.shape == z.shape
    with pytest.raises(sf.InputError, match="before the time reached"):
        bed.advance(0.5)


def test_unlike_inputs_are_refused(may: sf.Scene) -> None:
    for arguments, options in (
        (([-1], [0.5]), {}), (([1], [1.5]), {}), (([np.nan], [0.5]), {}), (([1], [0.5]), {"method": "nope"}),
        (([1], [0.5]), {"method": "muscl", "cells": 0}), (([1], [0.5]), {"method": "muscl", "resolution": 0.1}),
    ):  # fmt: skip
        with pytest.raises(sf.InputError):
            may.solve(*arguments, **options)
    with pytest.raises(sf.InputError, match="cells"):
        may.solve([1], [0.5], method="muscl", resolution=0.1)
    with pytest.raises(sf.NoResult) as caught:
        may.solve([1], [0.5], method="crank-nicolson")
    assert caught.value.status == "unsupported"
    with pytest.raises(ValueError, match="steady"):
        may.solve("stead")


@pytest.mark.parametrize(("z", "t"), [(1.5, 0.5), (-0.1, 0.5), (0.5, -1.0), (np.nan, 1.0), (0.5, np.nan)])
def test_places_outside_are_refused(may: sf.Scene, z: float, t: float) -> None:
    key = "z" if t == abs(t) and not 0 <= z <= 1 else "t"
    for call in (may.phi, may.M, may.jacobian):
        for places in ((z, t), ([z], [t]), ([0.5, z], [1.0, t]), ([[0.5], [z]], [1.0, t])):
            with pytest.raises(sf.InputError, match=rf"^({key}|times|heights|depths)\b"):
                call(*places)
    if key == "z":
        with pytest.raises(sf.InputError, match="inside the domain"):
            may.track(0.1).phi([0.5, z])


def test_bed(may: sf.Scene) -> None:
    bed = may.bed([0, 0.7, "steady"])
    np.testing.assert_allclose(bed["mixing"][[0, 2]], 0, atol=1e-12)
    assert 0.3 < bed["mixing"][1] < 1
    assert bed["height"][1] < bed["height"][0] == pytest.approx(1)


def test_threads_share_a_scene(may: sf.Scene) -> None:
    z = np.linspace(0, 1, 101)
    times = np.linspace(0.1, 6, 40)
    alone = [may.phi(z, float(t)) for t in times]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda t: may.phi(z, float(t)), times))
    np.testing.assert_array_equal(alone, together)


def test_arrays_cost_what_the_engine_costs(may: sf.Scene) -> None:
    """The engine's own time is in the summary; the least of many ratios is that of a run nobody disturbed."""
    t, z = np.linspace(0, 6, 1000), np.linspace(0, 1, 100)
    ratios = []
    for _ in range(15):
        begin = time.perf_counter()
        wall = may.solve(t, z).summary["wall_s"]
        ratios.append((time.perf_counter() - begin) / wall)
    assert min(ratios) <= 1.1


def test_a_point_costs_little_more_than_the_engine_takes(may: sf.Scene) -> None:
    n, engine, total = 100, np.inf, np.inf
    for _ in range(200):  # short ones: some are not disturbed
        begin = time.perf_counter()
        for _ in range(n):
            may.phi(0.4, 0.5)
        total = min(total, (time.perf_counter() - begin) / n)
        engine = min(engine, min(may.solve(0.5, 0.4).summary["wall_s"] for _ in range(5)))
    assert total - engine <= 3e-6


def test_the_lock_is_let_go(may: sf.Scene) -> None:
    ticks = 0
    worker = threading.Thread(target=lambda: may.solve([6.0], [0.5], method="engquist-osher", cells=6000))
    worker.start()
    while worker.is_alive():
        ticks += 1
        time.sleep(0.001)
    assert ticks > 5, "this thread ran beside the other"


def test_ctrl_c_ends_a_run(may: sf.Scene) -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores it for what it runs behind
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        may.solve([1e9], [0.5], method="engquist-osher", cells=20000)
    signal.signal(signal.SIGINT, before)
    assert time.perf_counter() - begin < 5


def test_methods_list_their_options() -> None:
    table = sf.methods()
    assert table["exact"]["exact"]
    assert set(table["front-tracking"]["options"]) >= {"resolution", "grid", "max_collisions"}


def test_tables(may: sf.Scene) -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    solution = may.with_(units={"z": "mm", "t": "s"}).solve([0.5, 1], [0.2, 0.4, 0.8])
    table = solution.to_dataframe()
    assert list(table.itertuples(index=False))[4] == (1.0, 0.4, solution.phi[1, 1], solution.M[1, 1])
    labelled = solution.to_xarray()
    assert labelled.phi.sel(t=1, z=0.4).item() == solution.phi[1, 1]
    assert labelled.z.attrs["units"] == "mm"


def test_what_holds_arrays_shows_their_sizes_only() -> None:
    scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    solution = scene.solve([0.5, 1], np.linspace(0, 1, 1001))
    assert repr(solution) == "<Solution by exact: phi and M at 2 times and 1001 heights>"
    jacobian = scene.jacobian([0.3, 0.6], 1)
    assert repr(jacobian).startswith("<Jacobian of shape (2,) by shear_rate.breaks[0], ")
    assert repr(scene.track(0.5).profile()) == "<Profile of 4 cells from z = 0 to 1>"
    study = sf.study(scene, {"initial.breaks[0]": [0.4, 0.5]})
    assert repr(study) == "<Study of 2 runs, 0 of them failed: initial.breaks[0], t_star>"
