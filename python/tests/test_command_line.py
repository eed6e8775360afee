# SPDX-License-Identifier: BSD-3-Clause
"""The same numbers as the program, to the bit, over all data sets."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest
from conftest import SOURCE

import shearfront as sf

DATASETS = SOURCE / "datasets"
SCENES = sorted(p for p in DATASETS.glob("*/scene*.toml"))
#: Folders and files whose fits take seconds.
SLOW = ("dem-", "traffic-us-101", "may-2010-diffusion", "may-2010-bed-height/fit-noise", "paper-example-5/fit-paper")


def ident(path: Path) -> str:
    return str(path.relative_to(DATASETS))


FITS = [
    pytest.param(path, marks=[pytest.mark.slow] if ident(path).startswith(SLOW) else [])
    for path in sorted(DATASETS.glob("*/fit*.toml"))
]


def test_there_are_data_sets() -> None:
    assert len(SCENES) > 20
    assert len(FITS) > 10


def method_for(scene: sf.Scene) -> str:
    for name in ("exact", "front-tracking", "crank-nicolson"):
        try:
            scene.solve([0.1], [scene.bottom], method=name)
        except sf.NoResult:
            continue
        return name
    raise AssertionError("no method solves it")


@pytest.mark.parametrize("path", [p for p in SCENES if "[slab]" not in p.read_text()], ids=ident)
def test_solve(path: Path, run) -> None:
    scene = sf.read(path)
    method = method_for(scene)
    heights = np.linspace(scene.bottom, scene.top, 9)
    times = [0.25, 1.5]
    lists = [",".join(repr(float(x)) for x in xs) for xs in (times, heights)]
    text = run("solve", str(path), "--times", lists[0], "--heights", lists[1], "--method", method, "--json")
    expected = json.loads(text)
    found = scene.solve(times, heights, method=method)
    assert expected["depths"] == found.z.tolist()
    assert expected["phi"] == found.phi.tolist()
    assert expected["M"] == found.M.tolist()


@pytest.mark.parametrize("path", SCENES, ids=ident)
def test_events(path: Path, run, refuses) -> None:
    scene = sf.read(path)
    found = {}
    for method in ("exact", "front-tracking"):
        try:
            found[method] = scene.events(method=method)
        except (sf.InputError, sf.NoResult):
            assert refuses("events", str(path), "--method", method, "--json")
    for method, events in found.items():
        same_events(json.loads(run("events", str(path), "--method", method, "--json")), events)


def same_events(expected: dict[str, object], events: sf.Events) -> None:
    along = "x" if "x_star" in expected else "t"  # of a steady chute
    for key in ("mass", "steady_height"):
        assert expected[key] == getattr(events, key), key
    for which in ("0", "1", "_star"):
        assert expected[along + which] == getattr(events, "t" + which), which
    assert expected["interfaces"] == [{"z": i.z, "first": i.first, "last": i.last} for i in events.interfaces]


def same(expected: object, found: object, path: str = "") -> None:
    """Equal to the bit; null stands for what is not finite."""
    if isinstance(expected, dict):
        assert isinstance(found, dict)
        assert set(expected) == set(found), path
        for key in expected:
            if key != "wall_s":
                same(expected[key], found[key], f"{path}.{key}")
    elif isinstance(expected, list):
        assert isinstance(found, list)
        assert len(expected) == len(found), path
        for i, (e, f) in enumerate(zip(expected, found, strict=True)):
            same(e, f, f"{path}[{i}]")
    elif expected is None:
        assert found is None or not math.isfinite(found), path
    else:
        assert expected == found, path


@pytest.mark.parametrize("path", FITS, ids=ident)
def test_fit(path: Path, run) -> None:
    expected = json.loads(run("fit", str(path), "--json"))
    same(expected, sf.fit(path).to_dict())


def test_observe(run, may: sf.Scene, tmp_path: Path) -> None:
    may.save(tmp_path / "scene.toml")
    text = run(
        "observe", str(tmp_path / "scene.toml"), "--times", "0.5,1", "--depths", "0.2,0.6", "--quantity", "cumulative",
        "--noise", "0.02", "--seed", "7",
    )  # fmt: skip
    rows = [line for line in text.splitlines() if not line.startswith("#")]
    seen = may.observe([0.5, 1], [0.2, 0.6], quantity="cumulative", noise=0.02, seed=7)
    assert seen.to_csv().splitlines() == rows


def test_predict_and_band(run, tmp_path: Path) -> None:
    path = DATASETS / "paper-example-3" / "fit.toml"
    files = [str(tmp_path / name) for name in ("samples.csv", "band.csv", "prediction.csv")]
    places = ("--times", "0.5,2", "--heights", "0.1,0.5,0.9")
    run("fit", str(path), "--predict", files[2], *places, "--band", files[1])
    run("solve", str(path), *places, "-o", files[0])
    found = sf.fit(path)
    expected = np.genfromtxt(files[0], delimiter=",", names=True)
    table = found.predict([0.5, 2], [0.1, 0.5, 0.9]).to_dataframe()
    for name in table.columns:
        np.testing.assert_array_equal(expected[name], table[name].to_numpy(), err_msg=name)
    with open(files[2], encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    phi = [float(row["upper"]) for row in rows if row["quantity"] == "phi"]
    np.testing.assert_array_equal(phi, table.upper.to_numpy())
    (t_star,) = [row for row in rows if row["quantity"] == "t*"]
    assert (float(t_star["lower"]), float(t_star["upper"])) == found.predict_events()["t_star"]
    band = np.genfromtxt(files[1], delimiter=",", names=True)
    for name in ("z", "a", "lower", "upper"):
        np.testing.assert_array_equal(band[name], getattr(found.rate_band(), name), err_msg=name)
