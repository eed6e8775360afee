# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: ways to make them, what they say, what is refused."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import SOURCE
from hypothesis import given, settings
from hypothesis import strategies as st

import shearfront as sf
from shearfront._toml import canonical_tables, toml_text


def test_keywords_dicts_and_files_are_the_same(may: sf.Scene, tmp_path: Path) -> None:
    may.save(tmp_path / "may.toml")
    assert sf.read(tmp_path / "may.toml") == may
    assert sf.Scene.from_dict(may.to_dict()) == may
    assert sf.Scene.from_toml(may.to_toml()) == may
    assert pickle.loads(pickle.dumps(may)) == may
    assert copy.deepcopy(may) == may


@pytest.mark.parametrize("path", sorted((SOURCE / "datasets").glob("*/scene*.toml")), ids=lambda p: p.parent.name + "-" + p.stem)
def test_every_data_set_survives_its_tables(path: Path) -> None:
    scene = sf.read(path)
    assert toml_text(canonical_tables(scene.to_toml())).count("\n") > 3
    assert sf.Scene.from_dict(scene.to_dict()) == scene
    assert "Scene(" in repr(scene)
    assert "<svg" in scene._repr_html_()


def test_a_repr_makes_the_scene_again() -> None:
    scene = sf.Scene(
        shear_rate=sf.Exponential(4, 0.2), initial=sf.Pieces([1, 2], [0, 0.7, 0.2]), flux=sf.Cubic(0.3),
        scale=2, domain=(0, 3), solid_fraction=sf.Piecewise([1.5], [0.6, 0.5]), units={"z": "mm", "t": "s"},
    )  # fmt: skip
    again = eval(repr(scene), {name: getattr(sf, name) for name in sf.__all__})
    assert again == scene


def test_every_model_of_the_lists_has_a_class_that_a_file_reads() -> None:
    from shearfront import _core

    for list_name, models in _core.models().items():
        for model in models:
            classes = [c for c in sf._models.MODELS.values() if (c.list_name, c.model_name) == (list_name, model["name"])]
            assert len(classes) == 1, model["name"]
            assert classes[0].__doc__
            assert set(classes[0].entry_names) == {f["key"] for f in model["fields"]} | {c[0] for c in model["choices"]}


def test_all_complaints_at_once() -> None:
    with pytest.raises(sf.InputError) as caught:
        sf.Scene(shear_rate=sf.Piecewise([0.3, 0.2], [1, -1]), initial=sf.Step(2), domain=(0, 1))
    keys = [c.key for c in caught.value.complaints]
    assert keys == ["shear_rate.breaks[1]", "shear_rate.values", "shear_rate.values[1]", "initial.breaks[0]"]
    assert "scene:" not in str(caught.value)
    assert pickle.loads(pickle.dumps(caught.value)).complaints == caught.value.complaints


def test_files_say_where(tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text('[shear_rate]\nmodel = "exponentail"\n[initial]\nbreaks = []\nvalues = [0]\n')
    with pytest.raises(sf.InputError, match=r"bad.toml:2:9: shear_rate.model"):
        sf.read(path)
    with pytest.raises(sf.InputError, match="No such file"):
        sf.read(tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("parts", "says"),
    [
        ({"shear_rate": [2.4, 0.3]}, "shear_rate = .*must be a model such as Piecewise"),
        ({"shear_rate": "exponential"}, "shear_rate = 'exponential'; must be a model"),
        ({"shear_rate": sf.Cubic(0.3)}, "shear_rate.model"),
        ({"initial": [0, 1]}, "initial = .*must be a model such as Step"),
        ({"domain": 2}, r"domain = 2; must be a pair \(bottom, top\)"),
        ({"flux": ["quadratic", "cubic"]}, r"flux\[1\] = 'cubic'; must be a pair"),
        ({"diffusion": "much"}, "diffusion = 'much'; must be a number"),
        ({"units": {"z": 3}}, "units.z"),
        ({"boundary": {"bottom": {"value": [0.2]}}}, "boundary.bottom"),
    ],
)
def test_parts_of_the_wrong_kind(parts: dict[str, object], says: str) -> None:
    with pytest.raises(sf.InputError, match=says):
        sf.Scene(**{"shear_rate": 1, "initial": sf.Step(0.5), **parts})


def test_numbers_and_lists_of_fluxes() -> None:
    assert sf.Scene(shear_rate=1, initial=0.3) == sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Pieces([], [0.3]))
    two = sf.Scene(shear_rate=1, initial=0.3, flux=["quadratic", (0.5, sf.Cubic(0.3))])
    assert repr(two).startswith("Scene(flux=[Quadratic(), (0.5, Cubic(0.3))], ")
    assert eval(repr(two), vars(sf)) == two


def test_a_fit_file_is_no_scene() -> None:
    with pytest.raises(sf.InputError, match="is a fit file"):
        sf.read(SOURCE / "datasets" / "paper-example-3" / "fit.toml")


def test_models_say_what_they_take() -> None:
    with pytest.raises(TypeError, match="no entry 'breaks'"):
        sf.Exponential(breaks=1)
    with pytest.raises(TypeError, match="needs 'decay'"):
        sf.Exponential(1)
    with pytest.raises(TypeError, match="takes 2 entries but 3"):
        sf.Exponential(1, 2, 3)
    with pytest.raises(AttributeError, match="cannot be changed"):
        sf.Exponential(1, 2).decay = 3


def test_with(may: sf.Scene) -> None:
    assert may.with_({"shear_rate.values[1]": 0.4}).entries["shear_rate.values[1]"] == 0.4
    assert may.with_(shear_rate__values__1=0.4) == may.with_({"shear_rate.values[1]": 0.4})
    assert may.with_(shear_rate__values=[2.4, 0.4]) == may.with_(shear_rate__values__1=0.4)
    assert may.with_(shear_rate=sf.Exponential(4, 0.2)).entries["shear_rate.decay"] == 0.2
    assert may.with_(scale=2).entries["shear_rate.scale"] == 2
    assert may.with_(scale=2).with_(shear_rate=sf.Exponential(4, 0.2)).entries["shear_rate.scale"] == 2
    assert may.with_(flux=[sf.Quadratic(), (0.5, sf.Cubic(0.3))]).entries["flux[1].gamma"] == 0.3
    assert may.with_(name="x").name == "x"
    assert may.entries["shear_rate.values[1]"] == 0.31, "scenes are immutable"
    for wrong in ({"shear_rat": 1}, {"shear_rate__valuse": [1]}, {"shear_rate__values__7": 1}, {"flux__gamma__x": 1}):
        with pytest.raises(sf.InputError):
            may.with_(**wrong)
    with pytest.raises(sf.InputError, match=r"shear_rate.values\[7\]"):
        may.with_({"shear_rate.values[7]": 1})


positive = st.floats(1e-3, 1e3)
inside = st.lists(st.floats(0.001, 0.999), min_size=1, max_size=6, unique=True).map(sorted)


@settings(max_examples=60)
@given(breaks=inside, data=st.data(), scale=positive)
def test_numbers_keep_their_bits(breaks: list[float], data: st.DataObject, scale: float) -> None:
    values = data.draw(st.lists(positive, min_size=len(breaks) + 1, max_size=len(breaks) + 1))
    scene = sf.Scene(shear_rate=sf.Piecewise(breaks, values), initial=sf.Step(0.5), scale=scale)
    found = scene.entries
    assert [found[f"shear_rate.breaks[{i}]"] for i in range(len(breaks))] == breaks
    assert [found[f"shear_rate.values[{i}]"] for i in range(len(values))] == values
    assert found["shear_rate.scale"] == scale
    assert sf.Scene.from_dict(scene.to_dict()) == scene


@settings(max_examples=60)
@given(name=st.text(max_size=30).filter(lambda s: s.isprintable()))
def test_names_survive(name: str) -> None:
    scene = sf.Scene(shear_rate=1, initial=sf.Step(0.5), name=name)
    assert scene.name == (name or "scene")
    assert sf.Scene.from_dict(scene.to_dict()) == scene


def test_functions_of_height(may: sf.Scene) -> None:
    z = np.array([[0.1, 0.29], [0.5, 1.0]])
    np.testing.assert_array_equal(may.shear_rate(z), [[2.4, 0.31], [0.31, 0.31]])
    np.testing.assert_array_equal(may.initial_phi(z), [[0, 0], [1, 1]])
    np.testing.assert_array_equal(may.solid_fraction(z), np.ones((2, 2)))
    np.testing.assert_allclose(may.flux([0.25, 0.5]), [-0.1875, -0.25], rtol=0)
    for outside in (-0.1, 1.1, np.nan):
        with pytest.raises(sf.InputError, match="inside the domain"):
            may.shear_rate(outside)
