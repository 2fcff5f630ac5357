"""How a motion changes with its start, and when its events come."""
from __future__ import annotations

from typing import Sequence

from . import _hbvm
from ._number import Exact, Number, exact_text
from ._progress import Bar, Progress
from ._record import Made
from ._run import Precision
from ._scene import SceneLike
from ._scene import scene as scene_of


class Tangent(Made):
    """Lyapunov exponents, digits lost, horizons, and the map of changes of the start to changes of the end."""


def tangent(
    scene: SceneLike,
    method: str = _hbvm.usual_method,
    *,
    step: Exact | None = None,
    until: Exact,
    precision: Precision = "double",
    constants: Sequence[str] = (),
    progress: Progress = None,
) -> Tangent:
    """How the end of a motion changes with its start: the derivative of the method's steps.

    precision   derivatives have its digits; more than twice as many are used
    constants   of the scene: how the end changes with each, in `sensitivities`

    >>> import hbvm
    >>> found = hbvm.tangent("henon_heiles", "hbvm:4,4", step="1/4", until=20)
    >>> len(found.exponents), [horizon.precision for horizon in found.horizon][:2]
    (4, ['double', 'mpfr:34'])
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        made = _hbvm.tangent(
            scene=found._raw(),
            method=method,
            step=None if step is None else exact_text(step, "step"),
            until=exact_text(until, "until"),
            precision=str(precision),
            constants=list(constants),
            progress=callback,
        )
    return Tangent(made)


def reference_events(
    scene: SceneLike, *, until: Exact, digits: int = 30, progress: Progress = None
) -> list[tuple[str, str, Number]]:
    """The events of a scene until some time, as (name, "up" or "down", t), to more digits than are asked for. Both
    routes of a reference agree on the states in which their values are 0.

    >>> import hbvm
    >>> pendulum = hbvm.scene("simple_pendulum").event("swing up: bob.x")
    >>> [(name, way, t.text[:22]) for name, way, t in hbvm.reference_events(pendulum, until=7, digits=20)]
    [('swing', 'up', '6.74300141925038417148')]
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        events = _hbvm.reference_events(
            scene=found._raw(), until=exact_text(until, "until"), digits=digits, progress=callback
        )
    return [(name, "up" if rises else "down", Number(t)) for name, rises, t in events]


Tangent.__module__ = "hbvm"
