"""Methods beside one another, and errors against the step."""
from __future__ import annotations

import json
import os
from typing import Any, Sequence

from . import _hbvm
from ._number import Exact, exact_text
from ._page import Page
from ._progress import Bar, Progress
from ._record import Made, Record
from ._scene import SceneLike
from ._scene import scene as scene_of


class Comparison(Made):
    """Several methods on one scene: `runs` has an entry for each."""

    def animate(self) -> Page:
        """The page on which all methods move on one clock."""
        return Page(self._made["page"])


class Convergence(Made):
    """Errors against the step: `methods` has an entry for each method and precision, with its orders."""


class Study(Record):
    """The tables of a folder with a study.toml, and how many of the printed figures agree."""

    def __repr__(self) -> str:
        return f"{self.title}\n{self._facts['table']}\n{self.agreed} of {self.stated} printed figures agree"

    def __reduce__(self) -> Any:
        return Study, (self._facts,)


def compare(
    scene: SceneLike,
    methods: Sequence[str],
    *,
    step: Exact | None = None,
    until: Exact,
    precision: str | int = "double",
    reference: bool = False,
    progress: Progress = None,
) -> Comparison:
    """Runs several methods on one scene, by the same step until the same time.

    reference   tell how many digits are right at the end

    >>> import hbvm
    >>> found = hbvm.compare("kepler", ["verlet", "hbvm:auto,3"], step="1/16", until=4)
    >>> found.runs[0].e_H > 1e-6 > 1e-12 > found.runs[1].e_H
    True
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        made = _hbvm.compare(
            scene=found._raw(),
            methods=list(methods),
            step=None if step is None else exact_text(step, "step"),
            until=exact_text(until, "until"),
            precision=str(precision),
            reference=reference,
            picture=True,
            progress=callback,
        )
    return Comparison(made)


def convergence(
    scene: SceneLike,
    methods: Sequence[str],
    *,
    steps: str,
    until: Exact | None = None,
    precisions: Sequence[str | int] = ("double",),
    propagated: bool = False,
    progress: Progress = None,
) -> Convergence:
    """Errors against the step, of methods of the program, and the rates that they tend to.

    steps        "1/8:1/256", each half of the one before
    until        a multiple of the steps; without, sixteen of the longest
    propagated   p and lambda as they are carried on, instead of those of the output state

    >>> import hbvm
    >>> found = hbvm.convergence("kepler", ["hbvm:4,2"], steps="1/4:1/128", precisions=[30])
    >>> abs(found.methods[0].orders.q.rate - 4) < 0.1
    True
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        made = _hbvm.convergence(
            scene=found._raw(),
            methods=list(methods),
            steps=steps,
            until=None if until is None else exact_text(until, "until"),
            precisions=[str(precision) for precision in precisions],
            propagated=propagated,
            progress=callback,
        )
    return Convergence(made)


def study(
    folder: str | os.PathLike[str],
    *,
    precision: str | int = "double",
    check: bool = True,
    out: str | os.PathLike[str] = "",
    jobs: int = 1,
    progress: Progress = None,
) -> Study:
    """Runs the experiments of a folder with a study.toml. Tables go to `out`, or to results/PRECISION in the folder.

    check   compare with the folder's expected.csv
    """
    with Bar(progress, os.fspath(folder)) as callback:
        made = _hbvm.study(
            folder=os.fspath(folder),
            precision=str(precision),
            check=check,
            out=os.fspath(out),
            jobs=jobs,
            progress=callback,
        )
    return Study(json.loads(made))


for _public in (Comparison, Convergence, Study):
    _public.__module__ = "hbvm"
