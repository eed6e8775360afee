# SPDX-License-Identifier: BSD-3-Clause
"""Checks built pages:  local_links.py FOLDER

Every link and picture that is a file exists, every anchor too, and nothing is loaded from elsewhere."""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """What a page links to, what it loads, and its anchors."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loads, self.anchors = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        """Collects one element."""
        values = dict(attributes)
        self.anchors.update(v for k, v in attributes if k in ("id", "name") and v)
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag in ("img", "script", "iframe", "source") and values.get("src"):
            self.loads.append(values["src"])
        if tag == "link" and values.get("rel") in ("stylesheet", "icon", "preload") and values.get("href"):
            self.loads.append(values["href"])


def main(folder):
    """Prints what is wrong; the number of it."""
    pages = {p.resolve(): Page(p.read_text()) for p in sorted(pathlib.Path(folder).rglob("*.html"))}
    wrong = []
    n_links = 0
    for path, page in pages.items():
        for target in page.loads + page.links:
            parts = urllib.parse.urlsplit(target)
            if parts.scheme == "data" or (parts.scheme and target in page.links):
                continue
            if parts.scheme or target.startswith("//"):
                wrong.append(f"{path}: loads {target}")
                continue
            n_links += 1
            file = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not file.exists():
                wrong.append(f"{path}: no such file: {target}")
            elif file in pages and parts.fragment and urllib.parse.unquote(parts.fragment) not in pages[file].anchors:
                wrong.append(f"{path}: no such place: {target}")
    print("\n".join(wrong) if wrong else f"docs       {len(pages)} pages, {n_links} local links are right")
    return len(wrong)


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1]) else 0)
