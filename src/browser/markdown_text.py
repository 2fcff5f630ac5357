"""Markdown as the project writes it, made HTML."""

import re
from collections.abc import Callable
from xml.etree.ElementTree import Element

import markdown
from markdown.extensions import Extension
from markdown.treeprocessors import Treeprocessor

EXTENSIONS = ["fenced_code", "tables", "sane_lists"]


def html_of(text: str, link: Callable[[str], str | None] = lambda target: target) -> str:
    """Markdown as HTML; `link` says where a link or an image leads, or None where it shall be its text alone."""
    return markdown.markdown(_deepened(text), extensions=[
        *EXTENSIONS, "toc", _Links(link)], extension_configs={"toc": {"slugify": _anchor}})


def _anchor(heading: str, _: str) -> str:
    """The name that links give a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def _deepened(text: str) -> str:
    """What goes on in an entry of a list stands two deep in our pages, and four deep for Python's Markdown."""
    lines, entry, fenced = [], False, False
    for line in text.splitlines():
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced and line and not line.startswith(" "):
            entry = re.match(r"([-*]|\d+\.) ", line) is not None
        lines.append("  " + line if entry and not fenced and line.startswith("  ") else line)
    return "\n".join(lines)


class _Links(Extension):
    """Leads links and images elsewhere."""

    def __init__(self, link: Callable[[str], str | None]) -> None:
        super().__init__()
        self.link = link

    def extendMarkdown(self, md: markdown.Markdown) -> None:  # noqa: N802, the library's name
        md.treeprocessors.register(_Leading(md, self.link), "leading", 0)


class _Leading(Treeprocessor):
    def __init__(self, md: markdown.Markdown, link: Callable[[str], str | None]) -> None:
        super().__init__(md)
        self.link = link

    def run(self, root: Element) -> None:
        for tag, key in (("a", "href"), ("img", "src")):
            for element in root.iter(tag):
                target = self.link(element.attrib.pop(key, ""))
                if target is None:
                    element.tag = "span"
                else:
                    element.set(key, target)
