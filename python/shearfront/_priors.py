# SPDX-License-Identifier: BSD-3-Clause
"""What is known of an unknown before the data are looked at."""

from __future__ import annotations

import math
from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING, ClassVar

from . import _core

if TYPE_CHECKING:
    from collections.abc import Callable

    _Given = tuple[str, float, float, Callable[[float], tuple[float, float]] | None]


@dataclass(frozen=True)
class Prior:
    """A distribution of one unknown in its own unit.

    ``log_density`` is up to a constant; ``low`` and ``high`` are where it ends, and narrow the bounds of the unknown.

    Examples
    --------
    >>> import shearfront as sf
    >>> isinstance(sf.Normal(0, 1), sf.Prior)
    True
    """

    @property
    def low(self) -> float:
        """Where it begins."""
        return -math.inf

    @property
    def high(self) -> float:
        """Where it ends."""
        return math.inf

    def log_density(self, p: float) -> tuple[float, float]:
        """Logarithm of the density at p inside the ends, up to a constant, and its derivative.

        What a prior of one's own must have:

        >>> import shearfront as sf
        >>> class Exponential(sf.Prior):
        ...     low = 0.0
        ...     def log_density(self, p):
        ...         return -p, -1.0
        >>> Exponential().log_density(2.0)
        (-2.0, -1.0)
        """
        raise NotImplementedError

    def _given(self) -> _Given:
        """What the library takes: kind, two numbers, and the density of one's own between them."""
        return "uniform", self.low, self.high, self.log_density


class _OfTheLibrary(Prior):
    """One whose density the library has; its numbers are the fields of the class."""

    _kind: ClassVar[str]

    @property
    def _numbers(self) -> tuple[float, float]:
        first, second, *_ = (*astuple(self), 0.0)
        return first, second

    @property
    def _engine(self) -> _core.Prior:
        return _core.Prior(self._kind, *self._numbers)

    @property
    def low(self) -> float:
        """Where it begins."""
        return self._engine.low

    @property
    def high(self) -> float:
        """Where it ends."""
        return self._engine.high

    def log_density(self, p: float) -> tuple[float, float]:
        """Up to a constant, and its derivative."""
        return self._engine.log_density(p)

    def _given(self) -> _Given:
        # A class of one's own made from it may have changed anything.
        if "_kind" not in vars(type(self)):
            return super()._given()
        return self._kind, *self._numbers, None


@dataclass(frozen=True)
class Normal(_OfTheLibrary):
    """Normal with this mean and standard deviation.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.Normal(4.0, 2.0).log_density(2.0)
    (-0.5, 0.5)
    """

    _kind = "normal"
    mean: float
    std: float


@dataclass(frozen=True)
class LogNormal(_OfTheLibrary):
    """The logarithm is normal: this median, and standard deviation of the logarithm.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.LogNormal(2.0, 0.5).low
    0.0
    """

    _kind = "lognormal"
    median: float
    sigma: float


@dataclass(frozen=True)
class HalfNormal(_OfTheLibrary):
    """The absolute value of a normal number with mean 0 and this standard deviation.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.HalfNormal(2.0).log_density(2.0)
    (-0.5, -0.5)
    """

    _kind = "half_normal"
    std: float


@dataclass(frozen=True)
class Uniform(_OfTheLibrary):
    """The same density everywhere between two ends.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.Uniform(0.1, 0.4).high
    0.4
    """

    _kind = "uniform"
    lowest: float = -math.inf
    highest: float = math.inf


#: By the name of their kind in a fit file.
KINDS: dict[str, Callable[[float, float], Prior]] = {
    "uniform": Uniform,
    "normal": Normal,
    "lognormal": LogNormal,
    "half_normal": lambda std, _: HalfNormal(std),
}
