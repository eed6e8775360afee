# SPDX-License-Identifier: BSD-3-Clause
"""Steady chutes, slabs, and shear rates from rheology: closed forms and laws, through the package."""

from __future__ import annotations

import numpy as np
import pytest

import shearfront as sf

THIRD = 1 / 3  # s a of the chutes of datasets/chute-steady-*


def chute(start: object, velocity: object, **more: object) -> sf.Scene:
    return sf.Scene(shear_rate=sf.Piecewise([], [1]), scale=THIRD, initial=start, velocity=velocity, **more)


@pytest.mark.parametrize(("jump", "x_star", "z_star"), [(0.4, 5.199636333578804, 0.84**0.5), (0.6, 5.88, 0.8)])
def test_distances_of_a_chute_in_simple_shear(jump: float, x_star: float, z_star: float) -> None:
    events = chute(sf.Step(jump), sf.LinearVelocity(slope=2.0)).events()
    assert events.t_star == pytest.approx(x_star, abs=1e-12)
    assert events.steady_height == pytest.approx(z_star, abs=1e-14)
    assert events.t0 == pytest.approx(jump**2 / THIRD, abs=1e-12)
    assert events.mass == pytest.approx(1 - jump**2, abs=1e-14)


def test_what_passes_is_kept_along_a_chute() -> None:
    scene = chute(sf.Step(0.4), sf.LinearVelocity(slope=2.0))
    heights = np.linspace(0, 1, 2001)
    for method in ("exact", "godunov", "muscl"):
        solution = scene.solve([0.5, 2, 6], heights, method=method)
        np.testing.assert_allclose(solution.M[:, -1], 0.84, atol=1e-12)
        passing = np.trapezoid(2 * heights * solution.phi, heights, axis=1)
        np.testing.assert_allclose(passing, 0.84, atol=2e-3)


def test_a_number_is_a_uniform_velocity_and_stretches_distances() -> None:
    slow, fast = chute(sf.Step(0.5), 1.0), chute(sf.Step(0.5), 2.5)
    z = np.linspace(0, 1, 21)
    np.testing.assert_allclose(fast.phi(z, 2.5), slow.phi(z, 1.0), atol=1e-13)
    assert fast.events().t_star == pytest.approx(2.5 * slow.events().t_star)


def test_a_fit_along_a_chute_finds_its_rate() -> None:
    scene = chute(sf.Step(0.5), sf.LinearVelocity(slope=2.0))
    seen = scene.observe([0.5, 1, 2, 3], np.linspace(0.05, 0.95, 10))
    found = sf.fit(scene, seen, "shear_rate.scale", start=[0.5])
    assert found.estimates[0] == pytest.approx(THIRD, rel=1e-6)


def test_bins_of_a_chute_are_means_over_height_and_fit() -> None:
    scene = chute(sf.Step(0.5), sf.LinearVelocity(slope=2.0))
    distances, middles = [0.5, 1, 2], np.linspace(0.05, 0.95, 10)
    seen = scene.observe(distances, middles, quantity="bin", width=0.1)
    heights = (np.arange(5000) + 0.5) / 5000
    means = scene.solve(distances, heights).phi.reshape(3, 10, 500).mean(axis=2)
    np.testing.assert_allclose(np.reshape(seen.value, (3, 10)), means, atol=3e-3)
    found = sf.fit(scene, seen, "shear_rate.scale", start=[0.5])
    assert found.estimates[0] == pytest.approx(THIRD, rel=1e-6)


BAGNOLD = {"angle": 0.43, "grain": 0.04, "gravity": 1.0}


def test_a_layer_on_a_slope_by_closed_forms() -> None:
    events = sf.Scene(shear_rate=sf.Bagnold(**BAGNOLD), scale=0.5, initial=sf.Step(0.5)).events()
    assert events.t0 == pytest.approx(0.37799194, abs=5e-9)
    assert events.t1 == pytest.approx(0.91255327, abs=5e-9)
    assert events.t_star == pytest.approx(2.11707616, abs=5e-9)


def test_an_angle_without_steady_flow_is_refused_with_the_range() -> None:
    with pytest.raises(sf.InputError, match=r"between 0\.363147 and 0\.569313 radian"):
        sf.Scene(shear_rate=sf.Bagnold(angle=24, grain=0.04), initial=sf.Step(0.5))


def test_the_steady_state_is_logistic_in_the_velocity() -> None:
    scene = sf.Scene(shear_rate=sf.Bagnold(**BAGNOLD), scale=0.5, diffusion=0.01, initial=sf.Step(0.5))
    phi = scene.solve([np.inf], [0.4, 0.48, 0.5, 0.6], method="cole-hopf", steady=True).phi[0]
    np.testing.assert_allclose(phi, [0.9999896044, 0.9001040536, 0.4962390238, 3.026143e-5], rtol=5e-7)


def test_a_kinetic_bed_is_between_its_bounds() -> None:
    scene = sf.Scene(shear_rate=sf.Kinetic(amplitude=1, length=0.2, load=1), initial=sf.Step(0.5))
    events = scene.events()
    assert events.t0 == pytest.approx(3.095683073, rel=1e-5)
    assert events.t1 == pytest.approx(0.7926430055, rel=1e-5)


def slab(**more: object) -> sf.Scene:
    return sf.Scene(
        shear_rate=sf.Bagnold(**BAGNOLD),
        scale=0.5,
        diffusion=0.01,
        velocity=sf.BagnoldVelocity(**BAGNOLD, surface=1.0),
        slab=1.0,
        **more,
    )


BLOCK = {"model": "block", "x": [0, 2 / 3], "z": [0, 0.75], "inside": 0, "outside": 1}


def test_a_slab_keeps_its_grains_and_gives_means_over_x() -> None:
    solution = slab(initial=BLOCK).solve([0, 0.5, 2], [0.5, 0.9, 1], method="slab", cells=32)
    np.testing.assert_allclose(solution.M[:, -1], 0.5, atol=1e-10)
    np.testing.assert_allclose(solution.phi[0, :2], [1 / 3, 1], atol=0.02)
    assert np.all((solution.phi >= 0) & (solution.phi <= 1))


def test_a_slab_that_is_the_same_along_x_is_a_bed() -> None:
    z = np.linspace(0.1, 0.9, 9)
    bed = sf.Scene(shear_rate=sf.Bagnold(**BAGNOLD), scale=0.5, diffusion=0.01, initial=sf.Step(0.5))
    one = bed.solve([0.5, 1], z, method="crank-nicolson", cells=400)
    other = slab(initial=sf.Step(0.5)).solve([0.5, 1], z, method="slab", cells=128, cells_x=3)
    np.testing.assert_allclose(other.M, one.M, atol=5e-4)


def test_a_slab_is_refused_by_the_methods_of_beds() -> None:
    with pytest.raises(sf.NoResult, match="use slab"):
        slab(initial=BLOCK).solve([1], [0.5])
