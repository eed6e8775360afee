# SPDX-License-Identifier: BSD-3-Clause
"""Numbers and other short words in tables stay on one line; tables that are then too wide for a screen scroll."""

from docutils import nodes

LONGEST = 16


def _mark(app, doctree):
    for entry in doctree.findall(nodes.entry):
        if len(entry.astext()) <= LONGEST:
            entry["classes"].append("unbroken")


def setup(app):
    """Looks at every page after it is parsed."""
    app.connect("doctree-read", _mark)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
