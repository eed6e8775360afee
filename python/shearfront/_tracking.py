# SPDX-License-Identifier: BSD-3-Clause
"""Front tracking, step by step."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat
from ._examples import with_examples
from ._solution import FRONT

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._arrays import FloatArray
    from ._scene import Scene

#: Fields of a collision; boundary is -1 inside a layer, 0 at the bottom, then counts interfaces and the top.
COLLISION = np.dtype(
    [("t", np.float64), ("z", np.float64), ("boundary", np.int64), ("incoming", np.int64), ("outgoing", np.int64)]
)


@with_examples
@dataclass(frozen=True)
class Profile:
    """phi over all heights at one time: linear on every cell, with jumps between cells.

    Attributes
    ----------
    z : ndarray
        Edges of the cells, shape (n + 1,).
    below, above : ndarray
        phi at the lower and the upper edge of each cell, shape (n,).

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> scene.track(0.5).profile().below
    array([0. , 0. , 0.5, 1. ])
    """

    z: FloatArray
    below: FloatArray
    above: FloatArray

    def __repr__(self) -> str:
        return f"<Profile of {self.below.size} cells from z = {self.z[0]:g} to {self.z[-1]:g}>"

    def line(self) -> tuple[FloatArray, FloatArray]:
        """phi and z as a line to be drawn, jumps included.

        Returns
        -------
        tuple of ndarray
            phi and z, two of each for a cell.

        Examples
        --------
        >>> scene.track(0.5).profile().line()[0]
        array([0. , 0. , 0. , 0. , 0.5, 0.5, 1. , 1. ])
        """
        return np.column_stack((self.below, self.above)).ravel(), np.repeat(self.z, 2)[1:-1]


@with_examples
class Tracking:
    """A bed under way from t = 0 by front tracking; made by :meth:`Scene.track`.

    Exact for a flux that is made a polygon. A value: :meth:`copy` keeps a state to return to.

    Examples
    --------
    >>> import shearfront as sf
    >>> bed = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5)).track(0.1)
    >>> bed.advance(float("inf"))
    'steady'
    >>> bed.collisions().dtype.names
    ('t', 'z', 'boundary', 'incoming', 'outgoing')
    """

    __slots__ = ("_engine", "scene")

    def __init__(self, scene: Scene, core: _core.Tracking) -> None:
        self.scene = scene
        self._engine = core

    @property
    def time(self) -> float:
        """The time reached."""
        return self._engine.time

    @property
    def summary(self) -> dict[str, Any]:
        """How it went so far: collisions, most fronts, levels."""
        return self._engine.summary

    def advance(self, t: float = np.inf) -> str:
        """Goes on to time t; infinity to the steady state.

        Returns
        -------
        {"ok", "steady"}
            "steady" if nothing will ever happen again.

        Raises
        ------
        NoResult
            If it ended before.

        Parameters
        ----------
        t : float, optional
            Not before the time reached.

        Examples
        --------
        >>> scene.track(0.1).advance(0.5)
        'ok'
        """
        return self._engine.advance(float(t))

    def copy(self) -> Tracking:
        """The same state, to go on from twice.

        Returns
        -------
        Tracking

        Examples
        --------
        >>> ahead = bed.copy()
        >>> _ = ahead.advance(1.0)
        >>> bed.time, ahead.time
        (0.0, 1.0)
        """
        return Tracking(self.scene, self._engine.copy())

    def profile(self) -> Profile:
        """phi at the time reached, between walls, interfaces and fronts.

        Returns
        -------
        Profile

        Examples
        --------
        >>> scene.track(0.5).profile().z
        array([0.  , 0.29, 0.5 , 0.5 , 1.  ])
        """
        return Profile(*self._engine.profile())

    def phi(self, z: Any) -> FloatArray:
        """phi at heights, at the time reached.

        Parameters
        ----------
        z : array_like
            Heights inside the domain, in the unit of z.

        Returns
        -------
        ndarray
            Of the shape of z.

        Examples
        --------
        >>> scene.track(0.1).phi([0.25, 0.75])
        array([0., 1.])
        """
        z = np.asarray(z, dtype=float)
        values: FloatArray = self._engine.at(flat(z))[0].reshape(z.shape)
        return values

    def M(self, z: Any) -> FloatArray:
        """The integral of phi from the bottom up to heights, at the time reached.

        Parameters
        ----------
        z : array_like
            Heights inside the domain, in the unit of z.

        Returns
        -------
        ndarray
            Of the shape of z.

        Examples
        --------
        >>> scene.track(0.1).M(1.0).item()
        0.5
        """
        z = np.asarray(z, dtype=float)
        values: FloatArray = self._engine.at(flat(z))[1].reshape(z.shape)
        return values

    def fronts(self) -> Any:
        """All fronts up to the time reached, by the time and height at which they begin.

        Returns
        -------
        ndarray
            Structured: layer, t_begin, z_begin, t_end, z_end, phi_below, phi_above.

        Examples
        --------
        >>> _ = bed.advance(0.5)
        >>> bool((bed.fronts()["t_end"] == 0.5).all())
        True
        """
        return self._engine.fronts().view(FRONT)

    def collisions(self) -> Any:
        """All collisions up to the time reached, by time and height.

        Returns
        -------
        ndarray
            Structured: t, z, boundary, incoming, outgoing.

        Examples
        --------
        >>> _ = bed.advance(0.7)
        >>> bed.collisions()["z"].tolist()
        []
        """
        return self._engine.collisions().view(COLLISION)

    def steps(self, until: float = np.inf) -> Iterator[Any]:
        """Goes on from event to event.

        Parameters
        ----------
        until : float, optional
            Where to end; the steady state unless given.

        Yields
        ------
        ndarray
            The collisions of one time, structured as in :meth:`collisions`; the bed stands at that time.

        Notes
        -----
        Needs the history. A copy runs ahead to find the times, so all is computed twice.

        Examples
        --------
        >>> import shearfront as sf
        >>> bed = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5)).track(0.5)
        >>> times = [bed.time for _ in bed.steps(until=1.1)]
        >>> times == sorted(times) and times[-1] <= 1.1
        True
        """
        scout = self.copy()
        scout.advance(until)
        all_of_them = scout.collisions()
        ahead = all_of_them[all_of_them["t"] > self.time]
        for t in np.unique(ahead["t"]):
            self.advance(t)
            yield ahead[ahead["t"] == t]
        if np.isfinite(until):
            self.advance(until)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the fronts; see :func:`shearfront.pictures.fronts`.

        Parameters
        ----------
        ax : Axes, optional

        Returns
        -------
        Axes

        Examples
        --------
        >>> _ = bed.advance(0.5)
        >>> bed.plot().get_xlabel()
        't'
        """
        from . import pictures

        return pictures.fronts(self, ax=ax)

    def __repr__(self) -> str:
        return f"<Tracking of {self.scene.name!r} at t = {self.time:g}>"
