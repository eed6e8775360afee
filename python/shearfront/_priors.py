# SPDX-License-Identifier: BSD-3-Clause
"""What is known of an unknown before the data are looked at."""

from __future__ import annotations

import math
from dataclasses import dataclass


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


@dataclass(frozen=True)
class Normal(Prior):
    """Normal with this mean and standard deviation.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.Normal(4.0, 2.0).log_density(2.0)
    (-0.5, 0.5)
    """

    mean: float
    std: float

    def log_density(self, p: float) -> tuple[float, float]:
        """Up to a constant, and its derivative.

        >>> import shearfront as sf
        >>> sf.Normal(4.0, 2.0).log_density(2.0)
        (-0.5, 0.5)
        """
        r = (p - self.mean) / self.std
        return -r * r / 2, -r / self.std


@dataclass(frozen=True)
class LogNormal(Prior):
    """The logarithm is normal: this median, and standard deviation of the logarithm.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.LogNormal(2.0, 0.5).low
    0.0
    """

    median: float
    sigma: float

    @property
    def low(self) -> float:
        """It is positive."""
        return 0.0

    def log_density(self, p: float) -> tuple[float, float]:
        """Up to a constant, and its derivative.

        >>> import shearfront as sf
        >>> sf.LogNormal(1.0, 1.0).log_density(1.0)
        (-0.0, -1.0)
        """
        r = math.log(p / self.median) / self.sigma
        return -r * r / 2 - math.log(p), -(r / self.sigma + 1) / p


@dataclass(frozen=True)
class HalfNormal(Prior):
    """The absolute value of a normal number with mean 0 and this standard deviation.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.HalfNormal(2.0).log_density(2.0)
    (-0.5, -0.5)
    """

    std: float

    @property
    def low(self) -> float:
        """It is positive."""
        return 0.0

    def log_density(self, p: float) -> tuple[float, float]:
        """Up to a constant, and its derivative.

        >>> import shearfront as sf
        >>> sf.HalfNormal(2.0).log_density(2.0)
        (-0.5, -0.5)
        """
        r = p / self.std
        return -r * r / 2, -r / self.std


@dataclass(frozen=True)
class Uniform(Prior):
    """The same density everywhere between two ends.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.Uniform(0.1, 0.4).high
    0.4
    """

    lowest: float = -math.inf
    highest: float = math.inf

    @property
    def low(self) -> float:
        """Its lower end."""
        return self.lowest

    @property
    def high(self) -> float:
        """Its upper end."""
        return self.highest

    def log_density(self, p: float) -> tuple[float, float]:
        """0, and its derivative.

        >>> import shearfront as sf
        >>> sf.Uniform(0, 1).log_density(0.5)
        (0.0, 0.0)
        """
        return 0.0, 0.0
