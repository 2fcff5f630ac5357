"""Where motions cross a surface, and which of them come back to their start."""
from __future__ import annotations

import json
from typing import Sequence

from . import _hbvm
from ._number import Exact, exact_text
from ._page import Page
from ._progress import Bar, Progress
from ._record import Made, Shown
from ._run import Precision
from ._scene import SceneLike
from ._scene import scene as scene_of


class Section(Made):
    """Points where motions cross a surface: `orbits` has an entry for each start, with its `points`."""

    @property
    def csv(self) -> str:
        """A line a point."""
        return self._made["csv"]

    def page(self) -> Page:
        """The page on which a click on a point shows its orbit."""
        return Page(self._made["page"])


class Periodic(Shown):
    """A motion that comes back to its start: `q`, `p`, `period`, and the multipliers of its changes."""


def section(
    scene: SceneLike,
    plane: str,
    axes: tuple[str, str],
    *,
    starts: Sequence[str] = (),
    direction: str = "up",
    method: str = _hbvm.usual_method,
    step: Exact | None = None,
    until: Exact,
    precision: Precision = "double",
    jobs: int = 1,
    progress: Progress = None,
) -> Section:
    """Poincare's section: where many motions of a scene cross the surface on which `plane` is 0.

    plane, axes   formulas of what may be observed, as "a.x - b.x"
    starts        what the motions differ by, as "y0=-3/10:6/10:12" or "y0=0.1,0.2": all combinations
    direction     crossings that count: "up", "down" or "any"

    >>> import hbvm
    >>> found = hbvm.section("henon_heiles", "star.x", ("star.y", "star.vy"), step="1/4", until=20)
    >>> len(found.orbits), len(found.orbits[0].points)
    (1, 3)
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        made = _hbvm.section(
            scene=found._raw(),
            plane=plane,
            direction=direction,
            axes=tuple(axes),
            starts=list(starts),
            method=method,
            step=None if step is None else exact_text(step, "step"),
            until=exact_text(until, "until"),
            precision=str(precision),
            jobs=jobs,
            progress=callback,
        )
    return Section(made)


def periodic(
    scene: SceneLike, *, until: Exact, plane: str | None = None, digits: int = 30, progress: Progress = None
) -> Periodic:
    """A motion that comes back to its start, near that of the scene and of the same H.

    until   before which the scene's motion comes back near its start
    plane   a formula that is 0 at the start that is looked for

    >>> import hbvm
    >>> found = hbvm.periodic("henon_heiles", until=8)
    >>> found.period, found.stable
    (6.07561578432290161291645547481, True)
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        made, text = _hbvm.periodic(
            scene=found._raw(), until=exact_text(until, "until"), plane=plane, digits=digits, progress=callback
        )
    return Periodic(json.loads(made), text)


Section.__module__ = Periodic.__module__ = "hbvm"
