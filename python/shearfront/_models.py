# SPDX-License-Identifier: BSD-3-Clause
"""A class for every model of the library, made from the library's own lists.

Nothing is written twice: names, entries, defaults and formulas are those of the C++ lists, so a model that is
added there has its class here.
"""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from . import _core

#: What the classes of a list are called beside the names of their models.
_PREFIX = {"depth": "", "flux": "", "start": "", "velocity": "", "close_packing": "Packing"}
_SUFFIX = {"depth": "", "flux": "", "start": "Initial", "velocity": "Velocity", "close_packing": ""}
_WHAT = {
    "depth": "a function of height, for shear_rate, solid_fraction, temperature or the variation of diffusion",
    "flux": "a flux f(phi)",
    "start": "a smooth initial state phi(z, 0) / c(z)",
    "velocity": "a velocity u(z) along the slope, of a steady chute or a slab",
    "close_packing": "a law of random close packing, for the height of the bed",
}
_MEASURE = {"number": "", "height": ", in the unit of z", "state": ", in the unit of phi", "flux": ", a value of f"}


class Model:
    """A part of a scene with its entries.

    The subclasses are made from the lists of the library; ``to_dict`` gives the table of a scene file.
    """

    model_name: ClassVar[str] = ""
    list_name: ClassVar[str] = ""
    formula: ClassVar[str] = ""
    entry_names: ClassVar[tuple[str, ...]] = ()
    _optional: ClassVar[dict[str, Any]] = {}
    _arrays: ClassVar[frozenset[str]] = frozenset()

    def __init__(self, *values: Any, **entries: Any) -> None:
        cls = type(self)
        if len(values) > len(cls.entry_names):
            raise TypeError(f"{cls.__name__} takes {len(cls.entry_names)} entries but {len(values)} were given")
        given = dict(zip(cls.entry_names, values, strict=False))
        for name, value in entries.items():
            if name not in cls.entry_names:
                raise TypeError(f"{cls.__name__} has no entry {name!r}; it has: {', '.join(cls.entry_names) or 'none'}")
            if name in given:
                raise TypeError(f"{cls.__name__} got {name!r} twice")
            given[name] = value
        for name in cls.entry_names:
            if name not in given and name not in cls._optional:
                raise TypeError(f"{cls.__name__} needs {name!r}")
            value = given.get(name, cls._optional.get(name))
            self.__dict__[name] = _plain(value, name in cls._arrays)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} cannot be changed; make another one")

    def to_dict(self) -> dict[str, Any]:
        """The entries as a table of a scene file."""
        table: dict[str, Any] = {"model": self.model_name} if self.model_name else {}
        for name in self.entry_names:
            value = self.__dict__[name]
            table[name] = list(value) if isinstance(value, tuple) else value
        return table

    def __repr__(self) -> str:
        shown: list[str] = []
        for name in self.entry_names:
            value = self.__dict__[name]
            if name in self._optional and value == self._optional[name]:
                continue
            text = _short(value)
            in_order = len(shown) == self.entry_names.index(name) and not any("=" in s for s in shown)
            shown.append(text if in_order else f"{name}={text}")
        return f"{type(self).__name__}({', '.join(shown)})"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self.__dict__ == other.__dict__

    def __hash__(self) -> int:
        return hash((type(self), tuple(self.__dict__.items())))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), tuple(self.__dict__.values())


def _plain(value: Any, is_array: bool) -> Any:
    """Numbers as floats, arrays as tuples of them: immutable."""
    if isinstance(value, (str, bool)) or value is None:
        return value
    if is_array:
        return tuple(np.atleast_1d(np.asarray(value, dtype=float)).tolist())
    return float(value)


def short_number(x: float) -> str:
    """The shortest text that reads back to the same number."""
    return repr(float(x)).removesuffix(".0")


def _short(value: Any) -> str:
    if isinstance(value, float):
        return short_number(value)
    if isinstance(value, tuple):
        if len(value) > 8:
            return f"<{len(value)} numbers from {value[0]:.6g} to {value[-1]:.6g}>"
        return "[" + ", ".join(map(short_number, value)) + "]"
    return repr(value)


def _camel(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("-"))


def _docstring(list_name: str, model: dict[str, Any]) -> str:
    what = _WHAT[list_name]
    lines = [f"{model.get('formula', model['name'])}: {what}.", ""]
    if states := model.get("states"):
        lines += [f"States: {states}.", ""]
    lines += [f'In scene files: ``model = "{model["name"]}"``.', ""]
    if model["fields"] or model["choices"]:
        lines += ["Parameters", "----------"]
    for field in fields_of(model):
        kind = "array_like of float" if field["is_array"] else "float"
        default = f", default {field['initial']:.12g}" if field["is_optional"] and "initial" in field else ""
        lines.append(f"{field['key']} : {kind}{', optional' if field['is_optional'] else ''}")
        lines.append(f"    {'> 0' if field['is_positive'] else 'Any sign'}{_MEASURE[field['measure']]}{default}.")
    for key, names, initial in model["choices"]:
        lines += [f"{key} : {{{', '.join(repr(n) for n in names)}}}, optional", f"    Default {initial!r}."]
    return "\n".join(lines)


def fields_of(model: dict[str, Any]) -> list[dict[str, Any]]:
    """The entries in the order of arguments: those that may be left out come last."""
    return sorted(model["fields"], key=lambda field: bool(field["is_optional"]))


def _make(list_name: str, model: dict[str, Any], name: str) -> type[Model]:
    fields = fields_of(model)
    optional = {f["key"]: None if f["is_array"] else f["initial"] for f in fields if f["is_optional"]}
    optional |= {key: initial for key, _, initial in model["choices"]}
    entries = tuple(f["key"] for f in fields) + tuple(c[0] for c in model["choices"])
    arrays = frozenset(f["key"] for f in fields if f["is_array"])
    members = {
        "__doc__": _docstring(list_name, model),
        "__module__": "shearfront",
        "model_name": model["name"],
        "list_name": list_name,
        "formula": model.get("formula", ""),
        "entry_names": entries,
        "_optional": optional,
        "_arrays": arrays,
    }
    return type(name, (Model,), members)


def _make_all() -> dict[str, type[Model]]:
    classes: dict[str, type[Model]] = {}
    for list_name in ("depth", "flux", "start", "velocity", "close_packing"):
        for model in _core.models()[list_name]:
            name = _PREFIX[list_name] + _camel(model["name"]) + _SUFFIX[list_name]
            if name in classes:  # a table of fluxes beside one of heights
                name = _camel(list_name) + name
            classes[name] = _make(list_name, model, name)
    return classes


#: Every class by its name.
MODELS = _make_all()


def model_of(list_name: str, table: dict[str, Any]) -> Model | None:
    """The model that a table of a scene file describes; None for one of another kind."""
    for cls in MODELS.values():
        if cls.list_name == list_name and cls.model_name == table.get("model"):
            return cls(**{k: v for k, v in table.items() if k in cls.entry_names})
    return None


class Pieces(Model):
    """An initial state that is constant in pieces.

    Parameters
    ----------
    breaks : array_like of float
        Heights of the jumps, ascending, inside the domain, in the unit of z; may be empty.
    values : array_like of float
        phi / c from the bottom up, one more than breaks.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.Pieces([0.2, 0.5], [0, 0.8, 0.3])
    Pieces([0.2, 0.5], [0, 0.8, 0.3])
    """

    list_name = "start"
    entry_names = ("breaks", "values")
    _arrays = frozenset(("breaks", "values"))

    breaks: tuple[float, ...]
    values: tuple[float, ...]


def Step(height: float, below: float = 0.0, above: float = 1.0) -> Pieces:
    """An initial state with a single jump: large grains below small ones, unless said otherwise.

    Parameters
    ----------
    height : float
        Where it jumps, in the unit of z.
    below, above : float, optional
        phi on both sides; 0 and 1.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.Step(0.5)
    Pieces([0.5], [0, 1])
    """
    return Pieces([height], [below, above])


globals().update(MODELS)
__all__ = ["Model", "Pieces", "Step", *sorted(MODELS)]
