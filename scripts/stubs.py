# SPDX-License-Identifier: BSD-3-Clause
"""Writes what type checkers and editors read: the classes of models and the options of methods, from the library's lists.

python scripts/stubs.py          writes _models.pyi and _options.py in python/shearfront
python scripts/stubs.py --check  fails if they are not what the library has
"""

from __future__ import annotations

import sys
from pathlib import Path

from shearfront import _core, _models

PACKAGE = Path(__file__).resolve().parents[1] / "python" / "shearfront"
HEAD = "# SPDX-License-Identifier: BSD-3-Clause\n# Written by scripts/stubs.py from the lists of the library; not to be edited.\n"


def model_class(name: str, cls: type[_models.Model]) -> str:
    """The stub of a class of models."""
    attributes, arguments = [], []
    model = next(m for m in _core.models()[cls.list_name] if m["name"] == cls.model_name)
    for field in _models.fields_of(model):
        kind = "tuple[float, ...]" if field["is_array"] else "float"
        attributes.append(f"    {field['key']}: {kind}\n")
        given = "ArrayLike" if field["is_array"] else "float"
        arguments.append(f"{field['key']}: {given}" + (" = ..." if field["is_optional"] else ""))
    for key, names, _ in model["choices"]:
        kind = f"Literal[{', '.join(repr(n) for n in names)}]".replace("'", '"')
        attributes.append(f"    {key}: {kind}\n")
        arguments.append(f"{key}: {kind} = ...")
    init = f"    def __init__(self{''.join(', ' + a for a in arguments)}) -> None: ...\n"
    return f"class {name}(Model):\n{''.join(attributes)}{init}\n"


def models_stub() -> str:
    """_models.pyi."""
    imports = "from typing import Any, ClassVar, Literal\n\nfrom numpy.typing import ArrayLike\n\n"
    base = """class Model:
    model_name: ClassVar[str]
    list_name: ClassVar[str]
    formula: ClassVar[str]
    entry_names: ClassVar[tuple[str, ...]]
    def __init__(self, *values: Any, **entries: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]: ...

class Pieces(Model):
    breaks: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, breaks: ArrayLike, values: ArrayLike) -> None: ...

def Step(height: float, below: float = ..., above: float = ...) -> Pieces: ...

"""
    classes = "".join(model_class(name, _models.MODELS[name]) for name in sorted(_models.MODELS))
    rest = """MODELS: dict[str, type[Model]]

def model_of(list_name: str, table: dict[str, Any]) -> Model | None: ...
def fields_of(model: dict[str, Any]) -> list[dict[str, Any]]: ...
def short_number(x: float) -> str: ...

"""
    names = "".join(f'    "{name}",\n' for name in ["Model", "Pieces", "Step", *sorted(_models.MODELS)])
    return f"{HEAD}{imports}{base}{classes}{rest}__all__ = [\n{names}]\n"


def options_module() -> str:
    """_options.py."""
    types = {"N": "int", "X": "float", "": "bool"}
    found: dict[str, str] = {}
    solvers: dict[str, dict[str, list[str]]] = {}  # of each option, by what it says
    for method in _core.methods():
        for name, kind, sentence, allowed, _ in method["options"]:
            key = name.replace("-", "_")
            found[key] = types.get(kind) or "Literal[" + ", ".join(f'"{k}"' for k in kind.split("|")) + "]"
            says = sentence + (f", {allowed}" if allowed else "")
            solvers.setdefault(key, {}).setdefault(says, []).append(method["name"])
    lines = []
    for key, kind in found.items():
        says = [f"{sentence} ({', '.join(names)})" for sentence, names in solvers[key].items()]
        text = "\n\n    ".join(says)
        lines.append(f'    {key}: {kind}\n    """{text}."""\n')
    doc = '"""Options of methods as keyword arguments, for type checkers and editors."""\n\n'
    imports = "from __future__ import annotations\n\nfrom typing import Literal, TypedDict\n\n\n"
    body = 'class Options(TypedDict, total=False):\n    """Every option of every method; each method takes its own."""\n\n'
    return HEAD + doc + imports + body + "".join(lines)


def main() -> int:
    """Writes or checks."""
    status = 0
    for name, text in (("_models.pyi", models_stub()), ("_options.py", options_module())):
        path = PACKAGE / name
        if "--check" not in sys.argv:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            print(f"{path} is not what the library has: run python scripts/stubs.py", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
