"""A page of the site: what it says, and the frame that all pages share."""

import html
import posixpath
from dataclasses import dataclass

# Addresses are below the site's folder; each names its file, since a folder opened as a file has no first page.
SECTIONS = {"index.html": "hbvm", "lessons/index.html": "Lessons", "lab.html": "Lab",
            "reference/index.html": "References", "atlas/index.html": "Atlas", "handbook/index.html": "Handbook"}
PAPER = "https://arxiv.org/abs/2203.03275"


def escaped(text: str) -> str:
    """Text as it may stand in HTML, also between quotation marks."""
    return html.escape(text, quote=True)


def plain(markup: str, length: int = 200) -> str:
    """The words of HTML, as many as a search engine shows."""
    words = "".join(part.rpartition(">")[2] for part in markup.split("<"))
    text = " ".join(html.unescape(words).split())
    return text if len(text) <= length else text[:length].rsplit(" ", 1)[0] + " …"


def relative(target: str, page: str) -> str:
    """The way from one page to another, both below the site's folder."""
    return posixpath.relpath(target, posixpath.dirname(page) or ".")


@dataclass(frozen=True)
class SitePage:
    """A page of the site; `main` and `lead` are HTML, the rest is text."""

    path: str
    title: str
    description: str
    main: str
    heading: str = ""  # the title, where there is none
    lead: str = ""  # below the heading
    kind: str = "text"  # a class of the style sheet
    scripts: tuple[str, ...] = ()  # below the site's folder; engine_data.js comes last, when all else is there

    def html(self) -> str:
        """The page with its frame."""
        scripts = "".join(f'<script src="{self._to(name)}"{" defer" if name == "engine_data.js" else ""}></script>\n'
                          for name in self.scripts)
        return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escaped(self.title)}</title>
<meta name="description" content="{escaped(self.description)}">
<link rel="icon" href="data:,">
<link rel="stylesheet" href="{self._to('site.css')}">
<noscript><style>.after {{ display: block; }} .live {{ display: none; }}</style></noscript>
</head>
<body>
<a class="skip" href="#main">To the text</a>
<header class="{self.kind}">
<nav aria-label="Site">{self._navigation()}</nav>
<h1>{escaped(self.heading or self.title)}</h1>
{self.lead}
</header>
<main id="main" class="{self.kind}">
{self.main}
</main>
<footer class="{self.kind}"><p class="quiet">hbvm computes in this page; nothing is sent anywhere. The methods are those of
<a href="{PAPER}">Amodio, Brugnano, Frasca-Caccia and Iavernaro, arXiv 2203.03275</a>.</p></footer>
{scripts}</body>
</html>
"""

    def _to(self, target: str) -> str:
        return relative(target, self.path)

    def _navigation(self) -> str:
        folder = posixpath.dirname(self.path).split("/")[0]
        here = f"{folder}/index.html" if folder else self.path

        def current(target: str) -> str:
            return ' aria-current="page"' if target == self.path else ' aria-current="true"' if target == here else ""

        return " ".join(f'<a href="{self._to(target)}"{current(target)}>{name}</a>'
                        for target, name in SECTIONS.items())
