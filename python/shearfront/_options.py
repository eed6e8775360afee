# SPDX-License-Identifier: BSD-3-Clause
# Written by scripts/stubs.py from the lists of the library; not to be edited.
"""Options of methods as keyword arguments, for type checkers and editors."""

from __future__ import annotations

from typing import Literal, TypedDict


class Options(TypedDict, total=False):
    """Every option of every method; each method takes its own."""

    tolerance: float
    """exact: aim for the error of M, in heights of the bed, where pieces stand for a smooth bed or a smooth start is searched by parts, > 0 and <= 1; crank-nicolson: aim for the error that time steps make in phi; cells make another, > 0 and <= 1."""
    layers: int
    """exact: so many pieces for a smooth bed instead of the tolerance; layers (128) from a smooth start with a flux that is no parabola, from 1 to 1000000; front-tracking: smooth shear rates: number of layers of the staircase, from 1 to 1000000."""
    resolution: float
    """front-tracking: largest step of phi in a fan, or delta of the singular mapping, > 0 and <= 1."""
    grid: Literal["levels", "singular-mapping"]
    """front-tracking: grid of states."""
    reconstruct: Literal["constant", "linear"]
    """front-tracking: phi between fronts."""
    edges: Literal["characteristic", "secant"]
    """front-tracking: first arrivals of fans where the rate varies smoothly."""
    max_collisions: int
    """front-tracking: stop after so many collisions, from 1 to 1000000000000000."""
    max_fronts: int
    """front-tracking: stop with so many fronts alive, of 64 bytes each, from 1 to 2000000000."""
    cells: int
    """engquist-osher: number of cells, from 1 to 100000000; godunov: number of cells, from 1 to 100000000; muscl: number of cells, from 1 to 100000000; classical-godunov: number of cells, from 1 to 100000000; upwind: number of cells, from 1 to 100000000; crank-nicolson: number of cells, from 2 to 10000000."""
    cfl: float
    """engquist-osher: time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2), > 0 and <= 1; godunov: time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2), > 0 and <= 1; muscl: time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2), > 0 and <= 1; classical-godunov: time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2), > 0 and <= 1; upwind: time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2), > 0 and <= 1."""
    align_cells: bool
    """engquist-osher: edges of cells on the interfaces, equal cells within each layer; godunov: edges of cells on the interfaces, equal cells within each layer; muscl: edges of cells on the interfaces, equal cells within each layer; classical-godunov: edges of cells on the interfaces, equal cells within each layer; upwind: edges of cells on the interfaces, equal cells within each layer."""
    face_coefficient: Literal["harmonic", "value"]
    """engquist-osher: harmonic mean of a(z) between the middles of two cells, or its value at their face."""
    limiter: Literal["minmod", "mc", "van-leer"]
    """muscl: what bounds the slopes."""
    time_step: float
    """crank-nicolson: fixed time step, > 0."""
    cell_tolerance: float
    """crank-nicolson: halve cells, beginning with the number given, where phi bends by more than this from one to the next, >= 1e-06 and <= 0.1."""
    monotone: bool
    """crank-nicolson: fitted fluxes, which do not wiggle where cells are coarse (first order there)."""
