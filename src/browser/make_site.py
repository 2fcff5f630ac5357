#!/usr/bin/python3
"""Makes the site of static files: front page, lessons, lab, references and handbook, around the engine.

Nothing is fetched. It needs node, and Debian's package python3-markdown, which Debian's own Python finds.
Example: /usr/bin/python3 src/browser/make_site.py build/web build/site
"""

import argparse
import base64
import gzip
import json
import shutil
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import atlas_page
import lesson_page
import reference_page
from handbook_page import Handbook
from lesson import read_lessons
from site_page import SitePage, escaped

HERE = Path(__file__).resolve().parent
STUDIES = HERE.parents[1] / "studies"
LESSONS = STUDIES / "lessons"
# Those that a list offers; others can be typed.
METHODS = ["hbvm:auto,3", "hbvm:4,2", "hbvm:6,3", "hbvm:3,3", "gauss:3", "radau:2", "rk4", "verlet", "euler",
           "symplectic_euler", "midpoint", "dopri5", "rattle"]

# Of the pages that the program writes, what the lab uses, too.
PAGE_SCRIPTS = {"motion.js": "motion.js", "numbers.js": "page_numbers.js"}


def engine_data(folder: Path) -> str:
    """The engine's script and its module, packed, as one script: a page opened as a file may read no other kind."""
    module = gzip.compress((folder / "engine.wasm").read_bytes(), compresslevel=9, mtime=0)
    return ("const hbvmEngine = {script: " + json.dumps((folder / "engine.js").read_text()) + ",\n"
            "module: '" + base64.b64encode(module).decode() + "'};\n")


def scene_files() -> dict[str, Path]:
    """All scenes by their names."""
    return {path.stem: path for folder in ("scenes", "test_set") for path in sorted((STUDIES / folder).glob("*.toml"))}


def scenes() -> str:
    """The texts of all scenes and the names of methods, as a script."""
    texts = {name: path.read_text() for name, path in scene_files().items()}
    return ("const hbvmScenes = " + json.dumps(texts, ensure_ascii=False) + ";\n"
            "const hbvmMethods = " + json.dumps(METHODS) + ";\n")


class Site:
    """The folder of the site, and the pages that are in it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.pages: list[SitePage] = []

    def add(self, page: SitePage) -> None:
        """Writes a page."""
        self.pages.append(page)
        self.write(page.path, page.html())

    def write(self, path: str, text: str) -> None:
        """Writes a file."""
        self._place(path).write_text(text)

    def copy(self, file: Path, path: str) -> None:
        """Copies a file to a place of the site."""
        shutil.copy(file, self._place(path))

    def sitemap(self, address: str) -> str:
        """All pages under the site's address, as search engines read it."""
        base = address.rstrip("/")
        places = "".join(f"<url><loc>{escaped(f'{base}/{page.path}')}</loc></url>\n" for page in self.pages)
        return ('<?xml version="1.0" encoding="UTF-8"?>\n<urlset xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">\n'
                f"{places}</urlset>\n")

    def _place(self, path: str) -> Path:
        place = self.folder / path
        place.parent.mkdir(parents=True, exist_ok=True)
        return place


def front_pages() -> Iterator[SitePage]:
    """The front page and the lab."""
    yield SitePage(
        "index.html", "hbvm: energy-conserving integration of constrained mechanics at any precision",
        "A workbench for pendula, linkages, satellites and other mechanical systems with constraints: integrators of any "
        "order that conserve energy, in double, quad or any number of digits, with certified reference solutions.",
        (HERE / "pages/front.html").read_text(),
        heading="Mechanics that keeps its energy, to as many digits as you ask for", kind="text front",
        scripts=("numbers.js", "engine.js", "runs.js", "front.js", "engine_data.js"))
    yield SitePage(
        "lab.html", "hbvm lab: energy-conserving integrators side by side",
        "Choose or write a mechanical scene, run several integrators on it in double or in any number of digits, and see "
        "the motion, the energy and the digits that are left. Everything runs in this page.",
        (HERE / "pages/lab.html").read_text(), heading="Lab", kind="lab",
        lead="<p>Pick a scene, pick integrators, press <b>Run</b>. The program computes in this page; nothing is sent "
             "anywhere.</p>",
        scripts=("numbers.js", "engine.js", "runs.js", "command.js", "lab_state.js", "chart.js", "motion.js",
                 "page_numbers.js", "round_numbers.js", "page_data.js", "scene_text.js", "start.js", "sliders.js",
                 "sketch.js", "portrait.js", "work_precision.js", "picture.js", "film.js", "scenes.js", "lab.js", "engine_data.js"))


def add_lessons(site: Site) -> None:
    """The lessons and their list."""
    lessons = read_lessons(LESSONS)
    for before, lesson, after in zip([None, *lessons], lessons, [*lessons[1:], None]):
        site.add(lesson_page.lesson_page(lesson, before, after))
        for file, text in lesson.files.items():
            site.write(lesson.file_address(file), text)
    site.add(lesson_page.list_page(lessons))


def add_references(site: Site, engine: Path) -> None:
    """The stored references, each with its file, and their list."""
    files, store = scene_files(), reference_page.read_store(STUDIES / "reference/store")
    command = ["node", str(HERE / "run_engine.js"), str(engine)]
    with ThreadPoolExecutor() as workers:
        known = list(workers.map(lambda name: reference_page.read_scene(files[name], store[name], command), store))
    for scene in known:
        site.add(reference_page.reference_page(scene))
        for reference in scene.references:
            site.copy(reference.file, f"reference/{scene.name}/{reference.file.name}")
    site.add(reference_page.list_page(known))


def add_atlas(site: Site, engine: Path) -> None:
    """The coefficients of the literature, with their files."""
    folder = STUDIES / "atlas"
    found = atlas_page.read_atlas(folder, ["node", str(HERE / "run_engine.js"), str(engine)])
    site.add(atlas_page.atlas_page(folder, found))
    for one in found:
        site.copy(Path(one["file"]), atlas_page.file_address(folder, Path(one["file"])))


def add_handbook(site: Site) -> None:
    """The handbook, and what its pages lead to."""
    handbook = Handbook(STUDIES, without=LESSONS)
    for page in handbook.pages():
        site.add(page)
    for file, path in handbook.copies.items():
        site.copy(file, path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("engine", type=Path, help="the folder of engine.js and engine.wasm")
    parser.add_argument("output", type=Path, help="the folder of the site")
    parser.add_argument("--address", metavar="URL", help="where the site will be, for a sitemap for search engines")
    asked = parser.parse_args()
    site = Site(asked.output)
    for path in sorted((HERE / "site").iterdir()):
        site.copy(path, path.name)
    for name, path in PAGE_SCRIPTS.items():
        site.copy(HERE.parent / "run/page" / name, path)
    site.write("engine_data.js", engine_data(asked.engine))
    site.write("scenes.js", scenes())
    for page in front_pages():
        site.add(page)
    add_lessons(site)
    add_references(site, asked.engine)
    add_atlas(site, asked.engine)
    add_handbook(site)
    if asked.address:
        site.write("sitemap.xml", site.sitemap(asked.address))


if __name__ == "__main__":
    main()
