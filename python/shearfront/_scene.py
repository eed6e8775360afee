# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: what a bed is made of, and what can be asked of it."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat, times_of
from ._errors import InputError, one_complaint, without_places
from ._examples import with_examples
from ._methods import EXACT, method_of, option_texts, with_options
from ._parts import (
    DEPTH_FUNCTIONS,
    depth_table,
    diffusion_table,
    ends_of,
    flux_tables,
    initial_part,
    replace_entry,
    shown_parts,
    slab_table,
    table_of_part,
    velocity_table,
)
from ._solution import FRONT, Events, Interface, Jacobian, Solution
from ._toml import Table, canonical_tables, toml_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

    from ._arrays import FloatArray
    from ._data import Observations
    from ._options import Options
    from ._tracking import Tracking

_DEFAULT_HEIGHTS = 101


@with_examples
class Scene:
    """A sheared bed of small and large grains.

    phi_t + (s a(z) sqrt(T(z)) c(z) f(phi / c(z)))_z = (D(z) phi_z)_z on bottom < z < top: flux f, shear rate a, scale s,
    solid fraction c, granular temperature T, diffusivity D. Immutable; threads may share it.

    Parameters
    ----------
    shear_rate : Model, mapping, callable or float
        a(z): :class:`Piecewise`, :class:`Exponential`, :class:`Table`, :class:`Chute`, the table of a scene file, or a
        function of z that takes arrays (sampled, see :func:`sampled`).
    initial : Model, mapping, callable or float
        phi(z, 0) / c(z): :func:`Step`, :class:`Pieces`, a smooth start, or a function of z.
    flux : Model, mapping, str, callable, or a list of them, optional
        f; phi (phi - 1) unless given; a function of phi is sampled on [0, 1]. In a list every flux but the lowest is
        a pair (above, flux).
    scale : float, optional
        s, > 0; 1 unless given.
    solid_fraction, temperature : Model, mapping or callable, optional
        c(z) and T(z); 1 unless given.
    close_packing : Model or mapping, optional
        How closely mixtures pack, for the height of the bed.
    diffusion : float or mapping, optional
        D, or a table with D, proportional_to or a depth function.
    velocity : Model, mapping or float, optional
        u(z) of a steady chute: times are then distances x along it, and M is what passes below z.
    slab : float or mapping, optional
        The length over which a slab with this velocity repeats along x; the method is then ``"slab"``, which gives means over x.
    domain : pair of float, optional
        bottom and top; 0 and 1 unless given.
    boundary : mapping, optional
        Open ends, ``{"bottom": {"values": [0.2]}}``, or ``{"periodic": True}``; walls unless given.
    units : mapping, optional
        ``{"z": "mm", "t": "s"}``: carried to tables and pictures, and what data are converted to.
    name : str, optional

    Raises
    ------
    InputError
        With everything that is wrong with it.

    Notes
    -----
    The source of the model is May, Shearer & Daniels (2010), J. Nonlinear Sci. 20, 689-707.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> round(scene.events().t_star, 3)
    6.452
    >>> scene.with_(shear_rate__values=[2.4, 0.4])
    Scene(shear_rate=Piecewise([0.29], [2.4, 0.4]), initial=Pieces([0.5], [0, 1]))
    """

    __slots__ = ("__weakref__", "_engine")
    _engine: _core.Scene

    def __init__(
        self,
        *,
        shear_rate: Any,
        initial: Any,
        flux: Any = None,
        scale: float | None = None,
        solid_fraction: Any = None,
        temperature: Any = None,
        close_packing: Any = None,
        diffusion: Any = None,
        velocity: Any = None,
        slab: Any = None,
        domain: Any = None,
        boundary: Mapping[str, Any] | None = None,
        units: Mapping[str, str] | None = None,
        name: str | None = None,
    ) -> None:
        ends = ends_of(domain)
        tables: Table = {
            "name": name or "scene",
            "flux": flux_tables(flux),
            "shear_rate": depth_table("shear_rate", shear_rate, ends),
            "solid_fraction": depth_table("solid_fraction", solid_fraction, ends),
            "temperature": depth_table("temperature", temperature, ends),
            "close_packing": table_of_part(close_packing),
            "diffusion": diffusion_table(diffusion),
            "velocity": velocity_table(velocity),
            "slab": slab_table(slab),
            "initial": initial_part(initial, ends),
            "domain": None if domain is None else {"bottom": ends[0], "top": ends[1]},
            "boundary": boundary,
            "units": units,
        }
        if scale is not None:
            tables["shear_rate"] = {**tables["shear_rate"], "scale": scale}
        with without_places():
            self._engine = _core.parse_scene(toml_text(tables), "scene", [])

    @classmethod
    def _of(cls, core: _core.Scene) -> Scene:
        scene = object.__new__(cls)
        scene._engine = core
        return scene

    @classmethod
    def from_toml(cls, text: str, name: str = "scene") -> Scene:
        """The scene that the text of a scene file describes.

        Parameters
        ----------
        text : str
        name : str, optional
            Of the file, in messages.

        Examples
        --------
        >>> import shearfront as sf
        >>> rate = "[shear_rate]\\nmodel = 'piecewise'\\nbreaks = []\\nvalues = [1]\\n"
        >>> sf.Scene.from_toml(rate + "[initial]\\nbreaks = [0.4]\\nvalues = [0, 1]").mass
        0.6
        """
        return cls._of(_core.parse_scene(text, name, []))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any]) -> Scene:
        """The scene with these tables, those of a scene file.

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene.from_dict({"shear_rate": {"model": "piecewise", "breaks": [], "values": [1]},
        ...                             "initial": {"breaks": [0.5], "values": [0, 1]}})
        >>> scene == sf.Scene.from_dict(scene.to_dict())
        True
        """
        with without_places():
            return cls._of(_core.parse_scene(toml_text(tables), "scene", []))

    # What it is

    @property
    def name(self) -> str:
        """Its name."""
        return self._engine.name

    @property
    def units(self) -> dict[str, str]:
        """The units of z and t, where the scene says them."""
        z, t = self._engine.units
        return {name: unit for name, unit in (("z", z), ("t", t)) if unit}

    @property
    def bottom(self) -> float:
        """The bottom of the domain, in the unit of z."""
        return self._engine.bottom

    @property
    def top(self) -> float:
        """The top of the domain, in the unit of z."""
        return self._engine.top

    @property
    def mass(self) -> float:
        """The integral of phi(z, 0) over the bed."""
        return self._engine.mass

    @property
    def entries(self) -> dict[str, float]:
        """Every number of the scene by its name.

        These are the names that :meth:`with_`, :meth:`jacobian`, :func:`fit` and :func:`study` take.

        Examples
        --------
        >>> scene.entries["shear_rate.values[1]"]
        0.31
        """
        return dict(self._engine.entries)

    def shear_rate(self, z: Any) -> FloatArray:
        """a(z), without the scale s.

        Parameters
        ----------
        z : array_like
            Heights inside the domain.

        Returns
        -------
        ndarray
            Of the shape of z.

        Examples
        --------
        >>> import shearfront as sf
        >>> sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5)).shear_rate([0.1, 0.9])
        array([2.4 , 0.31])
        """
        return self._at(self._engine.shear_rate, z)

    def solid_fraction(self, z: Any) -> FloatArray:
        """c(z), of the shape of z.

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
        >>> scene.solid_fraction([0.1, 0.9])
        array([1., 1.])
        """
        return self._at(self._engine.solid_fraction, z)

    def initial_phi(self, z: Any) -> FloatArray:
        """phi(z, 0), of the shape of z; at a jump the value above it.

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
        >>> scene.initial_phi([0.1, 0.9])
        array([0., 1.])
        """
        return self._at(self._engine.initial_phi, z)

    def flux(self, phi: Any, z: float | None = None) -> FloatArray:
        """f(phi), of the flux at the height z (the bottom unless given).

        Parameters
        ----------
        phi : array_like
            States that the flux allows.
        z : float, optional
            Where there are several fluxes, which one.

        Returns
        -------
        ndarray
            Of the shape of phi.

        Examples
        --------
        >>> scene.flux([0.25, 0.5])
        array([-0.1875, -0.25  ])
        """
        phi = np.asarray(phi, dtype=float)
        values: FloatArray = self._engine.flux_value(self.bottom if z is None else float(z), flat(phi)).reshape(phi.shape)
        return values

    def _at(self, function: Any, z: Any) -> FloatArray:
        z = np.asarray(z, dtype=float)
        outside = (z < self.bottom) | (z > self.top) | np.isnan(z)
        if np.any(outside):
            raise one_complaint("z", float(z[outside].ravel()[0]), f"must be inside the domain [{self.bottom:g}, {self.top:g}]")
        values: FloatArray = function(flat(z)).reshape(z.shape)
        return values

    # Text and other scenes

    def to_toml(self) -> str:
        """The text of a scene file that reads back to the same scene, to the bit.

        Returns
        -------
        str

        Examples
        --------
        >>> print(scene.to_toml().splitlines()[5])
        [shear_rate]
        """
        return self._engine.text

    def to_dict(self) -> Table:
        """The tables of :meth:`to_toml`.

        Returns
        -------
        dict
            As :meth:`from_dict` takes it.

        Examples
        --------
        >>> scene.to_dict()["initial"]
        {'breaks': [0.5], 'values': [0, 1]}
        """
        return canonical_tables(self._engine.text)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file that the program ``shearfront`` reads as well.

        Parameters
        ----------
        path : path
            What is there is overwritten.

        Examples
        --------
        >>> import tempfile, pathlib
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "scene.toml"
        >>> scene.save(path)
        >>> sf.read(path) == scene
        True
        """
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_toml())

    def with_(self, numbers: Mapping[str, float] | None = None, /, **changes: Any) -> Scene:
        """The scene with other numbers, or other parts.

        Parameters
        ----------
        numbers : mapping, optional
            Numbers by the names of their entries: ``{"shear_rate.values[1]": 0.4}``.
        **changes
            Parts as in :class:`Scene`, ``shear_rate=sf.Exponential(4, 0.2)``, or entries with two underscores for the
            dot: ``shear_rate__values=[2.4, 0.4]``, ``initial__breaks__0=0.4``.

        Examples
        --------
        >>> scene.with_({"shear_rate.values[1]": 0.4}).shear_rate(0.9).item()
        0.4

        Returns
        -------
        Scene
        """
        core = self._engine
        if changes:
            core = self._with_parts(changes)._engine
        if numbers:
            texts = [(name, repr(float(value))) for name, value in numbers.items()]
            with without_places():
                core = _core.parse_scene(core.text, "scene", texts)
        return Scene._of(core)

    def _with_parts(self, changes: dict[str, Any]) -> Scene:
        tables = self.to_dict()
        for path, value in changes.items():
            key, *rest = path.split("__")
            if rest:
                replace_entry(tables, path, [key, *rest], value)
                continue
            ends = (self.bottom, self.top)
            if key == "scale":
                tables["shear_rate"]["scale"] = value
            elif key == "flux":
                tables["flux"] = flux_tables(value)
            elif key in DEPTH_FUNCTIONS:
                scale = {"scale": tables["shear_rate"]["scale"]} if key == "shear_rate" else {}
                tables[key] = value if value is None else {**scale, **(depth_table(key, value, ends) or {})}
            elif key == "diffusion":
                tables[key] = diffusion_table(value)
            elif key == "velocity":
                tables[key] = velocity_table(value)
            elif key == "slab":
                tables[key] = slab_table(value)
            elif key == "domain":
                tables[key] = dict(zip(("bottom", "top"), ends_of(value), strict=True))
            elif key == "initial":
                tables[key] = initial_part(value, ends)
            elif key in ("close_packing", "boundary", "units", "name"):
                tables[key] = table_of_part(value) if key == "close_packing" else value
            else:
                raise one_complaint(key, None, "is no part of a scene")
        return Scene.from_dict(tables)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __reduce__(self) -> tuple[Any, ...]:
        return _scene_of, (self.to_toml(),)

    def __repr__(self) -> str:
        return f"Scene({', '.join(f'{k}={v}' for k, v in shown_parts(self.to_dict()))})"

    def _repr_html_(self) -> str:
        from ._html import scene_html

        return scene_html(self, shown_parts(self.to_dict()))

    # The direct problem

    @with_options
    def solve(
        self, t: Any, z: Any = None, *, method: str = "exact", fronts: bool = False, **options: Unpack[Options]
    ) -> Solution:
        """phi and M at times and heights.

        Parameters
        ----------
        t : array_like
            Times, >= 0, in any order; "steady" is the end of all motion.
        z : array_like, optional
            Heights inside the domain; 101 over all of it unless given.
        method : str, optional
            A name of :func:`methods`.
        fronts : bool, optional
            Whether to keep the fronts (methods that have some).
        **options
            Those of the method, ``cells=400`` or ``resolution=0.01``.

        Returns
        -------
        Solution
            With phi[t, z] and M[t, z].

        Raises
        ------
        InputError
            For times, heights or options that are not allowed.
        NoResult
            If the method does not solve the scene, or did not come to an end.

        Notes
        -----
        Runs without the interpreter's lock; Ctrl-C ends it.

        Examples
        --------
        >>> scene.solve([0.5, 2], [0.25, 0.5, 0.75]).phi.round(3)
        array([[0.   , 0.5  , 1.   ],
               [0.029, 0.5  , 0.702]])
        >>> scene.solve(0.5, method="engquist-osher", cells=200).M.shape
        (1, 101)
        """
        times = times_of(t)
        heights = np.linspace(self.bottom, self.top, _DEFAULT_HEIGHTS) if z is None else flat(z)
        result = _core.solve(self._engine, method_of(method, options), times, heights, fronts)
        if "t_star" in result:
            times = np.where(np.isinf(times), result["t_star"], times)
        segments = result["fronts"].view(FRONT) if fronts else None
        return Solution(self, method, times, heights, result["phi"], result["M"], result["summary"], segments)

    @with_options
    def phi(self, z: Any, t: Any, *, method: str = "exact", **options: Unpack[Options]) -> Any:
        """phi(z, t), broadcasting like a ufunc.

        Parameters
        ----------
        z, t : array_like
            Heights inside the domain and times >= 0, of shapes that broadcast.
        method, **options
            As in :meth:`solve`.

        Returns
        -------
        float or ndarray
            Of the broadcast shape; a float for two numbers.

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
        >>> scene.phi(0.5, 0.25)
        0.5
        >>> scene.phi([[0.4], [0.6]], [0.25, 0.5]).shape
        (2, 2)
        """
        if type(z) is float and type(t) is float and method == "exact" and not options:
            return _core.sample_place(self._engine, EXACT, t, z)[0]
        return self._sample(z, t, method, options, 0)

    @with_options
    def M(self, z: Any, t: Any, *, method: str = "exact", **options: Unpack[Options]) -> Any:
        """M(z, t), the integral of phi from the bottom up to z, broadcasting like :meth:`phi`.

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
        >>> scene.M(1.0, 0.3)
        0.5

        Parameters
        ----------
        z, t : array_like
            As in :meth:`phi`.
        method, **options
            As in :meth:`solve`.

        Returns
        -------
        float or ndarray
            Of the broadcast shape, in the unit of z.
        """
        if type(z) is float and type(t) is float and method == "exact" and not options:
            return _core.sample_place(self._engine, EXACT, t, z)[1]
        return self._sample(z, t, method, options, 1)

    def _sample(self, z: Any, t: Any, method: str, options: Mapping[str, object], which: int) -> Any:
        z, t = np.asarray(z, dtype=float), np.asarray(t, dtype=float)
        shape = np.broadcast_shapes(z.shape, t.shape)
        solver = method_of(method, options)
        if t.size * z.size == math.prod(shape) and _comes_first(t.shape, z.shape):  # every time with every height
            values = _core.solve(self._engine, solver, flat(t), flat(z), False)["M" if which else "phi"]
        else:
            z, t = np.broadcast_arrays(z, t)
            values = _core.sample(self._engine, solver, flat(t), flat(z))[which]
        return values.reshape(shape) if shape else values.item()

    @with_options
    def jacobian(
        self, z: Any, t: Any, entries: str | Sequence[str] = (), *, method: str = "exact", **options: Unpack[Options]
    ) -> Jacobian:
        """phi and M with their derivatives with respect to numbers of the scene, exact up to rounding.

        Parameters
        ----------
        z, t : array_like
            Heights and times, of shapes that broadcast.
        entries : str or sequence of str, optional
            Names as in :attr:`entries`, or of whole arrays (``"shear_rate.values"``); all that the method has
            derivatives for unless given.
        method, **options
            As in :meth:`solve`; the exact method and Crank-Nicolson have derivatives.

        Returns
        -------
        Jacobian
            With named columns: ``jacobian(z, t)["shear_rate.values[0]"]``.

        Examples
        --------
        >>> scene.jacobian([0.4, 0.5], 0.4, "shear_rate.values").names
        ['shear_rate.values[0]', 'shear_rate.values[1]']
        """
        z, t = np.broadcast_arrays(np.asarray(z, dtype=float), np.asarray(t, dtype=float))
        wanted = [entries] if isinstance(entries, str) else list(entries)
        with without_places():
            names, phi, amount, dphi, damount = _core.linearise(
                self._engine, method_of(method, options), flat(t), flat(z), wanted
            )
        shape = (*z.shape, len(names))
        return Jacobian(names, phi.reshape(z.shape), amount.reshape(z.shape), dphi.reshape(shape), damount.reshape(shape))

    @with_options
    def events(self, *, method: str = "exact", **options: Unpack[Options]) -> Events:
        """When the first and last waves come to walls and interfaces, and when all is at rest.

        Returns
        -------
        Events

        Examples
        --------
        >>> events = scene.events()
        >>> round(events.t0, 4), round(events.interfaces[0].first, 4)
        (0.7983, 0.6774)

        Parameters
        ----------
        method, **options
            As in :meth:`solve`; the exact method and front tracking know event times.
        """
        found = _core.events(self._engine, method_of(method, options))
        found["interfaces"] = tuple(Interface(*i) for i in found["interfaces"])
        return Events(**found)

    @with_options
    def bed(self, t: Any, *, method: str = "exact", **options: Unpack[Options]) -> dict[str, FloatArray]:
        """Numbers of the whole bed at times: how well it is mixed, and how high it stands.

        Returns
        -------
        dict of ndarray
            "t", "entropy" (in units of height), "mixing" (0 segregated, 1 uniform) and, where the bed has one, "height".

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
        >>> scene.bed([0, "steady"])["mixing"].round(12)
        array([0., 0.])

        Parameters
        ----------
        t : array_like
            Times, as in :meth:`solve`.
        method, **options
            As in :meth:`solve`.
        """
        times = times_of(t)
        return {"t": times, **_core.course(self._engine, method_of(method, options), times)}

    @with_options
    def track(self, resolution: float = 0.01, *, history: bool = True, **options: Any) -> Tracking:
        """The bed by front tracking, step by step.

        Parameters
        ----------
        resolution : float, optional
            Largest step of phi in a fan, > 0 and <= 1.
        history : bool, optional
            Whether to keep fronts and collisions.
        **options
            Others of the method front-tracking.

        Returns
        -------
        Tracking

        Examples
        --------
        >>> bed.advance(0.8)
        'ok'
        >>> len(bed.fronts()) > 10
        True
        """
        from ._tracking import Tracking

        return Tracking(self, _core.track(self._engine, option_texts({"resolution": resolution, **options}), history))

    @with_options
    def compare(
        self,
        t: Any,
        methods: Iterable[str] = ("front-tracking", "engquist-osher", "muscl"),
        *,
        cells: Iterable[int] = (100, 200, 400, 800),
        resolutions: Iterable[float] = (0.1, 0.03, 0.01, 0.003),
        **options: Any,
    ) -> Any:
        """Error against time: methods from coarse to fine, measured against the exact solution.

        Parameters
        ----------
        t : array_like
            Times > 0.
        methods : iterable of str, optional
            Methods that have whole profiles.
        cells, resolutions : iterable, optional
            Coarse to fine, for methods with cells and for front tracking.
        **options
            Others, ``grid="singular-mapping"``, for the methods that have them.

        Returns
        -------
        ndarray
            Structured: method, resolution, t, l1_error, wall_s, work (collisions or cell updates).

        Examples
        --------
        >>> errors = scene.compare(0.5, ["engquist-osher"], cells=[50, 100])["l1_error"]
        >>> bool(errors[1] < errors[0])
        True
        """
        rows: list[tuple[Any, ...]] = []
        for name in methods:
            known = _option_names(name)
            fine = "cells" if "cells" in known else "resolution"
            if known and fine not in known:
                raise one_complaint("methods", name, "must have cells or a resolution: exact is what is compared with")
            others = {key: value for key, value in options.items() if key in known}
            for value in cells if fine == "cells" else resolutions:
                measured = _core.l1_errors(self._engine, method_of(name, {fine: value, **others}), flat(t))
                rows += [(name, value, time, error, wall, work) for time, error, wall, work in measured]
        kind = [("method", "U24"), ("resolution", float), ("t", float), ("l1_error", float), ("wall_s", float), ("work", int)]
        return np.array(rows, dtype=kind)

    @with_options
    def observe(
        self,
        t: Any,
        z: Any = (),
        *,
        quantity: str = "point",
        width: float = 0.0,
        noise: float = 0.0,
        seed: int = 1,
        method: str = "exact",
        **options: Unpack[Options],
    ) -> Observations:
        """Synthetic observations: what an instrument would have read, with noise.

        Parameters
        ----------
        t, z : array_like
            Times and heights; every time at every height.
        quantity : {"point", "bin", "cumulative", "bed-height"}, optional
        width : float, optional
            Of the bins, in the unit of z.
        noise : float, optional
            Standard deviation of normal noise.
        seed : int, optional
            The same seed gives the same numbers as the program's ``observe``.

        Examples
        --------
        >>> len(scene.observe([0.5, 1], [0.1, 0.5, 0.9], quantity="cumulative", noise=0.01))
        6

        Returns
        -------
        Observations
            With sigma, if there is noise.
        """
        from ._data import Observations

        made = _core.observe(
            self._engine, method_of(method, options), flat(t), flat(z), quantity, float(width), float(noise), int(seed)
        )
        return Observations(made)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws a(z) and phi(z, 0); see :func:`shearfront.pictures.scene`.

        Parameters
        ----------
        ax : Axes, optional

        Returns
        -------
        Axes

        Examples
        --------
        >>> scene.plot().get_ylabel()
        'z'
        """
        from . import pictures

        return pictures.scene(self, ax=ax)


def read(path: str | os.PathLike[str], numbers: Mapping[str, float] | None = None) -> Scene:
    """Reads a scene file.

    Parameters
    ----------
    path : path
        Of a scene file (TOML).
    numbers : mapping, optional
        Numbers to put in the place of the file's, by the names of their entries.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        With every complaint about the file, each with line and column.

    Examples
    --------
    >>> import shearfront as sf, tempfile, pathlib
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "scene.toml"
    >>> sf.Scene(shear_rate=sf.Exponential(4, 0.2), initial=sf.Step(0.5), name="bed").save(path)
    >>> sf.read(path).name
    'bed'
    """
    texts = [(name, repr(float(value))) for name, value in (numbers or {}).items()]
    try:
        return Scene._of(_core.read_scene(os.fspath(path), texts))
    except InputError as error:
        if any(c.constraint.startswith("unknown key") and c.key in ("observations", "unknown") for c in error.complaints):
            raise one_complaint(os.fspath(path), None, "is a fit file; read_fit and fit take it") from None
        raise


def _scene_of(text: str) -> Scene:
    return Scene.from_toml(text)


def _comes_first(t: tuple[int, ...], z: tuple[int, ...]) -> bool:
    """Whether all axes of t that are longer than one stand before those of z, so that z runs fastest."""
    n = max(len(t), len(z))
    long_t = [n - len(t) + i for i, size in enumerate(t) if size != 1]
    long_z = [n - len(z) + i for i, size in enumerate(z) if size != 1]
    return not long_t or not long_z or long_t[-1] < long_z[0]


def _option_names(method: str) -> list[str]:
    from ._methods import methods

    known = methods()
    return list(known[method]["options"]) if method in known else []
