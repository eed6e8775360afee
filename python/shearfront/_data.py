# SPDX-License-Identifier: BSD-3-Clause
"""Observations: measured numbers with their times and heights."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat, pandas
from ._errors import one_complaint, without_places
from ._examples import with_examples

if TYPE_CHECKING:
    from ._arrays import FloatArray
    from ._scene import Scene

_VALUES = {"phi": "point", "M": "cumulative", "H": "bed-height"}
_COLUMNS = ("t", "z", *_VALUES, "width", "sigma")


@with_examples
class Observations:
    """Measured numbers with their places, as a fit takes them; made by :func:`data`.

    Attributes
    ----------
    quantity : str
        "point", "bin", "cumulative" or "bed-height".
    t, z, value, width, sigma : ndarray
        One number per row; width is 0 and sigma NaN where there is none.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
    >>> seen.quantity, len(seen)
    ('cumulative', 12)
    """

    __slots__ = ("_engine", "quantity", "sigma", "t", "value", "width", "z")
    quantity: str
    t: FloatArray
    z: FloatArray
    value: FloatArray
    width: FloatArray
    sigma: FloatArray

    def __init__(self, core: _core.Observations) -> None:
        self._engine = core
        self.quantity, self.t, self.z, self.value, self.width, self.sigma = core.columns

    def __len__(self) -> int:
        return len(self.t)

    @property
    def notes(self) -> list[str]:
        """What a user should be told about the file they came from."""
        return self._engine.notes

    @property
    def understood(self) -> str:
        """How their file was read, in one line; empty for arrays."""
        return self._engine.understood

    def to_csv(self) -> str:
        """The text of a file of observations that reads back to the same numbers, to the bit.

        Returns
        -------
        str

        Examples
        --------
        >>> seen.to_csv().splitlines()[0]
        't,z,M,sigma'
        """
        return self._engine.text

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file of observations that the program ``shearfront`` reads as well.

        Parameters
        ----------
        path : path
            What is there is overwritten.

        Examples
        --------
        >>> import tempfile, pathlib
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "seen.csv"
        >>> seen.save(path)
        >>> len(sf.data(scene, path))
        12
        """
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_csv())

    def to_dict(self) -> dict[str, FloatArray]:
        """The columns that say something, by their names in a file.

        Returns
        -------
        dict of ndarray

        Examples
        --------
        >>> list(seen.to_dict())
        ['t', 'z', 'M', 'sigma']
        """
        name = {"cumulative": "M", "bed-height": "H"}.get(self.quantity, "phi")
        columns = {"t": self.t, "z": self.z, name: self.value}
        if self.quantity == "bed-height":
            del columns["z"]
        if self.quantity == "bin":
            columns["width"] = self.width
        if not np.isnan(self.sigma).any():
            columns["sigma"] = self.sigma
        return columns

    def to_dataframe(self) -> Any:
        """A table with the columns of :meth:`to_dict`; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Examples
        --------
        >>> seen.to_dataframe().shape
        (12, 4)
        """
        return pandas().DataFrame(self.to_dict())

    def __reduce__(self) -> tuple[Any, ...]:
        return _observations_of, (self._engine.state,)

    def __repr__(self) -> str:
        return f"<{len(self)} observations ({self.quantity}), t {self.t.min():g} to {self.t.max():g}>"


def _observations_of(state: list[Any]) -> Observations:
    return Observations(_core.observations_of_state(state))


def data(scene: Scene, source: Any = None, *, replicates: str = "refuse", **columns: Any) -> Observations:
    """Observations for a scene, from a file, a table or arrays, checked in the same way.

    Parameters
    ----------
    scene : Scene
        Whose domain, units and states they must suit.
    source : path, DataFrame or mapping, optional
        A file as a laboratory writes it (docs/reference/formats.md), or columns by name.
    replicates : {"refuse", "keep", "mean"}, optional
        What becomes of several values at one place (of arrays).
    **columns : array_like
        ``t``, ``z`` and one of ``phi``, ``M`` (cumulative), ``H`` (height of the bed, without z); ``width`` for means over
        bins; ``sigma``, the standard deviation of the noise. In the units of the scene. They broadcast. NaN is missing.

    Returns
    -------
    Observations

    Raises
    ------
    InputError
        With every complaint.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
    >>> sf.data(scene, t=[[0.2], [0.4]], z=[0.1, 0.5, 0.9], M=[[0, 0.05, 0.4], [0, 0.1, 0.41]])
    <6 observations (cumulative), t 0.2 to 0.4>
    """
    if isinstance(source, Observations):
        return source
    if isinstance(source, (str, os.PathLike)):
        if columns:
            raise one_complaint("data", None, "must be a file or columns, not both; read_data says how a file is to be read")
        return read_data(scene, source, replicates=replicates)
    if source is not None:
        if not isinstance(source, Mapping) and not hasattr(source, "columns"):
            raise one_complaint("data", type(source).__name__, "must be a file, a table, columns by name, or come from data()")
        table = source if isinstance(source, Mapping) else {name: source[name] for name in source.columns}
        columns = {**{name: table[name] for name in _COLUMNS if name in table}, **columns}
    unknown = [name for name in columns if name not in _COLUMNS]
    values = [name for name in columns if name in _VALUES]
    if unknown:
        raise one_complaint(unknown[0], None, f"is no column; must be one of: {', '.join(_COLUMNS)}")
    if "t" not in columns or len(values) != 1 or (values != ["H"] and "z" not in columns):
        has = list(columns) if source is None or isinstance(source, Mapping) else list(source.columns)
        shown = f"; has: {', '.join(map(str, has))}" if has else ""
        raise one_complaint("data", None, f"must have t, z and one of phi, M; or t and H{shown}")
    value = values[0]
    quantity = "bin" if value == "phi" and "width" in columns else _VALUES[value]
    given = {name: np.asarray(x, dtype=float) for name, x in columns.items()}
    given.setdefault("z", np.zeros(1))
    arrays = dict(zip(given, np.broadcast_arrays(*given.values()), strict=True))
    width, sigma = (flat(arrays[name]) if name in arrays else None for name in ("width", "sigma"))
    with without_places():
        core = _core.observations(
            scene._engine, quantity, flat(arrays["t"]), flat(arrays["z"]), flat(arrays[value]), width, sigma, replicates
        )
    return Observations(core)


def read_data(
    scene: Scene,
    path: str | os.PathLike[str],
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    separator: str = "",
    decimal: str = "",
    missing: Sequence[str] = (),
    layout: str = "",
    replicates: str = "refuse",
    width: float | None = None,
    time_step: float | None = None,
) -> Observations:
    """Reads a file of observations as a laboratory wrote it.

    Separators, decimal marks, encodings, lines before the header, rows of units, wide tables and averages over chunks of LAMMPS
    are found; what cannot be found is said here.

    Parameters
    ----------
    scene : Scene
        Whose domain, units and states they must suit; lengths and times are converted to its units.
    path : path
    columns : mapping, optional
        Names in the file: ``{"t": "Zeit", "phi": "Konz."}``; of t, z, phi, M, H, width, sigma, phi_large.
    units : mapping, optional
        Units instead of what the header says: ``{"phi": "percent"}``.
    separator : {",", ";", "tab"}, optional
    decimal : {".", ","}, optional
    missing : sequence of str, optional
        Further words for a missing value.
    layout : {"rows", "heights", "times"}, optional
    replicates : {"refuse", "keep", "mean"}, optional
    width : float, optional
        Of the bins that phi is a mean over, in the unit that z has in the file.
    time_step : float, optional
        Of a particle simulation whose file counts steps.

    Returns
    -------
    Observations
        Whose ``notes`` and ``understood`` tell what was found.

    Raises
    ------
    InputError
        With every complaint, each with line and column.

    Examples
    --------
    >>> import shearfront as sf, tempfile, pathlib
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "lab.csv"
    >>> _ = path.write_text("Zeit;Höhe;Konz.\\n0,5;0,25;12\\n0,5;0,75;91\\n", encoding="utf-8")
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
    >>> seen = sf.read_data(scene, path, columns={"t": "Zeit", "z": "Höhe", "phi": "Konz."}, units={"phi": "percent"})
    >>> seen.value
    array([0.12, 0.91])
    """
    core = _core.read_observations(
        os.fspath(path),
        scene._engine,
        list((columns or {}).items()),
        list((units or {}).items()),
        separator,
        decimal,
        list(missing),
        layout,
        replicates,
        width,
        time_step,
    )
    return Observations(core)
