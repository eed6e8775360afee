# SPDX-License-Identifier: BSD-3-Clause
"""Posteriors: coordinates and gradients against differences, samples against quadrature."""

from __future__ import annotations

import math
import multiprocessing
import pickle
import socket
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import shearfront as sf
from shearfront._unbounded import Unbounded

BED = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
TIMES = [0.2, 0.5, 1, 2, 3]
EDGES = np.linspace(0.1, 0.9, 9)


def seen(noise: float = 0.02, seed: int = 1, quantity: str = "cumulative") -> sf.Observations:
    return BED.observe(TIMES, EDGES, quantity=quantity, noise=noise, seed=seed)


def without_sigma(observations: sf.Observations) -> sf.Observations:
    columns = {"t": observations.t, "z": observations.z, "M": observations.value}
    return sf.data(BED, columns)


COORDINATES = {
    "wide positive": Unbounded(["a", "b"], np.array([1e-3, 1e-2]), np.array([1e3, 1e2]), "none"),
    "narrow": Unbounded(["a", "b"], np.array([-1.0, 0.2]), np.array([1.0, 0.4]), "none"),
    "one end": Unbounded(["a", "b"], np.array([0.5, -math.inf]), np.array([math.inf, 2.0]), "none"),
    "no end": Unbounded(["a", "b"], np.array([-math.inf] * 2), np.array([math.inf] * 2), "none"),
    "breaks": Unbounded(["shear_rate.breaks[0]", "shear_rate.breaks[1]"], np.array([0.0, 0.0]), np.array([1.0, 1.0]), "none"),
    "decreasing": Unbounded([f"shear_rate.values[{i}]" for i in range(3)], np.full(3, 0.01), np.full(3, 10.0), "decreasing"),
    "convex": Unbounded([f"shear_rate.values[{i}]" for i in range(4)], np.full(4, 0.01), np.full(4, 1e3), "convex"),
}


@pytest.mark.parametrize("kind", COORDINATES)
@settings(max_examples=30, deadline=None)
@given(st.data())
def test_coordinates_against_differences(kind: str, data: Any) -> None:
    to = COORDINATES[kind]
    x = np.array(data.draw(st.lists(st.floats(-2, 2), min_size=len(to), max_size=len(to))))
    if kind == "convex":
        x -= 5  # room above
    at = to.at(x)
    assert at is not None
    assert at.log_volume == pytest.approx(np.linalg.slogdet(at.derivative)[1], abs=1e-10)
    for j in range(len(x)):
        h = 1e-6 * np.eye(len(x))[j]
        above, below = to.at(x + h), to.at(x - h)
        assert above is not None
        assert below is not None
        assert at.derivative[:, j] == pytest.approx((above.p - below.p) / 2e-6, rel=1e-6, abs=1e-7)
        assert at.slope[j] == pytest.approx((above.log_volume - below.log_volume) / 2e-6, rel=1e-5, abs=1e-6)
    assert to.coordinates(at.p) == pytest.approx(x, abs=1e-7)
    p = at.p
    if kind == "breaks":
        assert p[0] < p[1]
    if kind in ("decreasing", "convex"):
        assert np.all(np.diff(p) < 0)
    if kind == "convex":
        assert np.all(np.diff(p, 2) > 0)


@pytest.mark.parametrize("has_sigma", [True, False])
def test_gradient_against_differences(has_sigma: bool) -> None:
    observations = seen() if has_sigma else without_sigma(seen())
    priors = {"shear_rate.values": sf.LogNormal(1.0, 2.0), "initial.breaks[0]": sf.Normal(0.5, 0.02)}
    problem = sf.problem(BED, observations, ["shear_rate.values", "initial.breaks"])
    posterior = problem.posterior(priors)
    x = posterior.coordinates([2.3, 0.32, 0.51])
    value, gradient = posterior.unbounded(x)
    p = posterior.values(x)
    assert value == pytest.approx(posterior.log_density(p) + posterior._unbounded.at(x).log_volume, rel=1e-12)
    for j in range(3):
        h = 1e-6 * np.eye(3)[j]
        difference = (posterior.unbounded(x + h)[0] - posterior.unbounded(x - h)[0]) / 2e-6
        assert gradient[j] == pytest.approx(difference, rel=1e-4, abs=1e-3)
        assert posterior.gradient(p)[j] == pytest.approx(
            (posterior.log_density(p + h) - posterior.log_density(p - h)) / 2e-6, rel=1e-4, abs=1e-3
        )


def test_what_a_posterior_says_of_itself() -> None:
    posterior = sf.problem(BED, seen(), "shear_rate.values").posterior({"shear_rate.values[1]": sf.Uniform(0.2, 0.4)})
    assert posterior.log_density([2.4, 0.5]) == -math.inf
    assert posterior.log_density([2.4, 0.3]) > -math.inf
    assert posterior.priors["shear_rate.values[0]"] == sf.Uniform()
    again = pickle.loads(pickle.dumps(posterior))
    assert again.log_density([2.4, 0.3]) == posterior.log_density([2.4, 0.3])
    with pytest.raises(sf.InputError, match="must be an unknown of the fit"):
        sf.problem(BED, seen(), "shear_rate.values").posterior({"shear_rate.scale": sf.Normal(1, 1)})
    with pytest.raises(sf.InputError, match="must leave room"):
        sf.problem(BED, seen(), "shear_rate.values").posterior({"shear_rate.values": sf.Uniform(1e9, 2e9)})
    with pytest.raises(sf.InputError, match="points next to shocks"):
        sf.problem(BED, seen(quantity="point"), "shear_rate.values").posterior().sample()


def moments_by_quadrature(posterior: Any, centre: Any, errors: Any) -> tuple[Any, Any, Any]:
    """Of the logarithms: mean, standard deviation and kurtosis over a grid of eight standard errors to each side."""
    axes = [c * np.exp(np.linspace(-8 * e / c, 8 * e / c, 81)) for c, e in zip(centre, errors, strict=True)]
    log_density = np.array([[posterior.log_density([a, b]) + math.log(a * b) for b in axes[1]] for a in axes[0]])
    edge = max(log_density[:, [0, -1]].max(), log_density[[0, -1]].max())
    assert edge < log_density.max() - 12  # nothing is cut off
    weight = np.exp(log_density - log_density.max())
    weight /= weight.sum()
    grid = np.meshgrid(*np.log(axes), indexing="ij")
    mean = np.array([(weight * g).sum() for g in grid])
    variance = np.array([(weight * (g - m) ** 2).sum() for g, m in zip(grid, mean, strict=True)])
    fourth = np.array([(weight * (g - m) ** 4).sum() for g, m in zip(grid, mean, strict=True)])
    return mean, np.sqrt(variance), fourth / variance**2


@pytest.mark.parametrize("sampler", ["nutpie", "emcee"])
def test_samples_against_quadrature(sampler: str) -> None:
    pytest.importorskip(sampler)
    pytest.importorskip("arviz")
    found = sf.fit(BED, seen(0.005), "shear_rate.values")
    posterior = found.posterior({"shear_rate.values": sf.LogNormal(1.0, 1.0)})
    mean, std, kurtosis = moments_by_quadrature(posterior, found.estimates, found.std_errors)
    samples = posterior.sample(600, 2, 300, sampler=sampler, seed=3)
    draws = np.log(samples.posterior["shear_rate.values"].values.reshape(-1, 2))
    # Some 300 independent draws at the least: five standard errors of theirs.
    assert np.abs(draws.mean(axis=0) - mean) / std == pytest.approx([0, 0], abs=5 / math.sqrt(300))
    assert (np.abs(draws.std(axis=0) / std - 1) < 5 * np.sqrt((kurtosis - 1) / (4 * 300))).all()


def test_sigma_is_drawn_where_it_is_not_given() -> None:
    pytest.importorskip("nutpie")
    pytest.importorskip("arviz")
    posterior = sf.problem(BED, without_sigma(seen(0.02)), "shear_rate.values").posterior()
    samples = posterior.sample(300, 2, 200)
    sigma = samples.posterior["sigma"].values
    assert sigma.shape == (2, 300)
    # 45 residuals know it to a tenth.
    assert sigma.mean() == pytest.approx(0.02, rel=0.35)
    assert samples.log_likelihood["residuals"].shape == (2, 300, 45)


def test_petab_has_the_measurements_and_the_unknowns(tmp_path: Path) -> None:
    observations = BED.observe(TIMES, [0.2, 0.4, 0.6], quantity="bin", width=0.1, noise=0.02, seed=3)
    problem = sf.problem(BED, observations, ["shear_rate.values", "shear_rate.breaks"])
    tables = sf.petab(
        problem, tmp_path / "out", {"shear_rate.values": sf.LogNormal(2.0, 0.5), "shear_rate.breaks": sf.Normal(0.3, 0.1)}
    )
    rows = {
        name: [dict(zip(lines[0].split("\t"), line.split("\t"), strict=True)) for line in lines[1:]]
        for name in tables
        for lines in [(tmp_path / "out" / name).read_text().splitlines()]
    }
    seen = rows["measurements.tsv"]
    assert [float(row["measurement"]) for row in seen] == observations.value.tolist()
    assert [float(row["time"]) for row in seen] == observations.t.tolist()
    assert {row["observableId"]: float(row["z"]) for row in seen} == {"phi_1": 0.2, "phi_2": 0.4, "phi_3": 0.6}
    assert {row["noiseParameters"] for row in seen} == {"0.02"}
    unknowns = {row["parameterName"]: row for row in rows["parameters.tsv"]}
    assert list(unknowns) == problem.misfit.names
    rate, height = unknowns["shear_rate.values[0]"], unknowns["shear_rate.breaks[0]"]
    assert (rate["parameterId"], rate["parameterScale"]) == ("shear_rate_values_0", "log10")
    assert rate["objectivePriorType"] == "logNormal"
    assert rate["objectivePriorParameters"] == f"{math.log(2.0)!r};0.5"
    assert (height["parameterScale"], height["objectivePriorType"], height["objectivePriorParameters"]) == (
        "lin",
        "normal",
        "0.3;0.1",
    )
    assert float(rate["nominalValue"]) == problem.misfit.start[problem.misfit.names.index("shear_rate.values[0]")]


def test_petab_refuses_what_it_has_no_name_for(tmp_path: Path) -> None:
    problem = sf.problem(BED, seen(), "shear_rate.values")
    with pytest.raises(sf.InputError, match="PEtab has no name"):
        sf.petab(problem, tmp_path / "none", {"shear_rate.values": sf.HalfNormal(1.0)})
    assert not (tmp_path / "none").exists()


def test_umbridge_client_gets_what_the_fit_has() -> None:
    bridge = pytest.importorskip("umbridge")
    problem = sf.problem(BED, seen(), "shear_rate.values")
    port = free_port()
    server = multiprocessing.get_context("spawn").Process(target=serve, args=(problem, port), daemon=True)
    server.start()
    try:
        url = f"http://localhost:{port}"
        for _ in range(200):
            try:
                client = bridge.HTTPModel(url, "forward")
                break
            except Exception:
                time.sleep(0.1)
        p, misfit = [2.3, 0.33], problem.misfit
        assert client.get_input_sizes() == [2]
        assert client([p])[0] == pytest.approx(misfit.residuals(p), rel=1e-15)
        assert client.apply_jacobian(0, 0, [p], [1.0, 0.0]) == pytest.approx(misfit.jacobian(p)[:, 0], rel=1e-15)
        density = bridge.HTTPModel(url, "posterior")
        posterior = problem.posterior()
        assert density([p])[0][0] == posterior.log_density(p)
        assert density.gradient(0, 0, [p], [1.0]) == pytest.approx(posterior.gradient(p), rel=1e-15)
    finally:
        server.kill()
        server.join()


def serve(problem: sf.Problem, port: int) -> None:
    import umbridge

    umbridge.serve_models(sf.umbridge(problem), port)


def free_port() -> int:
    with socket.socket() as free:
        free.bind(("localhost", 0))
        return int(free.getsockname()[1])


def test_scene_of_a_fit_file_is_changed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from shearfront.sample import main

    BED.save(tmp_path / "scene.toml")
    seen().save(tmp_path / "seen.csv")
    path = tmp_path / "fit.toml"
    path.write_text("scene = 'scene.toml'\nobservations = 'seen.csv'\n[unknown]\nparameters = ['shear_rate.values[0]']\n")
    entry = "shear_rate.values[1]"
    assert sf.read_fit(path, {entry: 0.4}).run().scene.entries[entry] == 0.4
    assert sf.read_fit(path).run().scene.entries[entry] == BED.entries[entry]
    for wrong in ("shear_rate.values[1]", "=0.4", "shear_rate.values[1]=fast"):
        assert main([str(path), "--set", wrong]) == 2
        assert capsys.readouterr().err.startswith(f"--set = {wrong}; must be an entry and its number")
    assert main([str(path), "--set", f"{entry}=0.4", "--set", f"{entry}=0.5"]) == 2
    assert "twice" in capsys.readouterr().err
    assert main([str(path), "--set", f"{entry}=-1"]) == 2
    assert entry in capsys.readouterr().err
