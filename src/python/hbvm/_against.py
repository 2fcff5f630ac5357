"""Results of one's own code beside the exact motion."""
from __future__ import annotations

import json
import os
from typing import Any, Mapping, Sequence, Union

from . import _hbvm
from ._columns import Columns
from ._errors import InputError
from ._number import Exact, Number, exact_text
from ._progress import Bar, Progress
from ._record import Record

#: A CSV file or its text, a DataFrame, a dict of columns, an array with names of columns, or a run.
Results = Union[str, "os.PathLike[str]", Any]
Names = Union[Mapping[str, str], Sequence[str], None]


class Against(Record):
    """How many digits of results are right, time by time: `files` has an entry for each."""

    def __init__(self, facts: dict[str, Any], text: str, least: float) -> None:
        super().__init__(facts)
        self._text = text
        #: The least right digits of all components and times.
        self.least_digits = least

    def table(self) -> str:
        """What `hbvm reference --against` prints."""
        return self._text

    def __repr__(self) -> str:
        return self._text.rstrip("\n")

    def __reduce__(self) -> Any:
        return Against, (self._facts, self._text, self.least_digits)


def _cell(value: Any) -> str:
    """A decimal with the digits that a number has, and no more."""
    if isinstance(value, (str, Number)):
        return value if isinstance(value, str) else value.text
    if hasattr(value, "_mpf_"):
        from mpmath import libmp

        bits = value._mpf_[3]
        return libmp.to_str(value._mpf_, max(17, 3 * bits // 10 + 3))
    return repr(float(value)) if isinstance(value, float) else exact_text(value, "a result")


def _csv_of(columns: Mapping[str, Sequence[Any]]) -> str:
    rows = zip(*columns.values())
    lines = [",".join(_cell(value) for value in row) for row in rows]
    return "\n".join([",".join(columns), *lines, ""])


def _csv(results: Results, names: Names) -> tuple[str, str]:
    """The name and the CSV text of results in any form."""
    if isinstance(results, str) and "\n" in results:
        return "results", results
    if isinstance(results, (str, os.PathLike)):
        with open(results, encoding="utf-8") as stream:
            return os.fspath(results), stream.read()
    trajectory = getattr(results, "trajectory", results)
    if isinstance(trajectory, Columns):
        return "run", trajectory.to_csv() or ""
    if isinstance(results, Mapping) or hasattr(results, "to_csv"):
        return "results", _csv_of({str(name): list(results[name]) for name in results})
    if names is None or isinstance(names, Mapping):
        raise InputError("an array has no names of columns: columns=['t', 'a.x', ...] says them")
    if any(len(row) != len(names) for row in results):
        raise InputError(f"there are {len(names)} names, and rows with more or fewer numbers")
    return "results", _csv_of({name: [row[i] for row in results] for i, name in enumerate(names)})


def against(
    raw_scene: Any, results: Sequence[Results], columns: Names, steps: Sequence[Exact], cost: bool, progress: Progress
) -> Against:
    if steps and len(steps) != len(results):
        raise InputError(f"there are {len(steps)} steps for {len(results)} results")
    files = []
    for number, one in enumerate(results):
        name, csv = _csv(one, columns)
        step = exact_text(steps[number], "step") if steps else ""
        files.append((f"{name} {number + 1}" if len(results) > 1 and not os.path.isfile(name) else name, csv, step))
    pairs = [(str(theirs), ours) for theirs, ours in columns.items()] if isinstance(columns, Mapping) else []
    with Bar(progress, "reference") as callback:
        found, text, least = _hbvm.compare_results(scene=raw_scene, files=files, map=pairs, cost=cost, progress=callback)
    return Against(json.loads(found), text, least)


Against.__module__ = "hbvm"
