# SPDX-License-Identifier: BSD-3-Clause
"""The directives gallery, gallery-thumbnails and picture.

Every picture is a file of docs/gallery or, for the drawings of the theory, docs/drawings: a Python script (.py) that ends with
`figure = ...` or `film = ...` (an animation of matplotlib), or a shell script (.sh) that makes picture.svg or picture.png. The
first lines are comments: the title, then a sentence or two. What has changed since it last ran is run, a few at a time, and all
of it if the program or the package has. The
gallery shows pictures with their code; `picture` shows one, with its code folded away.
"""

import concurrent.futures
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys

from docutils import nodes
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

import shearfront

_DRAW = """
import matplotlib
matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "shearfront"
import sys
names = {"__name__": "__main__"}
exec(compile(open(sys.argv[1]).read(), sys.argv[1], "exec"), names)
if "film" in names:
    names["film"].save("picture.gif", writer="pillow", fps=8, dpi=80)
else:
    names["figure"].savefig("picture.png", dpi=110)
"""


class Picture:
    """A script of the gallery and what it drew."""

    def __init__(self, script, folder):
        lines = script.read_text().splitlines()
        if lines[0].startswith("#!"):
            del lines[0]
        head = []
        while lines and lines[0].startswith("# "):
            head.append(lines.pop(0)[2:])
        self.script = script
        self.name = script.stem
        self.language = "python" if script.suffix == ".py" else "sh"
        self.title = head[0]
        self.text = " ".join(head[1:])
        self.code = "\n".join(lines).strip() + "\n"
        self.folder = folder / self.name

    @property
    def file(self):
        """The picture."""
        return next(f for f in (self.folder / f"picture.{kind}" for kind in ("svg", "png", "gif")) if f.exists())

    def draw(self, root, makers):
        """Runs the script, if it is not the one that drew what is there. Returns what went wrong."""
        program = os.environ["SHEARFRONT_PROGRAM"]
        key = hashlib.sha256(self.script.read_bytes() + _DRAW.encode() + makers).hexdigest()
        mark = self.folder / "drawn-by"
        if mark.exists() and mark.read_text() == key:
            return ""
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        (self.folder / "datasets").symlink_to(root / "datasets")
        command = [sys.executable, "-c", _DRAW] if self.language == "python" else ["bash", "-euo", "pipefail"]
        path = f"{pathlib.Path(program).parent}{os.pathsep}{os.environ['PATH']}"
        ran = subprocess.run(
            [*command, self.script], cwd=self.folder, env={**os.environ, "PATH": path}, capture_output=True, text=True,
        )  # fmt: skip
        if ran.returncode != 0:
            return f"{self.script}: {ran.stdout}{ran.stderr}"
        mark.write_text(key)
        return ""


def _makers():
    """A hash of what draws: the program and the package."""
    package = sorted(p for p in pathlib.Path(shearfront.__file__).parent.iterdir() if p.suffix in (".py", ".so"))
    files = [pathlib.Path(os.environ["SHEARFRONT_PROGRAM"]), *package]
    return hashlib.sha256(b"".join(f.read_bytes() for f in files)).digest()


def _pictures(app):
    if not hasattr(app, "shearfront_gallery"):
        source = pathlib.Path(app.srcdir)
        made = pathlib.Path(app.outdir).parent / "gallery"
        scripts = sorted(f for d in ("gallery", "drawings") for f in (source / d).iterdir() if f.suffix in (".py", ".sh"))
        all_of_them = [Picture(script, made) for script in scripts]
        makers = _makers()
        with concurrent.futures.ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:
            wrong = [text for text in pool.map(lambda p: p.draw(source.parent, makers), all_of_them) if text]
        if wrong:
            raise ExtensionError("\n".join(wrong))
        shown = pathlib.Path(app.outdir) / "_images" / "gallery"
        shown.mkdir(parents=True, exist_ok=True)
        for picture in all_of_them:
            shutil.copyfile(picture.file, shown / f"{picture.name}{picture.file.suffix}")
        app.shearfront_gallery = {p.name: p for p in all_of_them}
    return app.shearfront_gallery


def _of_gallery(app):
    """Areas with their pictures; every script of the gallery is in one."""
    pictures = _pictures(app)
    areas = app.config.gallery_areas
    there = {p.name for p in pictures.values() if p.script.parent.name == "gallery"}
    listed = [name for names in areas.values() for name in names]
    if sorted(listed) != sorted(there):
        raise ExtensionError(
            f"gallery_areas and the scripts of docs/gallery differ: {', '.join(there.symmetric_difference(listed))}"
        )
    return {area: [pictures[name] for name in names] for area, names in areas.items()}


def _image(picture, page):
    up = "../" * page.count("/")
    return f"{up}_images/gallery/{picture.name}{picture.file.suffix}"


class Thumbnails(SphinxDirective):
    """Small pictures that lead to the large ones. A line `name: sentence` for each; without lines all, with their titles."""

    has_content = True

    def run(self):
        """One node."""
        pictures = _pictures(self.env.app)
        page = self.env.docname
        for picture in pictures.values():
            self.env.note_dependency(str(picture.script))
        self.env.note_dependency(__file__)
        up = "../" * page.count("/")
        wanted = [line.partition(": ")[::2] for line in self.content if line.strip()]
        if not wanted:
            wanted = [(p.name, p.title) for shown in _of_gallery(self.env.app).values() for p in shown]
        size = " large" if len(wanted) < 4 else ""
        cells = "".join(
            f'<a href="{up}gallery/index.html#{name}">'
            f'<img src="{_image(pictures[name], page)}" alt="{pictures[name].title}">{text}</a>'
            for name, text in wanted
        )
        return [nodes.raw("", f'<div class="thumbnails{size}">{cells}</div>', format="html")]


class Gallery(SphinxDirective):
    """Every picture with its text and its code."""

    def run(self):
        """A section for each area."""
        made = []
        for area, pictures in _of_gallery(self.env.app).items():
            part = nodes.section(ids=[nodes.make_id(area)], names=[area])
            part += nodes.title(area, area)
            part += [self.section(picture) for picture in pictures]
            made.append(part)
        return made

    def section(self, picture):
        """Title, text, picture and code."""
        self.env.note_dependency(str(picture.script))
        section = nodes.section(ids=[picture.name], names=[picture.name])
        code = nodes.literal_block(picture.code, picture.code)
        code["language"] = picture.language
        section += nodes.title(picture.title, picture.title)
        section += nodes.paragraph(picture.text, picture.text)
        section += nodes.raw("", f'<img src="{_image(picture, self.env.docname)}" alt="{picture.title}">', format="html")
        section += code
        return section


class OnePicture(SphinxDirective):
    """One picture, with its title under it and its code folded away."""

    required_arguments = 1

    def run(self):
        """A figure."""
        picture = _pictures(self.env.app)[self.arguments[0]]
        self.env.note_dependency(str(picture.script))
        code = nodes.literal_block(picture.code, picture.code)
        code["language"] = picture.language
        text = f"{picture.title}. {picture.text}" if picture.text else picture.title
        image = f'<img src="{_image(picture, self.env.docname)}" alt="{picture.title}">'
        return [
            nodes.raw("", f'<figure class="drawn">{image}<figcaption>{text}</figcaption>', format="html"),
            nodes.raw("", "<details><summary>how it is drawn</summary>", format="html"),
            code,
            nodes.raw("", "</details></figure>", format="html"),
        ]


def setup(app):
    """Adds the directives."""
    app.add_config_value("gallery_areas", {}, "env")
    app.add_directive("picture", OnePicture)
    app.add_directive("gallery", Gallery)
    app.add_directive("gallery-thumbnails", Thumbnails)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
