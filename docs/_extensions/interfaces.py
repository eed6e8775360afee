# SPDX-License-Identifier: BSD-3-Clause
"""Directives for the reference: header (a C++ header as it stands, with its name as title) and python-models (all models of the
Python package)."""

import pathlib

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

import shearfront


class Header(SphinxDirective):
    """A header of the library."""

    required_arguments = 1

    def run(self):
        """A section."""
        path = pathlib.Path(self.env.srcdir).parent / self.arguments[0]
        self.env.note_dependency(str(path))
        text = "".join(line for line in path.read_text().splitlines(True) if "SPDX-License" not in line)
        name = self.arguments[0].partition("/")[2]
        section = nodes.section(ids=[nodes.make_id(name)], names=[name])
        code = nodes.literal_block(text, text)
        code["language"] = "cpp"
        section += [nodes.title("", "", nodes.literal(name, name)), code]
        return [section]


class PythonModels(SphinxDirective):
    """What can be given to shear_rate, flux, initial and so on."""

    def run(self):
        """The description of each class."""
        names = [n for n in shearfront.__all__ if _is_model(getattr(shearfront, n))]
        return self.parse_text_to_nodes(
            "```{eval-rst}\n" + "".join(f".. autoclass:: shearfront.{n}\n" for n in names) + "```\n",
        )  # fmt: skip


def _is_model(value):
    return isinstance(value, type) and issubclass(value, shearfront.Model) and value is not shearfront.Model


def setup(app):
    """Adds the directives."""
    app.add_directive("header", Header)
    app.add_directive("python-models", PythonModels)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
