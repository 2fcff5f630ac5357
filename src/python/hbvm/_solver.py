"""An integrator of one's own, judged by its runs."""
from __future__ import annotations

import json
from typing import Any, Callable, Mapping, Sequence

from . import _hbvm
from ._against import Names, Results, _csv
from ._number import Exact, exact_text
from ._progress import Bar, Progress
from ._record import Shown
from ._scene import Scene, SceneLike
from ._scene import scene as scene_of


class Judgement(Shown):
    """Verdicts about an integrator: `verdicts` has order, drift and reversal of each scene."""


def judge(
    solve: Callable[[Scene, float, float], Results],
    *,
    order: int | None = None,
    scenes: SceneLike | Sequence[SceneLike] = (),
    until: Exact | None = None,
    columns: Names = None,
    progress: Progress = None,
) -> Judgement:
    """Judges an integrator of your own by its runs at a ladder of steps, against references.

    solve       called as solve(scene, step, until); it returns its states in any form that Reference.against takes,
                with the start and the end among them
    order       that is claimed
    scenes      simple, conical and double pendulum if absent
    until       end of the ladder; without, some of the times in which each motion changes
    columns     what its columns are, {theirs: ours}; of an array the names of its columns

    >>> import hbvm
    >>> def verlet(scene, step, until):
    ...     return hbvm.run(scene, "verlet", step=step, until=until)
    >>> found = hbvm.judge(verlet, order=2, scenes="kepler", until=1)
    >>> found.holds, [verdict.quantity for verdict in found.verdicts]
    (True, ['order', 'drift', 'reversal'])
    """

    def task(raw: Any, step: str, until: str) -> str:
        return _csv(solve(Scene._of(raw), float(step), float(until)), columns)[1]

    alone = isinstance(scenes, (str, Scene)) or not isinstance(scenes, Sequence)
    pairs = [(str(theirs), ours) for theirs, ours in columns.items()] if isinstance(columns, Mapping) else []
    with Bar(progress, "solver") as callback:
        found, text = _hbvm.audit_solver(
            name=getattr(solve, "__name__", "solver"),
            solve=task,
            map=pairs,
            order=order,
            scenes=[scene_of(one)._raw() for one in ([scenes] if alone else scenes)],
            until=None if until is None else exact_text(until, "until"),
            progress=callback,
        )
    return Judgement(json.loads(found), text)


Judgement.__module__ = "hbvm"
