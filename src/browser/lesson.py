"""A lesson: its text, and what it asks, runs and judges."""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

MARKER = re.compile(r"^\{\{(question|experiment|exercise)(?: (\w+))?\}\}$", re.MULTILINE)


@dataclass(frozen=True)
class Lesson:
    """A lesson; its question, experiments and exercises are as lesson.toml has them."""

    name: str  # 06_chaos_and_the_horizon
    title: str
    summary: str
    minutes: int
    text: str
    question: dict
    experiments: dict[str, dict]
    exercises: dict[str, dict]
    files: dict[str, str]  # texts that its commands read

    @property
    def number(self) -> str:
        """Two digits, by which the program knows it."""
        return self.name.partition("_")[0]

    @property
    def address(self) -> str:
        """Its page, below the site's folder."""
        return f"lessons/{self.name}.html"

    def file_address(self, file: str) -> str:
        """Where a file of it is, below the site's folder."""
        return f"lessons/{self.name}/{file}"

    def parts(self) -> list[tuple[str, str]]:
        """The text in order: ("text", Markdown), ("question", ""), ("experiment", NAME), ("exercise", NAME)."""
        pieces = MARKER.split(self.text)
        placed = [("text", pieces[0])]
        for kind, name, text in zip(pieces[1::3], pieces[2::3], pieces[3::3]):
            placed += [(kind, name or ""), ("text", text)]
        return placed


def read_lesson(folder: Path) -> Lesson:
    """The lesson of a folder; ValueError where its text and its tables do not fit."""
    table = tomllib.loads((folder / "lesson.toml").read_text())
    lesson = Lesson(name=folder.name, title=table["title"], summary=table["summary"], minutes=table["minutes"],
                    text=(folder / "lesson.md").read_text(), question=table["question"],
                    experiments={entry["name"]: entry for entry in table.get("experiment", [])},
                    exercises={entry["name"]: entry for entry in table["exercise"]}, files=table.get("files", {}))
    placed = sorted(part for part in lesson.parts() if part[0] != "text")
    known = sorted([("question", ""), *(("experiment", name) for name in lesson.experiments),
                    *(("exercise", name) for name in lesson.exercises)])
    if placed != known:
        raise ValueError(f"{folder.name}: lesson.md places {placed}, and lesson.toml has {known}")
    return lesson


def read_lessons(folder: Path) -> list[Lesson]:
    """All lessons of a folder, in their order."""
    return [read_lesson(path.parent) for path in sorted(folder.glob("*/lesson.toml"))]
