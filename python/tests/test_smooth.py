# SPDX-License-Identifier: BSD-3-Clause
"""Shear rates under a prior of smoothness: limits in closed form, laws of the evidence, coverage."""

from __future__ import annotations

import numpy as np
import pytest

import shearfront as sf

pytest.importorskip("scipy")

Z = np.linspace(0, 1, 21)
T = np.linspace(0.2, 2, 8)
BINS = np.linspace(0.05, 0.95, 19)


def bed_of(values: np.ndarray) -> sf.Scene:
    return sf.Scene(shear_rate=sf.Table(Z, values), initial=sf.Step(0.5))


def problem_of(values: np.ndarray, noise: float, seed: int = 1) -> sf.Problem:
    return sf.problem(bed_of(np.ones_like(Z)), data_of(values, noise, seed), "shear_rate.values")


def data_of(values: np.ndarray, noise: float, seed: int = 1) -> sf.Observations:
    return bed_of(values).observe(T, BINS, quantity="bin", width=0.05, noise=noise, seed=seed)


EXPONENTIAL = 4 * np.exp(-3 * Z)
BUMP = 0.3 + 3 * np.exp(-(((Z - 0.35) / 0.15) ** 2))


def bends(a: np.ndarray) -> np.ndarray:
    """Second differences of log a by h^2, times the root of h: their squares sum to the integral of the penalty."""
    h = Z[1] - Z[0]
    return np.diff(np.log(a), 2) / h**2 * np.sqrt(h)


def test_a_large_weight_leaves_an_exponential() -> None:
    bent = EXPONENTIAL * (1 + 0.1 * np.sin(9 * Z))
    found = problem_of(bent, 0.01).smooth(weight=1e8)
    assert np.max(np.abs(bends(found.estimates))) < 1e-2
    assert found.effective == pytest.approx(2, abs=0.01)
    # The best exponential, by another search.
    seen = data_of(bent, 0.01)
    bed = sf.Scene(shear_rate=sf.Exponential(amplitude=4, decay=0.3), initial=sf.Step(0.5))
    other = sf.fit(bed, seen, ["shear_rate.amplitude", "shear_rate.decay"])
    assert found.misfit == pytest.approx(other.misfit, rel=0.02)  # a table of lines is not quite that


def test_a_small_weight_leaves_least_squares() -> None:
    found = problem_of(EXPONENTIAL, 1e-4).smooth(weight=1e-9)
    fit = sf.fit(bed_of(EXPONENTIAL), data_of(EXPONENTIAL, 1e-4), "shear_rate.values")
    assert found.misfit == pytest.approx(fit.misfit, rel=1e-3)
    inner = slice(3, 18)  # at the ends the data say next to nothing
    assert found.estimates[inner] == pytest.approx(fit.estimates[inner], rel=1e-3)
    known = np.isfinite(fit.std_errors)
    known[:3] = known[18:] = False
    assert np.sum(known) > 8
    assert found.std_errors[known] == pytest.approx(fit.std_errors[known], rel=0.05)
    assert found.effective > 20


# Where the evidence is largest: of m bends, gamma = effective - 2 are determined, and w times their squares sum to that
# (MacKay 1992), but for what the weight does to the curvature of the residuals.
def test_the_weight_is_where_its_evidence_is_largest() -> None:
    problem = problem_of(BUMP, 0.01)
    found = problem.smooth()
    squares = found.weight * np.sum(bends(found.estimates) ** 2)
    assert squares == pytest.approx(found.effective - 2, rel=0.15)
    for factor in (0.2, 5):
        assert problem.smooth(weight=found.weight * factor).log_evidence < found.log_evidence


def test_bands_cover_and_errors_are_small() -> None:
    inside, errors = [], []
    for seed in range(12):
        band = problem_of(BUMP, 0.01, seed + 1).smooth().rate_band()
        inside.append(np.mean((band.lower < BUMP) & (band.upper > BUMP)))
        errors.append(np.sqrt(np.mean(np.log(band.a / BUMP) ** 2)))
    assert np.mean(inside) > 0.9
    assert np.median(errors) < 0.06
    # An exponential is found as that: two numbers.
    assert problem_of(EXPONENTIAL, 0.01).smooth().effective < 4


def test_a_sigma_that_is_not_known_is_found() -> None:
    known = data_of(BUMP, 0.01)
    unknown = sf.data(bed_of(BUMP), t=known.t, z=known.z, phi=known.value, width=0.05)
    with_sigma = sf.problem(bed_of(np.ones_like(Z)), known, "shear_rate.values").smooth()
    without = sf.problem(bed_of(np.ones_like(Z)), unknown, "shear_rate.values").smooth()
    assert without.estimates == pytest.approx(with_sigma.estimates, rel=0.1)
    assert np.median(without.std_errors / with_sigma.std_errors) == pytest.approx(1, abs=0.25)


def test_what_is_not_smooth_is_refused() -> None:
    scene = sf.Scene(shear_rate=sf.Piecewise([0.3], [2, 1]), initial=sf.Step(0.5))
    seen = scene.observe([0.5], [0.2, 0.5, 0.8], quantity="cumulative", noise=0.01)
    with pytest.raises(sf.InputError, match="must have all values of a table of at least 3 points"):
        sf.problem(scene, seen, "shear_rate.values").smooth()
    jump = scene.with_(shear_rate=sf.Table([0, 0.5, 0.5, 1], [2, 1, 0.5, 0.2]))
    with pytest.raises(sf.InputError, match="must ascend"):
        sf.problem(jump, seen, "shear_rate.values").smooth()
    with pytest.raises(sf.InputError, match="weight = -1; must be finite and > 0"):
        problem_of(BUMP, 0.01).smooth(weight=-1)
