"""The cheapest way to so many digits."""
from __future__ import annotations

import json
from typing import Any, Sequence

from . import _hbvm
from ._number import Exact, exact_text
from ._progress import Bar, Progress
from ._record import Shown
from ._scene import SceneLike
from ._scene import scene as scene_of


class Plan(Shown):
    """The run that is expected to be the cheapest, `pick`, and the next ones."""

    def table(self) -> str:
        """What `hbvm cost --digits` prints."""
        return self._text


def cost(
    scene: SceneLike,
    *,
    digits: int,
    until: Exact = 10,
    quantity: str = "all",
    methods: Sequence[str] = (),
    precisions: Sequence[str] = (),
    progress: Progress = None,
) -> Plan:
    """Finds the method, the step and the precision that reach so many right digits soonest.

    quantity   what must have them: "q", "p", "lambda" or "all"
    methods    those to choose from; without, all that the planner knows

    >>> import hbvm
    >>> plan = hbvm.cost("simple_pendulum", digits=12, until=1)
    >>> plan.measured.error < 1e-12, plan.pick.method in plan.run
    (True, True)
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        made, text = _hbvm.plan(
            scene=found._raw(),
            until=exact_text(until, "until"),
            digits=digits,
            quantity=quantity,
            methods=list(methods),
            precisions=list(precisions),
            progress=callback,
        )
    return Plan(json.loads(made), text)


Plan.__module__ = "hbvm"
