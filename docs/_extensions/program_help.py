# SPDX-License-Identifier: BSD-3-Clause
"""The directive program-help: what `shearfront COMMAND --help` prints. The program is the one of the environment variable
SHEARFRONT_PROGRAM, which scripts/docs sets."""

import os
import re
import subprocess

from docutils import nodes
from sphinx.util.docutils import SphinxDirective


def printed(*arguments):
    """What the program prints."""
    return subprocess.run([os.environ["SHEARFRONT_PROGRAM"], *arguments], check=True, capture_output=True, text=True).stdout


def commands():
    """The names of all commands, as the program lists them."""
    listed = printed("--help").partition("Subcommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  (\w+)", listed, re.MULTILINE)


class ProgramHelp(SphinxDirective):
    """A section for each command."""

    def run(self):
        """The nodes of all sections."""
        made = [_block("$ shearfront --help\n" + printed("--help"))]
        for command in [*commands(), "list"]:
            title = f"shearfront {command}"
            text = printed(command, "--help")
            if command == "list":
                title, text = "What shearfront list prints", printed("list")
                command = "list-output"
            section = nodes.section(ids=[f"shearfront-{command}"], names=[f"shearfront-{command}"])
            section += [nodes.title(title, title), _block(text)]
            made.append(section)
        return made


def _block(text):
    block = nodes.literal_block(text, text)
    block["language"] = "text"
    return block


def setup(app):
    """Adds the directive."""
    app.add_directive("program-help", ProgramHelp)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
