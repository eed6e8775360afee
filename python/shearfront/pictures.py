# SPDX-License-Identifier: BSD-3-Clause
"""Pictures with matplotlib: a function for each, which draws on axes and returns them.

The colours are those of the program's pictures. Every function takes ``ax``, the axes to draw on; new ones are made
unless given.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._arrays import FloatArray
    from ._estimate import Fit
    from ._options import Options
    from ._profile import MisfitProfile
    from ._scene import Scene
    from ._solution import Events, Solution
    from ._tracking import Tracking

#: Okabe and Ito's colours, told apart with every kind of colour vision.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f")
_GREY, _DARK = "#a0a0a0", "#404040"
#: Plasma without its light end: even steps in lightness, readable on white.
PHI = LinearSegmentedColormap.from_list("shearfront", ["#0d0887", "#6a00a8", "#b12a90", "#e16462", "#f0a028"])
#: Jumps up to this are drawn like the fronts of a fan, thin.
_LEAST_SHOCK = 0.15
#: A band that ends beyond so many times the fit is drawn over the logarithm.
_WIDEST = 5
#: A profile over so many times its least value, too.
_WIDE_GRID = 10
_MAP_TIMES, _MAP_HEIGHTS = 300, 400


def profiles(of: Solution, ax: Axes | None = None) -> Axes:
    """Profiles phi(z) of a solution, one line per time.

    Parameters
    ----------
    of : Solution
        With heights in ascending order.
    ax : Axes, optional

    Returns
    -------
    Axes

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> sf.pictures.profiles(scene.solve([0, 0.5, 1])).get_ylabel()
    'z'
    """
    ax = _axes(ax, (4.2, 4.2))
    order = np.argsort(of.z)
    for i, t in enumerate(of.t):
        colour = COLOURS[i % len(COLOURS)] if len(of.t) <= len(COLOURS) else PHI(i / (len(of.t) - 1))
        ax.plot(of.phi[i, order], of.z[order], color=colour, label=f"t = {t:.4g}")
    _interfaces(of.scene, ax)
    _label(ax, of.scene, r"$\varphi$", "z")
    ax.legend(framealpha=0.8, edgecolor="none", fontsize="small")
    return ax


def fronts(of: Tracking, ax: Axes | None = None, *, events: Events | None = None) -> Axes:
    """Fronts in the (t, z) plane, coloured by phi, shocks thick; interfaces are dashed.

    Parameters
    ----------
    of : Tracking
        Advanced to where the picture is to end.
    ax : Axes, optional
    events : Events, optional
        Event times to be marked.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> bed = scene.track(0.05)
    >>> bed.advance(3)
    'ok'
    >>> sf.pictures.fronts(bed, events=scene.events()).get_xlabel()
    't'
    """
    ax = _axes(ax, (6.4, 4.2))
    f = of.fronts()
    low, high = of.scene._engine.range_at(of.scene.bottom)
    lines = np.stack((np.column_stack((f["t_begin"], f["z_begin"])), np.column_stack((f["t_end"], f["z_end"]))), axis=1)
    jumps = np.abs(f["phi_above"] - f["phi_below"]) / (high - low)
    widths = np.where(jumps > _LEAST_SHOCK, 1 + 2 * jumps, 0.5)
    mean = (f["phi_above"] + f["phi_below"]) / 2
    drawn = LineCollection(list(lines), array=mean, cmap=PHI, norm=Normalize(low, high), linewidths=widths)
    ax.add_collection(drawn)
    end = of.time if np.isfinite(of.time) else float(f["t_end"].max(initial=1))
    if events is not None and events.t_star is not None and events.t_star < 1.02 * end:
        end = max(end, events.t_star)
    _interfaces(of.scene, ax)
    for z in (of.scene.bottom, of.scene.top):
        ax.axhline(z, color=_DARK, linewidth=1.5)
    if events is not None:
        _mark(of.scene, events, ax, end)
    margin = 0.03 * (of.scene.top - of.scene.bottom)
    ax.set(xlim=(0, end), ylim=(of.scene.bottom - margin, of.scene.top + margin))
    _label(ax, of.scene, "t", "z")
    ax.figure.colorbar(drawn, ax=ax, label=r"$\varphi$, mean of both sides")
    return ax


def map(of: Scene, until: float, ax: Axes | None = None, *, method: str = "exact", **options: Unpack[Options]) -> Axes:
    """phi over time and height, up to a time.

    Parameters
    ----------
    of : Scene
    until : float
        > 0.
    ax : Axes, optional
    method, **options
        As in :meth:`Scene.solve`.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> sf.pictures.map(scene, 6.5).get_xlabel()
    't'
    """
    ax = _axes(ax, (6.4, 4.2))
    t = (np.arange(_MAP_TIMES) + 0.5) * (until / _MAP_TIMES)
    z = of.bottom + (np.arange(_MAP_HEIGHTS) + 0.5) * ((of.top - of.bottom) / _MAP_HEIGHTS)
    phi = of.solve(t, z, method=method, **options).phi
    low, high = of._engine.range_at(of.bottom)
    image = ax.imshow(
        phi.T, extent=(0, until, of.bottom, of.top), origin="lower", aspect="auto", cmap=PHI, vmin=low, vmax=high,
        interpolation="nearest",
    )  # fmt: skip
    _interfaces(of, ax, "white")
    _label(ax, of, "t", "z")
    ax.figure.colorbar(image, ax=ax, label=r"$\varphi$")
    return ax


def scene(of: Scene, ax: Axes | None = None) -> Axes:
    """s a(z) and phi(z, 0) over height.

    Parameters
    ----------
    of : Scene
    ax : Axes, optional

    Returns
    -------
    Axes
        Those of s a(z); those of phi share its height.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.pictures.scene(sf.Scene(shear_rate=sf.Exponential(4, 0.2), initial=sf.Step(0.5))).get_xlabel()
    's a(z)'
    """
    from ._html import _heights

    ax = _axes(ax, (4.2, 4.2))
    z = _heights(of)
    ax.plot(of.shear_rate(z) * of._engine.scale, z, color=COLOURS[0])
    ax.set_xlim(left=0)
    _label(ax, of, "s a(z)", "z")
    ax.xaxis.label.set_color(COLOURS[0])
    beside = ax.twiny()
    beside.plot(of.initial_phi(z), z, color=COLOURS[1])
    beside.set_xlabel(r"$\varphi(z, 0)$", color=COLOURS[1])
    return ax


def fit(of: Fit, ax: Axes | None = None, *, most_times: int = 6) -> Axes:
    """Data and fit over height, a colour per time.

    Parameters
    ----------
    of : Fit
    ax : Axes, optional
    most_times : int, optional
        Of more times so many are chosen, evenly.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import shearfront as sf
    >>> truth = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = truth.observe([0.2, 0.5, 1], [0.1, 0.3, 0.5, 0.7, 0.9], quantity="cumulative", noise=0.01)
    >>> sf.pictures.fit(sf.fit(truth, seen, ["shear_rate.values"])).get_xlabel()
    'M'
    """
    ax = _axes(ax, (4.6, 4.2))
    seen = of.problem.observations
    if seen.quantity == "bed-height":
        return _fit_of_heights(of, ax)
    times = np.unique(seen.t)
    if len(times) > most_times:
        times = times[np.linspace(0, len(times) - 1, most_times).round().astype(int)]
    z = np.linspace(of.scene.bottom, of.scene.top, 401)
    method = str(of.facts["method"])
    solution = of.scene.solve(times, z, method=method)
    for i, t in enumerate(times):
        colour = COLOURS[i % len(COLOURS)]
        rows = seen.t == t
        ax.plot((solution.M if seen.quantity == "cumulative" else solution.phi)[i], z, color=colour, label=f"t = {t:.4g}")
        error = None if np.isnan(seen.sigma).any() else seen.sigma[rows]
        height = seen.width[rows] / 2 if seen.quantity == "bin" else None
        ax.errorbar(seen.value[rows], seen.z[rows], xerr=error, yerr=height, fmt="o", ms=3, color=colour, lw=0.8)
    _interfaces(of.scene, ax)
    _label(ax, of.scene, "M" if seen.quantity == "cumulative" else r"$\varphi$", "z")
    ax.legend(framealpha=0.8, edgecolor="none", fontsize="small")
    return ax


def _fit_of_heights(of: Fit, ax: Axes) -> Axes:
    seen = of.problem.observations
    t = np.linspace(0, seen.t.max(), 200)
    ax.plot(t, of.scene.bed(t, method=str(of.facts["method"]))["height"], color=COLOURS[0], label="fit")
    ax.errorbar(
        seen.t, seen.value, yerr=None if np.isnan(seen.sigma).any() else seen.sigma, fmt="o", ms=3, color=COLOURS[1], lw=0.8,
        label="data",
    )  # fmt: skip
    _label(ax, of.scene, "t", "H")
    ax.legend(framealpha=0.8, edgecolor="none", fontsize="small")
    return ax


def rate(of: Fit, ax: Axes | None = None, *, truth: Scene | None = None) -> Axes:
    """s a(z) of a fit with its 95 % band.

    Parameters
    ----------
    of : Fit
    ax : Axes, optional
    truth : Scene, optional
        To draw its s a(z) as well.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import shearfront as sf
    >>> truth = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = truth.observe([0.2, 0.5, 1], [0.1, 0.3, 0.5, 0.7, 0.9], quantity="cumulative", noise=0.01)
    >>> sf.pictures.rate(sf.fit(truth, seen, ["shear_rate.values"]), truth=truth).get_xlabel()
    's a(z)'
    """
    from ._html import _heights

    ax = _axes(ax, (4.2, 4.2))
    band = of.rate_band()
    if np.isfinite(band.lower).any():
        ax.fill_betweenx(band.z, band.lower, band.upper, color=COLOURS[0], alpha=0.25, linewidth=0, label="95 %")
    ax.plot(band.a, band.z, color=COLOURS[0], label="fit")
    if truth is not None:
        z = _heights(truth)
        ax.plot(truth.shear_rate(z) * truth._engine.scale, z, color=COLOURS[1], linestyle="--", label="truth")
    if np.nanmax(band.upper, initial=band.a.max()) > _WIDEST * band.a.max():
        ax.set_xscale("log")
    else:
        ax.set_xlim(left=0)
    _label(ax, of.scene, "s a(z)", "z")
    ax.legend(framealpha=0.8, edgecolor="none", fontsize="small")
    return ax


def misfit(of: MisfitProfile, ax: Axes | None = None) -> Axes:
    """The least misfit along one unknown, or along two, with the region that holds both in 95 % (and in 68 %).

    Parameters
    ----------
    of : MisfitProfile
        From :meth:`Fit.profile_curve` or :meth:`Fit.profile_surface`.
    ax : Axes, optional

    Returns
    -------
    Axes

    Examples
    --------
    >>> import shearfront as sf
    >>> truth = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = truth.observe([0.2, 0.5, 1], [0.1, 0.3, 0.5, 0.7, 0.9], quantity="cumulative", noise=0.01)
    >>> found = sf.fit(truth, seen, ["shear_rate.values"])
    >>> sf.pictures.misfit(found.profile_curve("shear_rate.values[0]", points=9)).get_xlabel()
    'shear_rate.values[0]'
    """
    ax = _axes(ax, (4.2, 3.4) if len(of.names) == 1 else (4.2, 3.8))
    ax.set_xlabel(of.names[0])
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    for values, set_scale in zip(of.grid, (ax.set_xscale, ax.set_yscale), strict=False):
        if values.min() > 0 and values.max() > _WIDE_GRID * values.min():
            set_scale("log")
    if ax.get_xscale() == "linear":
        ax.locator_params(axis="x", nbins=5)
    if len(of.names) == 1:
        ax.plot(of.grid[0], of.increase, color=COLOURS[0])
        ax.axhline(of.level, color=_GREY, linestyle="--", linewidth=0.8)
        ax.annotate(
            "95 %", (0.99, of.level), xycoords=("axes fraction", "data"), va="bottom", ha="right", color=_DARK, fontsize="small"
        )
        ax.plot(of.estimates[0], 0, "o", ms=5, color=_DARK, clip_on=False, zorder=5)
        ax.set_ylabel("least misfit above its minimum")
        ax.set_ylim(0, 2.5 * of.level)
        return ax
    levels = (of.level * np.log(1 - 0.68) / np.log(1 - 0.95), of.level)
    lines = ax.contour(*of.grid, of.increase.T, levels=levels, colors=(COLOURS[5], COLOURS[0]))
    ax.clabel(lines, fmt=dict(zip(lines.levels, ("68 %", "95 %"), strict=True)), fontsize="small")
    ax.plot(*of.estimates, "o", ms=5, color=_DARK)
    ax.set_ylabel(of.names[1])
    return ax


class _HasUnits(Protocol):
    @property
    def units(self) -> dict[str, str]: ...


def _axes(ax: Axes | None, size: tuple[float, float]) -> Axes:
    if ax is not None:
        return ax
    _, made = plt.subplots(figsize=size, layout="constrained")
    return made


def _label(ax: Axes, of: _HasUnits, x: str, y: str) -> None:
    def with_unit(name: str) -> str:
        unit = of.units.get({"H": "z", "M": "z"}.get(name, name))
        return f"{name} ({unit})" if unit else name

    ax.set_xlabel(with_unit(x))
    ax.set_ylabel(with_unit(y))
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)


def _interfaces(of: Scene, ax: Axes, colour: str = _GREY) -> None:
    knots: FloatArray = of._engine.knots
    for z in knots if len(knots) <= 20 else ():
        ax.axhline(z, color=colour, linestyle="--", linewidth=0.8)


def _mark(of: Scene, events: Events, ax: Axes, end: float) -> None:
    marks = [("$t_0$", events.t0, of.bottom), ("$t_1$", events.t1, of.top)]
    marks += [("$t_c$", i.first, i.z) for i in events.interfaces] + [(r"$\hat t_c$", i.last, i.z) for i in events.interfaces]
    marks.append(("$t^*$", events.t_star, events.steady_height))
    for text, t, z in marks:
        if t is not None and t <= end:
            ax.plot(t, z, "o", ms=5, color=_DARK, zorder=5, clip_on=False)
            below = z == of.top
            ax.annotate(text, (t, z), xytext=(4, -12 if below else 5), textcoords="offset points", zorder=6)
