# SPDX-License-Identifier: BSD-3-Clause
"""What Doxygen reads of a header:  doxygen_filter.py HEADER

Indented lines of a comment (laws, tables, formulas) stay as they are written: they become blocks of code. Explicit
instantiations, which say nothing new, and private members are left out."""

import re
import sys


def filtered(lines):
    """The lines, with those blocks set apart."""
    in_block = False
    for line in lines:
        block = re.match(r"(\s*)/// ( +\S.*)$", line)
        comment = re.match(r"\s*///(?!<)", line)
        if (block and not in_block) or (in_block and comment and not block):
            yield re.match(r"\s*", line)[0] + "///"
        in_block = bool(block)
        yield f"{block[1]}///     {block[2]}" if block else line


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as header:
        text = re.sub(r"^extern template [^;]*;", "", header.read(), flags=re.MULTILINE)
        text = re.sub(r"^ private:\n.*?(?=^\};)", "", text, flags=re.MULTILINE | re.DOTALL)
        print("\n".join(filtered(text.split("\n"))))
