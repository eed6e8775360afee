# SPDX-License-Identifier: BSD-3-Clause
"""What a run of the direct problem gives."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import pandas, xarray
from ._examples import with_examples

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._arrays import FloatArray
    from ._scene import Scene

#: Fields of a front, from its birth to its end.
FRONT = np.dtype(
    [
        ("layer", np.uint64),
        ("t_begin", np.float64),
        ("z_begin", np.float64),
        ("t_end", np.float64),
        ("z_end", np.float64),
        ("phi_below", np.float64),
        ("phi_above", np.float64),
    ]
)


@with_examples
@dataclass(frozen=True)
class Solution:
    """phi and M at times and heights.

    Attributes
    ----------
    t, z : ndarray
        The times, shape (n,), and heights, shape (m,), in the units of the scene.
    phi, M : ndarray
        The concentration of small grains and its integral from the bottom up, both of shape (n, m):
        ``phi[i, j]`` belongs to ``t[i]`` and ``z[j]``. At a jump phi is the value above it. They are views of what the
        engine computed, not copies.
    summary : dict
        How it went: ``status``, ``message``, ``wall_s``, the work done.
    fronts : ndarray or None
        Structured array of the fronts, if they were asked for.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> scene.solve([0.5, 1], [0.2, 0.4, 0.6]).phi.shape
    (2, 3)
    """

    scene: Scene
    method: str
    t: FloatArray
    z: FloatArray
    phi: FloatArray
    M: FloatArray
    summary: dict[str, Any] = field(repr=False)
    fronts: Any = field(default=None, repr=False)

    def __repr__(self) -> str:
        return f"<Solution by {self.method}: phi and M at {self.t.size} times and {self.z.size} heights>"

    def to_dataframe(self) -> Any:
        """A table with a row per time and height, heights running fastest; needs pandas.

        Returns
        -------
        pandas.DataFrame
            Columns t, z, phi, M.

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
        >>> list(scene.solve([0, 1], [0.2, 0.8]).to_dataframe().columns)
        ['t', 'z', 'phi', 'M']
        """
        t, z = np.meshgrid(self.t, self.z, indexing="ij")
        columns = {"t": t.ravel(), "z": z.ravel(), "phi": self.phi.ravel(), "M": self.M.ravel()}
        return pandas().DataFrame(columns)

    def to_xarray(self) -> Any:
        """Labelled arrays phi(t, z) and M(t, z); needs xarray.

        Returns
        -------
        xarray.Dataset
            With the units of the scene as attributes of the coordinates.

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
        >>> dict(scene.solve([0, 1], [0.2, 0.5, 0.8]).to_xarray().sizes)
        {'t': 2, 'z': 3}
        """
        units = self.scene.units

        def axis(name: str, values: FloatArray) -> Any:
            return (name, values, {"units": units[name]} if name in units else {})

        return xarray().Dataset(
            {"phi": (("t", "z"), self.phi), "M": (("t", "z"), self.M)},
            coords={"t": axis("t", self.t), "z": axis("z", self.z)},
            attrs={"scene": self.scene.name, "method": self.method},
        )

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the profiles; see :func:`shearfront.pictures.profiles`.

        Parameters
        ----------
        ax : Axes, optional

        Returns
        -------
        Axes

        Examples
        --------
        >>> scene.solve([0, 1]).plot().get_ylabel()
        'z'
        """
        from . import pictures

        return pictures.profiles(self, ax=ax)


@dataclass(frozen=True)
class Interface:
    """When the first and the last wave come to an interface; None: never.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> scene.events().interfaces[0].z
    0.29
    """

    z: float
    first: float | None
    last: float | None


@dataclass(frozen=True)
class Events:
    """The event times of a bed, in the unit of t. A time that never comes is None.

    Attributes
    ----------
    t0, t1 : float or None
        First wave at the bottom, at the top.
    t_star : float or None
        Steady time: nothing moves any more.
    interfaces : tuple of Interface
        The interfaces from the bottom up.
    mass, steady_height : float
        The integral of phi, and the height of the jump in the end.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> scene.events().steady_height
    0.5
    """

    t0: float | None
    t1: float | None
    t_star: float | None
    interfaces: tuple[Interface, ...]
    mass: float
    steady_height: float
    summary: dict[str, Any] = field(repr=False, compare=False, default_factory=dict)

    @property
    def t_c(self) -> float | None:
        """First wave at the lowest interface."""
        return self.interfaces[0].first if self.interfaces else None


@with_examples
@dataclass(frozen=True)
class Jacobian:
    """phi and M with their derivatives with respect to entries of the scene.

    Attributes
    ----------
    names : list of str
        The entries, in the order of the last axis of the derivatives.
    phi, M : ndarray
        Of the broadcast shape of z and t.
    dphi, dM : ndarray
        The same shape with a last axis of the entries.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> scene.jacobian([0.4, 0.6], 0.5).dphi.shape[0]
    2
    """

    names: list[str]
    phi: FloatArray
    M: FloatArray
    dphi: FloatArray
    dM: FloatArray

    def __repr__(self) -> str:
        return f"<Jacobian of shape {self.phi.shape} by {', '.join(self.names)}>"

    def __getitem__(self, name: str) -> FloatArray:
        """The derivative of phi with respect to an entry."""
        return self.dphi[..., self._index(name)]

    def of_M(self, name: str) -> FloatArray:
        """The derivative of M with respect to an entry.

        Parameters
        ----------
        name : str
            One of names.

        Returns
        -------
        ndarray
            Of the shape of M.

        Raises
        ------
        KeyError
            If it is none of them.

        Examples
        --------
        >>> scene.jacobian([0.4, 0.6], 0.5).of_M("shear_rate.values[1]").shape
        (2,)
        """
        return self.dM[..., self._index(name)]

    def _index(self, name: str) -> int:
        if name not in self.names:
            raise KeyError(f"{name!r} is none of the entries: {', '.join(self.names)}")
        return self.names.index(name)

    def to_dataframe(self, quantity: str = "phi") -> Any:
        """The derivatives of "phi" or "M" as a table with a column per entry; needs pandas.

        Parameters
        ----------
        quantity : {"phi", "M"}, optional

        Returns
        -------
        pandas.DataFrame
            A row per place.

        Examples
        --------
        >>> scene.jacobian([0.4, 0.6], 0.5, "shear_rate.values").to_dataframe().shape
        (2, 2)
        """
        derivatives = {"phi": self.dphi, "M": self.dM}[quantity]
        return pandas().DataFrame(derivatives.reshape(-1, len(self.names)), columns=self.names)
