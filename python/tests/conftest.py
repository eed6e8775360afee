# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: the source, the program they compare with, and scenes."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import configuration, settings

import shearfront as sf

# The same examples in every run, and nothing kept between runs.
configuration.set_hypothesis_home_dir(Path(__file__).resolve().parents[2] / "build" / "python" / "hypothesis")
settings.register_profile("fixed", derandomize=True, database=None, deadline=None)
settings.load_profile("fixed")

SOURCE = Path(__file__).resolve().parents[2]


@pytest.fixture
def may() -> sf.Scene:
    """The two layers of May et al. (2010)."""
    return sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5), name="May")


@pytest.fixture(scope="session")
def program() -> str:
    """The command line program, SHEARFRONT_PROGRAM or that of the release build."""
    built = SOURCE / "build" / "release" / "tools" / "shearfront"
    found = os.environ.get("SHEARFRONT_PROGRAM") or (str(built) if built.exists() else shutil.which("shearfront"))
    if not found:
        pytest.skip("the program is not built (scripts/build release), nor named by SHEARFRONT_PROGRAM")
    return found


@pytest.fixture(scope="session")
def refuses(program: str):
    """Whether the program ends without a result."""

    def call(*arguments: str) -> bool:
        return subprocess.run([program, *arguments], capture_output=True, check=False).returncode in (1, 2)

    return call


@pytest.fixture(scope="session")
def run(program: str):
    """Runs the program; gives what it prints."""

    def call(*arguments: str) -> str:
        done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call
