# SPDX-License-Identifier: BSD-3-Clause
"""Coordinates without bounds for unknowns that have some, with the Jacobian that densities need."""

from __future__ import annotations

import itertools
import math
import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ._arrays import FloatArray

#: Bounds of a positive unknown further apart than this factor are an interval of its logarithm.
_WIDE = 10.0


class Point(NamedTuple):
    """Unknowns at some coordinates.

    Attributes
    ----------
    p : ndarray
    derivative : ndarray
        dp/dx, shape (unknowns, coordinates), triangular in the order in which they are made.
    log_volume, slope
        log |det dp/dx| and its gradient in x.
    """

    p: FloatArray
    derivative: FloatArray
    log_volume: float
    slope: FloatArray


class Unbounded:
    """One coordinate x for each unknown p, both ways smooth inside the bounds.

    Between bounds l and h, p = l + (h - l) / (1 + exp(-x)), of log p where they are positive and far apart; above l alone,
    p = l + exp(x). Breaks cannot cross and the values of a shape keep it: the lower end of each follows the one before.

    Parameters
    ----------
    names : sequence of str
        Entries of the scene.
    lower, upper : ndarray
    shape : str
        "none", "decreasing" or "convex": of the values of a(z).
    """

    def __init__(self, names: Sequence[str], lower: FloatArray, upper: FloatArray, shape: str) -> None:
        self._lower, self._upper = np.array(lower), np.array(upper)
        #: For each unknown the others that bound it from below: sum of coefficient * p.
        self._floor: list[dict[int, float]] = [{} for _ in names]
        order = list(range(len(names)))
        fields: dict[str, list[tuple[int, int]]] = {}
        for i, name in enumerate(names):
            if match := re.fullmatch(r"(.*)\[(\d+)\]", name):
                fields.setdefault(match[1], []).append((int(match[2]), i))
        for field, elements in fields.items():
            chain = [i for _, i in sorted(elements)]
            if field.endswith("breaks"):
                for before, i in itertools.pairwise(chain):
                    self._floor[i] = {before: 1.0}
            elif field == "shear_rate.values" and shape != "none":
                chain.reverse()  # from the top, the smallest
                for k, i in enumerate(chain[1:], 1):
                    self._floor[i] = {chain[k - 1]: 1.0}
                    if shape == "convex" and k > 1:
                        self._floor[i] = {chain[k - 1]: 2.0, chain[k - 2]: -1.0}
            for place, i in zip(sorted(chain), chain, strict=True):
                order[place] = i
        self._order = order

    def __len__(self) -> int:
        return len(self._order)

    def _ends(self, i: int, p: FloatArray) -> tuple[float, float, bool, bool]:
        """Lower and upper end of p_i, whether the lower one follows others, whether it is of log p."""
        low, high = float(self._lower[i]), float(self._upper[i])
        floor = sum(c * float(p[j]) for j, c in self._floor[i].items()) if self._floor[i] else -math.inf
        follows = floor > low
        if follows:
            low = floor
        is_log = not self._floor[i] and low > 0 and math.isfinite(high) and high > _WIDE * low
        return low, high, follows, is_log

    def at(self, x: FloatArray) -> Point | None:
        """The unknowns at x; None where there is no room for them left."""
        n = len(self)
        p = np.zeros(n)
        derivative = np.zeros((n, n))
        log_volume, slope = 0.0, np.zeros(n)
        for i in self._order:
            low, high, follows, is_log = self._ends(i, p)
            if low >= high:
                return None
            xi = float(x[i])
            if math.isfinite(high) and math.isfinite(low):
                share, rest = _logistic(xi), _logistic(-xi)
                width = math.log(high / low) if is_log else high - low
                p[i] = low * math.exp(width * share) if is_log else low + width * share
                own = width * share * rest * (p[i] if is_log else 1.0)
                curve = rest - share + (width * share * rest if is_log else 0.0)  # d log own / dx
            elif math.isfinite(low):
                own = math.exp(min(xi, 700.0))
                p[i], curve = low + own, 1.0
            elif math.isfinite(high):
                own = math.exp(min(xi, 700.0))
                p[i], curve = high - own, 1.0
            else:
                p[i], own, curve = xi, 1.0, 0.0
            if own <= 0.0:
                return None
            log_volume += math.log(own)
            slope[i] += curve
            derivative[i, i] = -own if math.isinf(low) and math.isfinite(high) else own
            if follows:
                # p_i = l + (h - l) s or l + exp(x), l = sum c p_j.
                part = _logistic(-xi) if math.isfinite(high) else 1.0
                moved = sum(c * derivative[j] for j, c in self._floor[i].items())
                derivative[i] += part * moved
                if math.isfinite(high):
                    slope -= moved / (high - low)
        return Point(p, derivative, log_volume, slope)

    def coordinates(self, p: FloatArray) -> FloatArray:
        """x of the unknowns p, moved inside the bounds by a millionth of the way where they are at one."""
        p = np.array(p, dtype=float)
        x = np.zeros(len(self))
        for i in self._order:
            low, high, _, is_log = self._ends(i, p)
            if math.isfinite(high) and math.isfinite(low):
                value, a, b = (math.log(max(p[i], low)), math.log(low), math.log(high)) if is_log else (p[i], low, high)
                share = min(max((value - a) / (b - a), 1e-6), 1 - 1e-6)
                x[i] = math.log(share / (1 - share))
                value = a + (b - a) * share
                p[i] = math.exp(value) if is_log else value
            elif math.isfinite(low):
                x[i] = math.log(max(p[i] - low, 1e-6 * max(abs(low), 1.0)))
                p[i] = low + math.exp(x[i])
            elif math.isfinite(high):
                x[i] = math.log(max(high - p[i], 1e-6 * max(abs(high), 1.0)))
                p[i] = high - math.exp(x[i])
            else:
                x[i] = p[i]
        return x


def _logistic(x: float) -> float:
    return 1 / (1 + math.exp(-x)) if x > -700 else math.exp(x)
