# SPDX-License-Identifier: BSD-3-Clause
"""How Sphinx builds the pages; scripts/docs calls it. Nothing is loaded from the network when a page is read."""

import inspect
import pathlib
import re
import sys

from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path.insert(0, str(HERE / "_extensions"))

project = "shearfront"
author = "the shearfront authors"
copyright = "the shearfront authors, BSD-3-Clause"
version = release = re.search(r'^version = "(.*)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE).group(1)

extensions = [
    "myst_nb",
    "breathe",
    "sphinx.ext.autodoc",
    "numpydoc",
    "mathml",
    "program_help",
    "gallery",
    "outside_links",
    "interfaces",
    "unbroken",
]
exclude_patterns = ["_extensions", "drawings"]
nitpicky = False
# Notebooks (pages with code-cell) are run at every build; an error in one is an error of the build.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_merge_streams = True
nb_ipywidgets_js = {}
breathe_projects = {"shearfront": str(ROOT / "build" / "docs" / "doxygen" / "xml")}
breathe_default_project = "shearfront"
breathe_show_include = False
# Every header opens the namespace again.
suppress_warnings = ["duplicate_declaration.cpp"]

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
myst_dmath_allow_space = False
myst_dmath_allow_digits = False

autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

# Pictures of the gallery by area, in the order in which they are shown.
gallery_areas = {
    "Waves": ["fronts-two-layers", "film", "profiles", "fronts-exponential", "bottleneck", "smooth-start", "bed-height"],
    "Measurements": ["fit-laboratory", "prediction", "bootstrap", "sensitivity", "real-grains", "study"],
    "Other fluxes, diffusion": ["traffic-light", "speed-limit", "settling", "oil-and-water", "diffusion"],
    "Chutes and slabs": ["steady-chute", "slab"],
    "Methods": ["error-against-time", "convergence", "packing"],
}

html_theme = "furo"
html_title = f"shearfront {version}"
html_static_path = ["_static"]
html_css_files = ["shearfront.css"]
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}
highlight_language = "text"
lexers["csv"] = TextLexer()  # Pygments has none
pygments_style = "friendly"


def _docstring(app, what, name, obj, options, lines):
    """Absolute values, |z|, are no substitutions."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def _signature(app, what, name, obj, options, signature, return_annotation):
    """Options of methods are spelt out for completion; pages name them once, as **options."""
    spelt_out = getattr(obj, "__signature__", None) if what in ("function", "method") else None
    if spelt_out is None:
        return None
    del obj.__signature__
    shown = inspect.signature(obj)
    obj.__signature__ = spelt_out
    parameters = [p.replace(annotation=p.empty) for p in shown.parameters.values() if p.name != "self"]
    return str(inspect.Signature(parameters)), None


def setup(app):
    """Called by Sphinx."""
    app.connect("autodoc-process-signature", _signature)
    app.connect("autodoc-process-docstring", _docstring, priority=0)
