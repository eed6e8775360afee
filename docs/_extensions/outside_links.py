# SPDX-License-Identifier: BSD-3-Clause
"""Links of pages to what lies in the repository but not in docs/: a file is copied beside the page and can be opened; a folder
becomes its name, because there is nothing to open."""

import pathlib
import re

_LINK = re.compile(r"(?<!!)\[([^\]\n]+)\]\(((?:\.\./)+[^)#\s]+)(#[^)\s]*)?\)")


def _read(app, name, source):
    page = pathlib.Path(app.env.doc2path(name)).parent
    root = pathlib.Path(app.srcdir).resolve()

    def replaced(match):
        text, target = match.group(1, 2)
        path = (page / target).resolve()
        if path.is_relative_to(root) and not path.is_dir():
            return match.group(0)
        if path.is_file():
            return f"{{download}}`{text.replace('`', '')} <{target}>`"
        if path.is_dir():
            return f"{text} (`{path.relative_to(root.parent)}`)" if text.strip("`") not in str(path) else text
        return match.group(0)

    source[0] = _LINK.sub(replaced, source[0])


def setup(app):
    """Looks at every page before it is parsed."""
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
