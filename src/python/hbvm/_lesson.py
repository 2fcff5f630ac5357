"""Lessons: what they ask, and whether answers are right."""
from __future__ import annotations

import json
from typing import Any, Mapping, Union

from . import _hbvm
from ._number import Exact, exact_text
from ._record import Listing, Record

Answers = Mapping[str, Mapping[str, Exact]]


def lessons() -> Listing:
    """The lessons there are, each with its question and its exercises.

    >>> import hbvm
    >>> hbvm.lessons()[0].title
    'A pendulum in x and y'
    """
    found, text = _hbvm.lessons()
    return Listing([Record(lesson) for lesson in json.loads(found)], text)


def check_lesson(lesson: Union[int, str], answers: Answers) -> Listing:
    """Judges answers to the exercises of a lesson, by computing what they say: a verdict for each exercise.

    >>> import hbvm
    >>> checked = hbvm.check_lesson(1, {"hidden": {"factor": 4}})
    >>> [(verdict.name, verdict.right) for verdict in checked]
    [('baumgarte', False), ('hidden', True)]
    """
    lines = []
    for exercise, blanks in answers.items():
        lines.append(f"[{json.dumps(exercise)}]")
        lines += [f"{json.dumps(blank)} = {json.dumps(exact_text(value))}" for blank, value in blanks.items()]
    found, text = _hbvm.check_lesson(str(lesson), "\n".join(lines))
    verdicts: Any = json.loads(found)["exercises"]
    return Listing([Record(verdict) for verdict in verdicts], text)
