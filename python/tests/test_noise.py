# SPDX-License-Identifier: BSD-3-Clause
"""Correlated noise of fits: settings, facts, pickles, and the posterior against its formula."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import shearfront as sf

BED = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
TIMES = np.linspace(0.3, 3, 10)
HEIGHTS = np.linspace(0.05, 0.95, 10)
KNOWN = {"model": "exponential", "length_z": 0.3, "length_t": 1.0, "independent": 0.2}


def correlation(t: np.ndarray, z: np.ndarray) -> np.ndarray:
    k = np.exp(-np.abs(z[:, None] - z) / 0.3 - np.abs(t[:, None] - t) / 1.0)
    return 0.2 * np.eye(len(t)) + 0.8 * k


def seen(with_sigma: bool) -> sf.Observations:
    exact = BED.observe(TIMES, HEIGHTS, quantity="bin", width=0.1)
    root = np.linalg.cholesky(correlation(exact.t, exact.z))
    values = exact.value + 0.02 * root @ np.random.default_rng(1).normal(size=len(exact.t))
    columns = {"t": exact.t, "z": exact.z, "width": np.full(len(exact.t), 0.1), "phi": values}
    if with_sigma:
        columns["sigma"] = np.full(len(exact.t), 0.02)
    return sf.data(BED, columns)


def test_estimated_lengths_are_facts_and_survive_pickles() -> None:
    problem = sf.problem(BED, seen(False), "shear_rate.values", noise={"model": "exponential", "independent": "estimated"})
    found = problem.run()
    noise = found.facts["noise"]
    assert noise["model"] == "exponential"
    assert noise["length_z"] > 0
    assert noise["length_t95"][0] < noise["length_t"] < noise["length_t95"][1]
    assert pickle.loads(pickle.dumps(found)).facts["noise"] == noise
    assert pickle.loads(pickle.dumps(problem)).run().facts["noise"] == noise
    assert sf.fit(BED, seen(False), "shear_rate.values").facts["noise"] is None


@pytest.mark.parametrize("with_sigma", [True, False])
def test_posterior_is_that_of_the_dense_covariance(with_sigma: bool) -> None:
    data = seen(with_sigma)
    posterior = sf.problem(BED, data, "shear_rate.values", noise=KNOWN).posterior()
    inverse = np.linalg.inv(correlation(data.t, data.z))

    def log_density(p: list[float]) -> float:
        predicted = BED.with_({"shear_rate.values[0]": p[0], "shear_rate.values[1]": p[1]}).observe(
            TIMES, HEIGHTS, quantity="bin", width=0.1
        )
        r = (predicted.value - data.value) / (0.02 if with_sigma else 1)
        squares = r @ inverse @ r
        return -squares / 2 if with_sigma else -len(r) / 2 * np.log(squares)

    a, b = [2.4, 0.31], [2.2, 0.33]
    difference = posterior.log_density(a) - posterior.log_density(b)
    assert difference == pytest.approx(log_density(a) - log_density(b), rel=1e-8)
    h = 1e-5
    slope = (log_density([2.2 + h, 0.33]) - log_density([2.2 - h, 0.33])) / (2 * h)
    assert posterior.gradient(b)[0] == pytest.approx(slope, rel=1e-5)


def test_posterior_takes_the_lengths_of_the_fit() -> None:
    problem = sf.problem(BED, seen(False), "shear_rate.values", noise="exponential")
    with pytest.raises(sf.InputError, match="numbers for the misfit alone"):
        _ = problem.misfit
    noise = problem.run().facts["noise"]
    given = {k: noise[k] for k in ("model", "length_z", "length_t", "independent")}
    same = sf.problem(BED, seen(False), "shear_rate.values", noise=given).posterior()
    p = [2.3, 0.32]
    assert problem.posterior().log_density(p) == pytest.approx(same.log_density(p), rel=1e-9)


def test_wrong_noise_is_refused() -> None:
    with pytest.raises(sf.InputError, match="must be one of: independent, exponential, discrepancy"):
        sf.problem(BED, seen(False), "shear_rate.values", noise="pink")
