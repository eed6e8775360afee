# SPDX-License-Identifier: BSD-3-Clause
"""The package as a whole: examples, types, stubs, pictures, import."""

from __future__ import annotations

import ast
import doctest
import importlib
import inspect
import pkgutil
import subprocess
import sys

import numpy as np
import pytest
from conftest import SOURCE

import shearfront as sf

MODULES = [f"shearfront.{m.name}" for m in pkgutil.iter_modules(sf.__path__) if m.name != "_core"]


@pytest.mark.parametrize("name", ["shearfront", *MODULES])
def test_examples(name: str) -> None:
    if name.endswith("pictures"):
        pytest.importorskip("matplotlib").use("Agg")
    needs = {
        "_misfit": ["scipy"],
        "_fit": ["scipy"],
        "_smooth": ["scipy"],
        "_scene": ["matplotlib"],
        "_tracking": ["matplotlib"],
        "_data": ["pandas"],
        "_study": ["pandas"],
    }
    needs |= {"_solution": ["pandas", "xarray", "matplotlib"], "_estimate": ["pandas", "matplotlib"]}
    for extra in needs.get(name.removeprefix("shearfront."), []):
        pytest.importorskip(extra)
    if "matplotlib" in sys.modules:
        sys.modules["matplotlib"].use("Agg")
    result = doctest.testmod(importlib.import_module(name))
    assert result.failed == 0


def test_everything_public_has_an_example() -> None:
    results = {"Complaint", "Model", "pictures"}
    for name in sf.__all__:
        thing = getattr(sf, name)
        assert thing.__doc__, name
        is_model = isinstance(thing, type) and issubclass(thing, sf.Model)
        assert is_model or name in results or ">>>" in thing.__doc__, name
        methods = [m for m in vars(thing).items() if isinstance(thing, type) and inspect.isfunction(m[1])] if not is_model else []
        for key, method in methods:
            if not key.startswith("_") and key != "to_arviz":
                assert ">>>" in (method.__doc__ or ""), f"{name}.{key}"


def run(*command: str) -> None:
    done = subprocess.run([sys.executable, *command], capture_output=True, text=True, cwd=SOURCE, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_are_what_the_library_has() -> None:
    run("scripts/stubs.py", "--check")


def test_the_stub_of_the_engines_names_what_is_there() -> None:
    from shearfront import _core

    stub = ast.parse((SOURCE / "python" / "shearfront" / "_core.pyi").read_text(encoding="utf-8"))
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    there = {name: value for name, value in vars(_core).items() if not name.startswith("_")}
    assert functions | set(classes) == set(there)
    for name, node in classes.items():
        members = {m.name for m in node.body if isinstance(m, ast.FunctionDef)} - {"__init__"}
        assert members == {m for m in vars(there[name]) if not m.startswith("_")}, name


def test_types() -> None:
    pytest.importorskip("mypy")
    run("-m", "mypy", "python/shearfront")


def test_style() -> None:
    pytest.importorskip("ruff")
    run("-m", "ruff", "check", "--no-cache", "python", "scripts/stubs.py")
    run("-m", "ruff", "format", "--no-cache", "--check", "python", "scripts/stubs.py")


def test_options_are_spelt_out_for_completion() -> None:
    options = {name for method in sf.methods().values() for name in method["options"]}
    for function in (sf.Scene.solve, sf.Scene.phi, sf.Scene.observe, sf.study, sf.problem, sf.fit):
        parameters = inspect.signature(function).parameters
        assert options <= set(parameters), function.__name__
        assert all(p.kind is not p.VAR_KEYWORD for p in parameters.values())
    assert {"start", "algorithm", "bootstrap"} <= set(inspect.signature(sf.fit).parameters)
    assert "resolution" in inspect.signature(sf.Scene.track).parameters


def test_only_numpy_is_needed() -> None:
    code = "import sys, shearfront as sf; sf.Scene(shear_rate=1, initial=sf.Step(.5)).solve(1)\n"
    code += "bad = {'pandas', 'xarray', 'matplotlib', 'scipy', 'arviz'} & set(sys.modules); assert not bad, bad"
    run("-c", code)


def test_pictures(may: sf.Scene) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("Agg")
    bed = may.track(0.05)
    bed.advance(2)
    bins = may.observe([0.5, 1], np.linspace(0.1, 0.9, 9), quantity="bin", width=0.1, noise=0.01)
    heights = may.observe(np.linspace(0.1, 6, 30), quantity="bed-height", noise=1e-4)
    found = sf.fit(may, bins, "shear_rate.values[1]")
    drawn = [
        sf.pictures.profiles(may.solve([0, 1])),
        sf.pictures.fronts(bed, events=may.events()),
        sf.pictures.map(may, 2.0),
        sf.pictures.scene(may),
        sf.pictures.fit(found),
        sf.pictures.fit(sf.fit(may, heights, "shear_rate.values[1]")),
        sf.pictures.rate(found, truth=may),
    ]
    for ax in drawn:
        assert ax.get_xlabel()
        assert ax.get_ylabel()
        ax.figure.canvas.draw()
    assert len(drawn[1].collections[0].get_segments()) == len(bed.fronts())
    _, given = pyplot.subplots()
    assert may.solve([1]).plot(given) is given
    pyplot.close("all")


@pytest.mark.parametrize(
    "name", ["docs/tutorials/python.md", "docs/tutorials/own-flux.md", "docs/how-to/in-python.md", "README.md"]
)
def test_pages(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs the blocks ```python of a page in one session."""
    if name.startswith("docs"):
        for module in ("pandas", "xarray", "scipy"):
            pytest.importorskip(module)
        pytest.importorskip("matplotlib").use("Agg")
    monkeypatch.chdir(SOURCE)
    in_code, code = False, []
    for line in (SOURCE / name).read_text(encoding="utf-8").splitlines():
        if line.startswith("```"):
            in_code = line == "```python"
        elif in_code:
            code.append(line)
    example = doctest.DocTestParser().get_doctest("\n".join(code), {"__name__": "__page__"}, name, name, 0)
    result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(example)
    assert result.attempted > 4
    assert result.failed == 0


def test_the_notebook_of_the_paper(monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs the cells, which scripts/docs runs in a kernel: twenty lines, and the numbers that the paper prints."""
    pytest.importorskip("pandas")
    pytest.importorskip("matplotlib").use("Agg")
    page = (SOURCE / "docs" / "tutorials" / "paper-tables.md").read_text(encoding="utf-8")
    cells = [part.partition("```")[0] for part in page.split("```{code-cell} ipython3\n")[1:]]
    lines = [line for cell in cells for line in cell.splitlines() if line and not line.startswith("%%")]
    assert len(lines) <= 20
    found: dict[str, object] = {}
    exec(compile("\n".join(lines), "paper-tables.md", "exec"), found)
    for delta, row in (
        (0.1, [1.0502, 1.1772, 2.4998, 3.9503, 5.0000]),
        (0.01, [0.6788, 0.8000, 1.6145, 4.9378, 6.2500]),
        (1e-4, [0.6778, 0.7990, 1.6133, 5.0043, 6.4516]),
        (5e-5, [0.6777, 0.7989, 1.6130, 5.0055, 6.4516]),
    ):
        np.testing.assert_allclose(found["rows"][delta], row, rtol=2e-3)
    errors = found["errors"][found["errors"]["method"] == "front-tracking"]["l1_error"].reshape(4, 2)
    paper = np.array([[6.52e-3, 3.26e-2], [2.80e-3, 2.54e-3], [6.87e-4, 2.54e-3], [3.69e-4, 1.48e-3]])
    assert np.all(errors < 1.02 * paper), "as small as those of the paper"
    assert np.all(errors > 0.75 * paper)
    assert np.abs(found["found"].estimates - [3.25, 2.32, 1.63, 1.05, 0.53]).sum() < 0.204, "the best sum of errors of the paper"
