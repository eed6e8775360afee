# SPDX-License-Identifier: BSD-3-Clause
"""Functions of Python sampled into tables: is the stated error true, and does it carry over to solutions?"""

from __future__ import annotations

import math

import numpy as np
import pytest

import shearfront as sf

Z = np.linspace(0, 1, 1001)
DEPTHS = {
    "exponential": lambda z: 4 * np.exp(-z / 0.2),
    "bump": lambda z: 0.1 + np.exp(-(((z - 0.37) / 0.02) ** 2)),
    "kink": lambda z: 1 + np.abs(z - 1 / 3),
    "line": lambda z: 1 + z,
}


@pytest.mark.parametrize("name", DEPTHS)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_the_stated_error_of_depth_functions(name: str, tolerance: float) -> None:
    f = DEPTHS[name]
    found = sf.sampled(f, tolerance=tolerance)
    table = sf.Scene(shear_rate=found.model, initial=sf.Step(0.5)).shear_rate(Z)
    difference = np.abs(table - f(Z))
    assert difference.max() <= 1.1 * found.error + 1e-15
    assert np.all(difference <= 1.1 * tolerance * f(Z) + 1e-15)


def test_the_error_carries_over() -> None:
    truth = sf.Scene(shear_rate=sf.Exponential(4, 0.2), initial=sf.Step(0.5))
    for tolerance in (1e-3, 1e-4):
        table = sf.sampled(DEPTHS["exponential"], tolerance=tolerance).model
        scene = truth.with_(shear_rate=table)
        assert abs(scene.events().t_star / truth.events().t_star - 1) < tolerance
        assert np.abs(scene.M(Z, 1.0) - truth.M(Z, 1.0)).max() < tolerance
    assert sf.Scene(shear_rate=DEPTHS["exponential"], initial=sf.Step(0.5)) == truth.with_(
        shear_rate=sf.sampled(DEPTHS["exponential"]).model
    )


def test_jumps_stay_jumps() -> None:
    found = sf.sampled(lambda z: np.where(z < 0.29, 2.4, 0.31))
    scene = sf.Scene(shear_rate=found.model, initial=sf.Step(0.5))
    layers = scene.with_(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]))
    assert scene.events().t_star == pytest.approx(layers.events().t_star, rel=1e-7)


def test_functions_of_single_numbers() -> None:
    one_by_one = sf.sampled(lambda z: math.exp(-z))
    assert one_by_one == sf.sampled(lambda z: np.vectorize(math.exp)(-z))
    assert sf.sampled(lambda z: 2.5).points == 17


@pytest.mark.parametrize("gamma", [0.0, 0.5, 0.9])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_the_stated_error_of_fluxes(gamma: float, tolerance: float) -> None:
    def f(phi: np.ndarray) -> np.ndarray:
        return -phi * (1 - phi) * (1 - gamma * phi)

    found = sf.sampled(f, kind="flux", tolerance=tolerance)
    scene = sf.Scene(shear_rate=1, initial=sf.Step(0.5), flux=found.model)
    difference = np.abs(scene.flux(Z) - f(Z)).max()
    assert difference <= 1.05 * found.error
    assert found.error <= tolerance * 0.25
    exact = scene.with_(flux=sf.Cubic(gamma))
    M = [s.M(Z, 0.7, method="front-tracking", resolution=0.002) for s in (scene, exact)]
    # |M - M'| <= t max |f - f'|: both solve u_t + f(u_x) = 0 from the same start.
    assert np.abs(M[0] - M[1]).max() <= 0.7 * found.error + 2e-5


def test_a_flux_by_its_function() -> None:
    def f(phi: np.ndarray) -> np.ndarray:
        return -phi * (1 - phi) * (1 - 0.5 * phi)

    scene = sf.Scene(shear_rate=1, initial=sf.Step(0.5), flux=f)
    assert scene == scene.with_(flux=sf.sampled(f, kind="flux").model)
    exact = scene.with_(flux=sf.Cubic(0.5))
    M = [s.M(Z, 0.7, method="front-tracking", resolution=0.001) for s in (scene, exact)]
    assert np.abs(M[0] - M[1]).max() < 2e-5


def test_smooth_starts() -> None:
    f = lambda z: 0.5 + 0.3 * np.sin(6 * z)  # noqa: E731
    scene = sf.Scene(shear_rate=1, initial=f)
    assert np.abs(scene.initial_phi(Z) - f(Z)).max() < 1.05e-4 * 0.8
    assert scene.mass == pytest.approx(0.5 + 0.3 * (1 - math.cos(6)) / 6, abs=1e-4)


def test_what_is_refused() -> None:
    with pytest.raises(sf.InputError, match="finite number"):
        sf.sampled(lambda z: np.log(z, out=np.full_like(z, -np.inf), where=z > 0))
    with pytest.raises(sf.InputError, match="max_points"):
        sf.sampled(lambda z: 2 + np.sin(1000 * z), tolerance=1e-6, max_points=500)
    with pytest.raises(ValueError, match="kind"):
        sf.sampled(np.exp, kind="fluxes")
