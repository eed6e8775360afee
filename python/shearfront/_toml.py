# SPDX-License-Identifier: BSD-3-Clause
"""Scenes and fits as the text of their files: what is checked is what a file would say."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

Table = dict[str, Any]


def toml_value(value: Any) -> str:
    """A value of a TOML file; numbers with the shortest text that reads back to the same double."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, np.ndarray):
        return toml_value(value.tolist())
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(toml_value(x) for x in value) + "]"
    if hasattr(value, "__array__"):  # a column of a table, a number of another library
        return toml_value(np.asarray(value).tolist())
    raise TypeError(f"{type(value).__name__} is nothing that a scene can hold: {value!r}")


def toml_text(table: Mapping[str, Any]) -> str:
    """The text of a file with these tables; entries that are None are left out."""
    lines: list[str] = []
    _write(table, "", lines)
    return "\n".join(lines) + "\n"


def _write(table: Mapping[str, Any], path: str, lines: list[str]) -> None:
    tables = []
    for key, value in table.items():
        if value is None:
            continue
        if isinstance(value, Mapping) or _is_list_of_tables(value):
            tables.append((key, value))
        else:
            lines.append(f"{_key(key)} = {toml_value(value)}")
    for key, value in tables:
        name = f"{path}{_key(key)}"
        for member in [value] if isinstance(value, Mapping) else value:
            lines.append(f"[{name}]" if isinstance(value, Mapping) else f"[[{name}]]")
            _write(member, name + ".", lines)


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key)


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(x, Mapping) for x in value)


def canonical_tables(text: str) -> Table:
    """The tables of a text that the library wrote: one entry a line, values that JSON reads as well."""
    root: Table = {}
    table = root
    for line in text.splitlines():
        if line.startswith("[["):
            table = {}
            root.setdefault(line[2:-2], []).append(table)
        elif line.startswith("["):
            table = root
            for part in line[1:-1].split("."):
                table = table.setdefault(part, {})
        elif line:
            key, _, value = line.partition(" = ")
            table[key] = json.loads(value)
    return root
