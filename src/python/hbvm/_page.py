"""Pages that move."""
from __future__ import annotations

import html
import os


class Page:
    """A page of its own in HTML. A notebook shows it where it is the last value of a cell."""

    def __init__(self, text: str, height: int = 760) -> None:
        self.html = text
        self._height = height

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the page into a file, which any browser opens without a network."""
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(self.html)

    def _repr_html_(self) -> str:
        inside = html.escape(self.html, quote=True)
        return f'<iframe srcdoc="{inside}" style="width: 100%; height: {self._height}px; border: 0"></iframe>'

    def __repr__(self) -> str:
        return f"Page of {len(self.html)} characters: save(file) writes it, and a notebook shows it"


Page.__module__ = "hbvm"
