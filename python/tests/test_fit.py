# SPDX-License-Identifier: BSD-3-Clause
"""Fits: data in every form, what is found, and the misfit for searches of others."""

from __future__ import annotations

import math
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
from conftest import SOURCE

import shearfront as sf

T, Z = np.array([0.2, 0.5, 1.0, 2.0]), np.linspace(0.05, 0.95, 10)
DATASETS = SOURCE / "datasets"


@pytest.fixture
def seen(may: sf.Scene) -> sf.Observations:
    return may.observe(T, Z, quantity="cumulative", noise=0.002, seed=3)


def test_exact_data_give_the_truth(may: sf.Scene) -> None:
    found = sf.fit(may, may.observe(T, Z, quantity="cumulative"), ["shear_rate.values"], start=[1, 1])
    np.testing.assert_allclose(found.estimates, [2.4, 0.31], rtol=1e-9)
    assert found.scene.entries["shear_rate.values[0]"] == found.estimates[0]
    assert found.names == ["shear_rate.values[0]", "shear_rate.values[1]"]


def test_data_in_every_form(may: sf.Scene, seen: sf.Observations, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    seen.save(tmp_path / "seen.csv")
    columns = seen.to_dict()
    assert list(columns) == ["t", "z", "M", "sigma"]
    M = seen.value.reshape(len(T), len(Z))
    forms = {
        "observations": seen,
        "file": tmp_path / "seen.csv",
        "name": str(tmp_path / "seen.csv"),
        "table": pandas.DataFrame({**columns, "remark": "x"}),
        "dict": columns,
        "broadcast": sf.data(may, t=T[:, None], z=Z, M=M, sigma=0.002),
    }
    found = {name: sf.fit(may, form, "shear_rate.values") for name, form in forms.items()}
    for name, fit in found.items():
        np.testing.assert_array_equal(fit.estimates, found["observations"].estimates, err_msg=name)


def test_data_are_checked_as_files_are(may: sf.Scene) -> None:
    with pytest.raises(sf.InputError) as caught:
        sf.data(may, t=[1, 1, -1], z=[0.5, 1.5, 0.5], phi=[0.5, 0.5, np.inf])
    assert [c.key for c in caught.value.complaints] == ["z[1]", "t[2]", "phi[2]"]
    with pytest.raises(sf.InputError, match="must differ"):
        sf.data(may, t=[1, 1], z=[0.5, 0.5], phi=[0.5, 0.6])
    assert len(sf.data(may, t=[1, 1], z=[0.5, 0.5], phi=[0.5, 0.6], replicates="keep")) == 2
    assert len(sf.data(may, t=[1, 2], z=[0.5, 0.5], phi=[0.5, np.nan])) == 1, "NaN is missing"
    with pytest.raises(sf.InputError, match="data = ndarray; must be a file"):
        sf.data(may, np.zeros((3, 3)))
    for wrong, match in (({"t": 1, "z": 0.5}, "must have t, z"), ({"t": 1, "z": 0, "phi": 0, "nope": 1}, "no column"),
                         ({"t": 1, "z": 0.5, "phi": 0.5, "sigma": 0}, r"sigma\[0\]")):  # fmt: skip
        with pytest.raises(sf.InputError, match=match):
            sf.data(may, **wrong)


def test_settings_are_checked_as_files_are(may: sf.Scene, seen: sf.Observations) -> None:
    with pytest.raises(sf.InputError) as caught:
        sf.fit(may, seen, ["shear_rate.valuse"], loss="hubre", algorithm="cerse", tolerance=2)
    keys = {c.key for c in caught.value.complaints}
    assert keys == {"unknown.parameters[0]", "misfit.loss", "search.algorithm", "search.tolerance"}
    with pytest.raises(TypeError, match="give it alone"):
        sf.fit(DATASETS / "paper-example-3" / "fit.toml", seen)
    with pytest.raises(TypeError, match="needs observations"):
        sf.fit(may, seen)
    with pytest.raises(sf.InputError, match="resolutio"):
        sf.fit(may, seen, "shear_rate.values", method="front-tracking", resolutio=0.1)


def test_keywords_are_the_same_as_a_file() -> None:
    folder = DATASETS / "paper-example-3"
    scene = sf.read(folder / "scene.toml")
    file = sf.fit(folder / "fit.toml")
    words = sf.fit(scene, folder / "observations.csv", "shear_rate.values", start=[2.5, 0.7], shape="decreasing")
    np.testing.assert_array_equal(file.estimates, words.estimates)
    np.testing.assert_array_equal(file.covariance, words.covariance)
    assert file.warnings == words.warnings


@pytest.mark.slow
def test_options_of_the_method() -> None:
    folder = DATASETS / "may-2010-diffusion"
    scene = sf.read(folder / "scene-1e-2.toml")
    words = sf.problem(
        scene, folder / "observations.csv", ["diffusion.D", "shear_rate.values"], start=[0.03, 1.5, 0.5],
        method="crank-nicolson", method_options={"tolerance": 1e-4},
    )  # fmt: skip
    assert words._engine.method.settings == sf.read_fit(folder / "fit.toml")._engine.method.settings
    np.testing.assert_array_equal(words.run().estimates, sf.fit(folder / "fit.toml").estimates)


def test_error_bars(may: sf.Scene, seen: sf.Observations) -> None:
    found = sf.fit(may, seen, "shear_rate.values")
    J = sf.problem(may, seen, "shear_rate.values").misfit.jacobian(found.estimates)
    np.testing.assert_allclose(found.correlation.diagonal(), 1)
    assert np.all(found.std_errors > 0)
    np.testing.assert_array_equal(found.covariance, found.covariance.T)
    # M as measured: independent rows with their sigma, so cov = (J^T J)^-1.
    np.testing.assert_allclose(np.linalg.inv(J.T @ J), found.covariance, rtol=1e-6)
    np.testing.assert_allclose(found.residuals, seen.value - found.scene.M(seen.z, seen.t), atol=1e-15)
    assert found.misfit == pytest.approx(np.sum((found.residuals / 0.002) ** 2) / 2, rel=1e-12)


def test_bands(may: sf.Scene, seen: sf.Observations) -> None:
    found = sf.fit(may, seen, "shear_rate.values")
    prediction = found.predict([0.4, 3], [0.2, 0.6], draws=200)
    assert prediction.M.shape == (2, 2)
    assert np.all((prediction.M_lower <= prediction.M) & (prediction.M_upper >= prediction.M))
    np.testing.assert_array_equal(prediction.M, found.scene.M([0.2, 0.6], [[0.4], [3]]))
    drawn = np.array([s.M(0.6, 3.0) for s in found.draw(200)])
    # By derivatives where a straight line holds; a quantile of 200 draws is known to a fifth of a standard error.
    error = (prediction.M_upper[1, 1] - prediction.M_lower[1, 1]) / (2 * 1.96)
    assert prediction.M_lower[1, 1] == pytest.approx(np.quantile(drawn, 0.025, method="weibull"), abs=0.6 * error)
    band = found.rate_band()
    low, high = found.parameters["shear_rate.values[1]"].ci95
    assert (band.lower[-1], band.upper[-1]) == (pytest.approx(low), pytest.approx(high))
    events = found.predict_events(draws=200)
    assert events["t_star"][0] < found.scene.events().t_star < events["t_star"][1]


def test_profile_and_bootstrap(may: sf.Scene) -> None:
    seen = may.observe(T, Z, quantity="cumulative", noise=1e-4)  # little noise: the misfit is a parabola
    found = sf.fit(may, seen, "shear_rate.values")
    profile = found.profile()
    once = found.bootstrap(60, seed=5, threads=1)
    again = found.bootstrap(60, seed=5, threads=2)
    np.testing.assert_array_equal(once.estimates, again.estimates)
    for name, parameter in found.parameters.items():
        low, high = profile[name]
        assert low < parameter.estimate < high
        assert (high - low) == pytest.approx(3.92 * parameter.std_error, rel=0.2)
    assert np.sqrt(once.covariance.diagonal()) == pytest.approx(found.std_errors, rel=0.4)


@pytest.mark.slow
def test_draws_for_arviz(may: sf.Scene) -> None:
    pytest.importorskip("arviz")
    seen = may.observe(T, Z, quantity="cumulative", noise=1e-4)
    replicates = sf.fit(may, seen, "shear_rate.values").bootstrap(40)
    posterior = replicates.to_arviz().posterior
    np.testing.assert_array_equal(posterior["shear_rate.values[1]"][0], replicates.estimates[:, 1])


@pytest.mark.parametrize("method", [None, "engquist-osher"])
def test_jacobian_of_the_misfit(may: sf.Scene, seen: sf.Observations, method: str | None) -> None:
    options = {"cells": 400} if method else {}
    misfit = sf.problem(may, seen, ["shear_rate.values"], method=method, **options).misfit
    p = np.array([2.0, 0.4])
    step = 1e-6 if method is None else 1e-2
    J = misfit.jacobian(p)
    for k in range(2):
        e = np.eye(2)[k] * step * p[k]
        numeric = (misfit.residuals(p + e) - misfit.residuals(p - e)) / (2 * step * p[k])
        np.testing.assert_allclose(J[:, k], numeric, atol=2e-4 * np.abs(J).max() if method is None else 0.05 * np.abs(J).max())
    assert misfit(p) == pytest.approx(np.sum(misfit.residuals(p) ** 2) / 2, rel=1e-12)


def test_other_searches(may: sf.Scene, seen: sf.Observations) -> None:
    optimize = pytest.importorskip("scipy.optimize")
    problem = sf.problem(may, seen, "shear_rate.values", start=[1, 1])
    misfit = problem.misfit
    found = optimize.least_squares(misfit.residuals, misfit.start, misfit.jacobian, bounds=misfit.bounds, x_scale="jac")
    np.testing.assert_allclose(found.x, problem.run().estimates, rtol=1e-5)
    again = pickle.loads(pickle.dumps(misfit))  # samplers send it to other processes
    np.testing.assert_array_equal(again.residuals([2, 0.3]), misfit.residuals([2, 0.3]))
    assert misfit.log_likelihood([-1, 1]) == -np.inf
    assert misfit([1, -1]) == np.inf
    with pytest.raises(sf.InputError, match="one number per unknown"):
        misfit.residuals([1])


@pytest.mark.parametrize("path", sorted(DATASETS.glob("*/fit.toml")), ids=lambda p: p.parent.name)
def test_problems_survive_a_pickle(path: Path) -> None:
    problem = sf.read_fit(path)
    again = pickle.loads(pickle.dumps(problem))
    assert again.scene == problem.scene
    for name in ("t", "z", "value", "width", "sigma"):
        np.testing.assert_array_equal(getattr(again.observations, name), getattr(problem.observations, name))
    assert again._engine.method.settings == problem._engine.method.settings
    assert again._engine.state == problem._engine.state
    if path.parent.name in ("paper-example-3", "segregation-gamma-0.9", "traffic-us-101"):
        np.testing.assert_array_equal(again.run().estimates, problem.run().estimates)


def same_to_the_bit(a: object, b: object) -> None:
    """Numbers, texts, NaN and arrays inside of lists, tuples and tables."""
    if isinstance(a, dict):
        assert list(a) == list(b)
        a, b = list(a.values()), list(b.values())
    if isinstance(a, (list, tuple)):
        assert len(a) == len(b)
        for x, y in zip(a, b, strict=True):
            same_to_the_bit(x, y)
    elif isinstance(a, np.ndarray):
        np.testing.assert_array_equal(a, b)
    else:
        assert type(a) is type(b)
        assert a == b or (a != a and b != b)


@pytest.mark.parametrize("name", ["paper-example-3", "paper-example-4-convex", "may-2010-bed-height", "segregation-gamma-0.9"])
def test_results_survive_a_pickle(name: str) -> None:
    found = sf.read_fit(DATASETS / name / "fit.toml").run()
    again = pickle.loads(pickle.dumps(found))
    same_to_the_bit(again.to_dict(), found.to_dict())
    same_to_the_bit(again.parameters, found.parameters)
    same_to_the_bit([again.predicted, again.residuals], [found.predicted, found.residuals])
    same_to_the_bit(again._engine.state, found._engine.state)
    assert again.scene == found.scene
    assert repr(again) == repr(found)
    t, z = found.problem.observations.t[:2], [found.scene.bottom, found.scene.top]
    options = [fit.predict(t, z, draws=20) for fit in (found, again)]
    same_to_the_bit(vars(options[0]), vars(options[1]))
    observations = pickle.loads(pickle.dumps(found.problem.observations))
    same_to_the_bit(observations._engine.state, found.problem.observations._engine.state)
    assert observations.to_csv() == found.problem.observations.to_csv()


def test_fits_come_back_from_other_processes(may: sf.Scene, seen: sf.Observations) -> None:
    problem = sf.problem(may, seen, "shear_rate.values", profile=True, bootstrap=40)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        there = pool.submit(sf.Problem.run, problem).result()
    here = problem.run()
    same_to_the_bit({**there.to_dict(), "wall_s": 0}, {**here.to_dict(), "wall_s": 0})
    same_to_the_bit(there.bootstrap(40).estimates, here.bootstrap(40).estimates)


def test_models_are_compared(may: sf.Scene, seen: sf.Observations) -> None:
    two = sf.fit(may, seen, "shear_rate.values")
    one = sf.fit(may.with_(shear_rate=sf.Piecewise([], [1])), seen, "shear_rate.values")
    table = sf.compare_fits({"one": one, "two": two})
    assert table["model"].tolist() == ["two", "one"]
    assert table["daic"][0] == 0
    assert table["aic_weight"].sum() == pytest.approx(1)
    other = sf.fit(may, may.observe(T, Z, quantity="cumulative"), "shear_rate.values")
    with pytest.raises(sf.InputError, match="cannot be compared"):
        sf.compare_fits({"two": two, "other": other})


LAB = {
    "spreadsheet": ("spreadsheet.csv", {"columns": {"t": "Zeit", "z": "Höhe", "width": "Breite", "phi": "Konzentration klein"}}),
    "wide": ("wide.txt", {"width": 2}),
    "percent": ("percent.csv", {"columns": {"phi_large": "large"}, "replicates": "mean", "width": 2}),
    "chunks": ("chunks.txt", {"columns": {"phi": "v_small"}, "time_step": 0.001, "width": 2}),
}


@pytest.mark.parametrize("name", LAB)
def test_files_of_laboratories(name: str) -> None:
    """The same as the fit file beside it, whose tables say the same."""
    file, how = LAB[name]
    folder = DATASETS / "lab-files"
    scene = sf.read(folder / "scene.toml")
    seen = sf.read_data(scene, folder / file, **how)
    expected = sf.read_fit(folder / f"fit-{name}.toml").observations
    assert seen.to_csv() == expected.to_csv()
    assert file in seen.understood


def test_how_a_file_is_read_is_checked(may: sf.Scene) -> None:
    for wrong in (
        {"columns": {"time": "Zeit"}}, {"separator": "tabs"}, {"layout": "deep"}, {"width": -1.0}, {"replicates": "sum"},
    ):  # fmt: skip
        with pytest.raises(sf.InputError, match=next(iter(wrong))):
            sf.read_data(may, "nowhere.csv", **wrong)
    with pytest.raises(sf.InputError, match="not both"):
        sf.data(may, "nowhere.csv", t=1)


def misfit_fit() -> sf.Fit:
    bed = sf.Scene(shear_rate=sf.Piecewise([0.6], [1.4, 0.6]), initial=sf.Step(0.5))
    seen = bed.observe(T, Z, quantity="cumulative", noise=0.002, seed=5)
    return sf.fit(bed, seen, ["shear_rate.values", "shear_rate.breaks"])


def test_profile_curves_end_where_the_intervals_of_the_fit_do() -> None:
    pytest.importorskip("scipy")
    found = misfit_fit()
    intervals = found.profile()
    for name in found.names:
        curve = found.profile_curve(name, points=61, reach=3.5)
        x, above = curve.grid[0], curve.increase - curve.level
        ends = [
            x[i] - above[i] * (x[i + 1] - x[i]) / (above[i + 1] - above[i]) for i in range(60) if above[i] * above[i + 1] <= 0
        ]
        interval = intervals[name]
        assert interval is not None
        # Between two of the places the curve is a parabola: the chord is off by an eighth of the square of their distance.
        assert ends == pytest.approx(list(interval), abs=0.01 * (interval[1] - interval[0]))


def test_profile_surfaces_are_least_where_curves_are() -> None:
    pytest.importorskip("scipy")
    found = misfit_fit()
    name, other = "shear_rate.values[0]", "shear_rate.breaks[0]"
    surface = found.profile_surface(name, other, points=25)
    curve = found.profile_curve(name, points=25)
    assert surface.grid[0] == pytest.approx(curve.grid[0])
    # The least of a row is at most half a step from the least of all: above it by an eighth of the second difference, if that is
    # a parabola.
    inner = 0
    for row, least in zip(surface.increase, curve.increase, strict=True):
        i = int(np.argmin(row))
        if not 0 < i < len(row) - 1:
            continue
        inner += 1
        assert least - 1e-6 <= row[i] <= least + 1.2 * (row[i - 1] - 2 * row[i] + row[i + 1]) / 8
    assert inner > 5
    assert surface.level == pytest.approx(-math.log(0.05))
    assert curve.evaluations <= 4 * 25


def test_profile_refuses_names_and_losses() -> None:
    pytest.importorskip("scipy")
    found = misfit_fit()
    with pytest.raises(sf.InputError, match="must be one of: shear_rate"):
        found.profile_curve("shear_rate.depth")
    with pytest.raises(sf.InputError, match="must be another unknown"):
        found.profile_surface(found.names[0], found.names[0])
