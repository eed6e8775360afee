# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a scene as the tables of its file, and how they are shown."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ._callables import initial_table, sampled, table_of
from ._errors import one_complaint
from ._models import Model, Pieces, model_of, short_number
from ._toml import Table

#: The parts that are functions of height.
DEPTH_FUNCTIONS = ("shear_rate", "solid_fraction", "temperature")


def table_of_part(part: Any) -> Any:
    """A model as its table; what is a table already, as it is."""
    return part.to_dict() if isinstance(part, Model) else part


def initial_part(part: Any, ends: tuple[float, float]) -> Any:
    """The table of an initial state; functions are sampled."""
    if callable(part):
        return initial_table(part, ends).to_dict()
    if isinstance(part, (Model, Mapping)):
        return table_of_part(part)
    return Pieces(
        [], [_number("initial", part, "a model such as Step or Pieces, a table, a function of z or a number")]
    ).to_dict()


def ends_of(domain: Any) -> tuple[float, float]:
    """Bottom and top; 0 and 1 unless given."""
    if domain is None:
        return 0.0, 1.0
    if isinstance(domain, Mapping):
        return float(domain.get("bottom", 0)), float(domain.get("top", 1))
    try:
        bottom, top = domain
        return float(bottom), float(top)
    except (TypeError, ValueError):
        raise one_complaint("domain", repr(domain), "must be a pair (bottom, top)") from None


def depth_table(key: str, part: Any, ends: tuple[float, float]) -> Any:
    """The table of a function of height; functions are sampled, a number is constant."""
    if part is None or isinstance(part, (Model, Mapping)):
        return table_of_part(part)
    if callable(part):
        return table_of(part, *ends).to_dict()
    value = _number(key, part, "a model such as Piecewise or Exponential, a table, a function of z or a number")
    return {"model": "piecewise", "breaks": [], "values": [value]}


def velocity_table(part: Any) -> Any:
    """The table of a velocity; a number is the same at every height."""
    if part is None or isinstance(part, (Model, Mapping)):
        return table_of_part(part)
    return {"model": "uniform", "value": _number("velocity", part, "a model such as LinearVelocity, a table or a number")}


def slab_table(part: Any) -> Any:
    """The table of a slab; a number is its length."""
    if part is None or isinstance(part, Mapping):
        return part
    return {"length": _number("slab", part, "a number, its length, or a table")}


def diffusion_table(part: Any) -> Any:
    """The table of diffusion; a number is D."""
    if part is None or isinstance(part, Mapping):
        return part
    return {"D": _number("diffusion", part, "a number or a table")}


def _number(key: str, part: Any, allowed: str) -> float:
    try:
        return float(part)
    except (TypeError, ValueError):
        raise one_complaint(key, repr(part), f"must be {allowed}") from None


def flux_tables(part: Any) -> Any:
    """The table of a flux, or those of several: pairs (above, flux) over the lowest."""
    if isinstance(part, str):
        return {"model": part}
    if callable(part):
        return sampled(part, kind="flux").model.to_dict()
    if not isinstance(part, (list, tuple)):
        return table_of_part(part)
    tables = []
    for i, member in enumerate(part):
        above: dict[str, Any] = {}
        if i > 0:
            try:
                height, member = member
                above = {"above": float(height)}
            except (TypeError, ValueError):
                raise one_complaint(f"flux[{i}]", repr(member), "must be a pair (height above which it holds, flux)") from None
        tables.append({**flux_tables(member), **above})
    return tables


def replace_entry(tables: Table, path: str, keys: list[str], value: Any) -> None:
    """Puts a value in the place of tables["a"]["b"][0] for a__b__0."""
    place: Any = tables
    for i, key in enumerate(keys):
        is_last = i + 1 == len(keys)
        index: Any = int(key) if isinstance(place, list) and key.isdigit() else key
        known = index < len(place) if isinstance(place, list) and isinstance(index, int) else not is_last and index in place
        if not is_last and not known:
            raise one_complaint(path, None, "is no entry of the scene")
        if is_last:
            try:
                place[index] = table_of_part(value)
            except (TypeError, IndexError):
                raise one_complaint(path, None, "is no entry of the scene") from None
        else:
            place = place[index]


def shown_parts(tables: Table) -> list[tuple[str, str]]:
    """What a scene shows of itself: its parts but for those at their defaults."""
    shown = [("name", repr(tables["name"]))] if tables["name"] not in ("", "scene") else []
    fluxes = tables["flux"]
    if isinstance(fluxes, list):
        above = [f"({short_number(f['above'])}, {model_of('flux', f)!r})" for f in fluxes[1:]]
        shown.append(("flux", f"[{', '.join([repr(model_of('flux', fluxes[0])), *above])}]"))
    elif fluxes != {"model": "quadratic"}:
        shown.append(("flux", repr(model_of("flux", fluxes))))
    for key in DEPTH_FUNCTIONS:
        if key in tables:
            shown.append((key, repr(model_of("depth", tables[key]))))
        if key == "shear_rate" and tables[key].get("scale", 1) != 1:
            shown.append(("scale", short_number(tables[key]["scale"])))
    initial = tables["initial"]
    if initial.get("model") == "block":
        shown.append(("initial", repr(initial)))
    else:
        start = model_of("start", initial) if "model" in initial else Pieces(**initial)
        shown.append(("initial", repr(start)))
    if "velocity" in tables:
        shown.append(("velocity", repr(model_of("velocity", tables["velocity"]))))
    if "close_packing" in tables:
        shown.append(("close_packing", repr(model_of("close_packing", tables["close_packing"]))))
    if tables["domain"] != {"bottom": 0, "top": 1}:
        shown.append(("domain", f"({', '.join(short_number(x) for x in tables['domain'].values())})"))
    shown += [(key, repr(tables[key])) for key in ("diffusion", "slab", "boundary", "units") if key in tables]
    return shown
