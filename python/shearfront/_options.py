# SPDX-License-Identifier: BSD-3-Clause
# Written by scripts/stubs.py from the lists of the library; not to be edited.
"""Options of methods as keyword arguments, for type checkers and editors."""

from __future__ import annotations

from typing import Literal, TypedDict


class Options(TypedDict, total=False):
    """Every option of every method; each method takes its own."""

    tolerance: float
    """aim for the error of M, in heights of the bed, where pieces stand for a smooth bed or a smooth start is searched by parts, > 0 and <= 1 (exact)

    aim for the error that time steps make in phi; cells make another, > 0 and <= 1 (crank-nicolson)."""
    layers: int
    """so many pieces for a smooth bed, or parts of a smooth start in one of pieces, instead of the tolerance, from 1 to 1000000 (exact)."""
    resolution: float
    """largest step of phi in a fan, or delta of the singular mapping, > 0 and <= 1 (front-tracking)."""
    grid: Literal["levels", "singular-mapping"]
    """grid of states (front-tracking)."""
    reconstruct: Literal["constant", "linear"]
    """phi between fronts (front-tracking)."""
    edges: Literal["characteristic", "secant"]
    """first arrivals of fans (front-tracking)."""
    max_collisions: int
    """stop after so many collisions, from 1 to 1000000000000000 (front-tracking)."""
    max_fronts: int
    """stop with so many fronts alive, of 64 bytes each, from 1 to 2000000000 (front-tracking)."""
    cells: int
    """number of cells, from 1 to 100000000 (engquist-osher, godunov, muscl, classical-godunov, upwind)

    number of cells, from 2 to 10000000 (crank-nicolson)

    number of cells over the height, from 2 to 10000 (slab)."""
    cfl: float
    """time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2), > 0 and <= 1 (engquist-osher, godunov, muscl, classical-godunov, upwind)."""
    align_cells: bool
    """edges of cells on the interfaces, equal cells within each layer (engquist-osher, godunov, muscl, classical-godunov, upwind)."""
    face_coefficient: Literal["harmonic", "value"]
    """harmonic mean of a(z) between the middles of two cells, or its value at their face (engquist-osher)."""
    limiter: Literal["minmod", "mc", "van-leer"]
    """what bounds the slopes (muscl)."""
    time_step: float
    """fixed time step, > 0 (crank-nicolson)

    longest time step, > 0 (slab)."""
    cell_tolerance: float
    """halve cells, beginning with the number given, where phi bends by more than this from one to the next, >= 1e-06 and <= 0.1 (crank-nicolson)."""
    monotone: bool
    """fitted fluxes, which do not wiggle where cells are coarse (first order there) (crank-nicolson)."""
    steady: bool
    """only the steady state, t = inf, but of any a(z), T(z) and D(z) (cole-hopf)."""
    cells_x: int
    """number of cells along x, from 3 to 10000 (slab)."""
    threads: int
    """cores to use; results do not depend on it, from 1 to 1024 (slab)."""
