"""The pages of the handbook, which are those of studies/ in Markdown."""

import posixpath
import re
from collections.abc import Iterator
from pathlib import Path

from markdown_text import html_of
from site_page import SitePage, plain, relative

# Files that a browser shows or a reader can use, if a page leads to them.
SHOWN = {".svg", ".png", ".toml", ".csv", ".json", ".py", ".cpp", ".hpp"}
HEADING = re.compile(r"# (.+)\n")
FIRST = "handbook/index.html"


class Handbook:
    """The handbook of a folder; its files stand below handbook/ as they stand in the folder."""

    def __init__(self, folder: Path, without: Path) -> None:
        self.folder = folder
        texts = [path for path in sorted(folder.rglob("*.md")) if without not in path.parents]
        self.addresses = {path: self._address(path) for path in texts}
        # What the pages lead to, and where it goes: filled as pages are made.
        self.copies: dict[Path, str] = {}

    def pages(self) -> Iterator[SitePage]:
        """All pages."""
        for path, address in self.addresses.items():
            text, heading = path.read_text(), f"{path.parent.name}, {path.stem}".replace("_", " ")
            if found := HEADING.match(text):
                text, heading = text[found.end():], plain(html_of(found[1]))
            main = html_of(text, lambda target: self._link(target, path))
            first = re.search(r"<p>.*?</p>", main, re.DOTALL)
            title = "Handbook of hbvm" if address == FIRST else f"{heading}: handbook of hbvm"
            yield SitePage(address, title, plain(first[0]) if first else title, main, heading=heading,
                           kind="text prose handbook")

    def _address(self, path: Path) -> str:
        name = path.relative_to(self.folder).with_suffix(".html").as_posix()
        return posixpath.join("handbook", re.sub(r"README\.html$", "index.html", name))

    def _link(self, target: str, page: Path) -> str | None:
        """Where a link of a page leads on the site; None where there is no such thing."""
        if re.match(r"https?:|#", target):
            return target
        name, mark, heading = target.partition("#")
        path = (page.parent / name).resolve()
        if path in self.addresses:
            address = self.addresses[path]
        elif path.is_file() and path.suffix in SHOWN and self.folder in path.parents:
            address = self.copies[path] = posixpath.join("handbook", path.relative_to(self.folder).as_posix())
        else:
            return None
        return relative(address, self.addresses[page]) + mark + heading
