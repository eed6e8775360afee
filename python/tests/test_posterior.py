# SPDX-License-Identifier: BSD-3-Clause
"""Posteriors: densities against differences and priors of one's own, samples against quadrature. More is tested in C++
(tests/unit/fit_posterior_test.cpp)."""

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

import shearfront as sf

BED = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
TIMES = [0.2, 0.5, 1, 2, 3]
EDGES = np.linspace(0.1, 0.9, 9)


def seen(noise: float = 0.02, seed: int = 1, quantity: str = "cumulative") -> sf.Observations:
    return BED.observe(TIMES, EDGES, quantity=quantity, noise=noise, seed=seed)


def without_sigma(observations: sf.Observations) -> sf.Observations:
    columns = {"t": observations.t, "z": observations.z, "M": observations.value}
    return sf.data(BED, columns)


@pytest.mark.parametrize("has_sigma", [True, False])
def test_gradient_against_differences(has_sigma: bool) -> None:
    observations = seen() if has_sigma else without_sigma(seen())
    priors = {"shear_rate.values": sf.LogNormal(1.0, 2.0), "initial.breaks[0]": sf.Normal(0.5, 0.02)}
    problem = sf.problem(BED, observations, ["shear_rate.values", "initial.breaks"])
    posterior = problem.posterior(priors)
    x = posterior.coordinates([2.3, 0.32, 0.51])
    value, gradient = posterior.unbounded(x)
    p = posterior.values(x)
    steps = 1e-6 * np.eye(3)
    by_x = np.array([(posterior.values(x + h) - posterior.values(x - h)) / 2e-6 for h in steps])
    assert value == pytest.approx(posterior.log_density(p) + np.linalg.slogdet(by_x)[1], rel=1e-8)
    assert posterior.coordinates(p) == pytest.approx(x, rel=1e-9)
    for j in range(3):
        h = 1e-6 * np.eye(3)[j]
        difference = (posterior.unbounded(x + h)[0] - posterior.unbounded(x - h)[0]) / 2e-6
        assert gradient[j] == pytest.approx(difference, rel=1e-4, abs=1e-3)
        assert posterior.gradient(p)[j] == pytest.approx(
            (posterior.log_density(p + h) - posterior.log_density(p - h)) / 2e-6, rel=1e-4, abs=1e-3
        )


class Own(sf.Prior):
    """Normal(2.4, 0.2) from 2.2 on, by hand."""

    low = 2.2

    def log_density(self, p: float) -> tuple[float, float]:
        if p > 100:
            raise ZeroDivisionError("too far")
        return -((p - 2.4) ** 2) / 0.08, -(p - 2.4) / 0.04


class Cut(sf.Normal):
    """The same from what the library has."""

    low = 2.2


@pytest.mark.parametrize("prior", [Own(), Cut(2.4, 0.2)])
def test_priors_of_ones_own(prior: sf.Prior) -> None:
    problem = sf.problem(BED, seen(), "shear_rate.values")
    own = problem.posterior({"shear_rate.values[0]": prior})
    known = problem.posterior({"shear_rate.values[0]": sf.Normal(2.4, 0.2)})
    p = [2.3, 0.32]
    assert own.log_density(p) == pytest.approx(known.log_density(p), rel=1e-14)
    assert own.gradient(p) == pytest.approx(known.gradient(p), rel=1e-12)
    assert own.log_density([2.1, 0.32]) == -math.inf
    assert known.log_density([2.1, 0.32]) > -math.inf
    x = own.coordinates(p)
    gradient = own.unbounded(x)[1]
    for j, h in enumerate(1e-6 * np.eye(2)):
        assert gradient[j] == pytest.approx((own.unbounded(x + h)[0] - own.unbounded(x - h)[0]) / 2e-6, rel=1e-4, abs=1e-3)
    assert own.priors["shear_rate.values[0]"] is prior
    assert pickle.loads(pickle.dumps(own)).log_density(p) == own.log_density(p)


def test_what_a_prior_of_ones_own_raises_comes_through() -> None:
    posterior = sf.problem(BED, seen(), "shear_rate.values").posterior({"shear_rate.values[0]": Own()})
    with pytest.raises(ZeroDivisionError, match="too far"):
        posterior.log_density([200.0, 0.3])
    with pytest.raises(ZeroDivisionError, match="too far"):
        posterior.gradient([200.0, 0.3])


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
    with pytest.raises(sf.InputError, match="must have a standard deviation > 0"):
        sf.problem(BED, seen(), "shear_rate.values").posterior({"shear_rate.values[0]": sf.Normal(2, -1)})
    with pytest.raises(sf.InputError, match="must have one number per unknown"):
        posterior.log_density([2.4])
    with pytest.raises(sf.NoResult, match="outside the bounds"):
        posterior.gradient([2.4, 0.5])
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
