"""Runs."""
from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Sequence, Union

from . import _hbvm
from ._columns import Columns
from ._errors import IntegrationError, Interrupted
from ._number import Exact, exact_text
from ._page import Page
from ._progress import Bar, Progress
from ._record import Record
from ._scene import SceneLike
from ._scene import scene as scene_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from ._arrays import Numbers

Precision = Union[str, int]
_kept: Columns | None = None


def kept() -> Columns | None:
    """The mesh points of the last run, if it was interrupted or could not go on."""
    return _kept


class Run(Record):
    """What came out of a run: the program's JSON by attribute, and the trajectory by column.

    `t` and `run["a.x"]` are arrays of float64 that know all digits. `q`, `p` and `lambda_` are the state at the end,
    with names: `run.q["a.x"]`. `e_H`, `e_g` and `e_hid` are the greatest errors at mesh points.

    >>> import hbvm
    >>> run = hbvm.run("kepler", "hbvm:4,2", step="1/16", until=2, precision="mpfr:50")
    >>> len(run.t), run["planet.x"][-1] == run.q["planet.x"]
    (33, True)
    >>> len(run.q["planet.x"].text) > 50
    True
    >>> run.e_H < 1e-11
    True
    """

    def __init__(self, made: dict[str, Any], asked: dict[str, Any]) -> None:
        super().__init__(json.loads(made["json"]))
        self._made = made
        self._asked = asked

    @property
    def trajectory(self) -> Columns:
        """The mesh points."""
        return Columns(self._made["trajectory"])

    @property
    def columns(self) -> list[str]:
        """The names of the columns of the trajectory."""
        return self.trajectory.columns

    def __getitem__(self, name: str) -> Any:
        """A column of the trajectory, or what the JSON has under a key."""
        if name in self._made["trajectory"].columns:
            return self.trajectory[name]
        if name in self._facts:
            return super().__getitem__(name)
        return self.trajectory[name]

    @property
    def t(self) -> Numbers:
        """The times of the trajectory; without one, that of the end."""
        from ._arrays import Numbers

        return self.trajectory["t"] if len(self.trajectory) else Numbers([self._facts["t"]])

    @property
    def states(self) -> Columns:
        """The same as `trajectory`: what the JSON calls so."""
        return self.trajectory

    @property
    def energy_error(self) -> Numbers:
        """H - H_0 along the trajectory."""
        return self.trajectory["delta_H"]

    def _state(self, texts: list[str], names: str) -> Numbers:
        from ._arrays import Numbers

        return Numbers(texts, self._facts["names"][names])

    @property
    def q(self) -> Numbers:
        """Positions at the end, by name or number."""
        return self._state(self._facts["q"], "q")

    @property
    def p(self) -> Numbers:
        """Momenta at the end, as the method propagates them; `output.p` are tangential."""
        return self._state(self._facts["p"], "p")

    @property
    def lambda_(self) -> Numbers:
        """Multipliers at the end, by the constraint of each."""
        return self._state(self._facts["lambda"], "lambda")

    @property
    def warnings(self) -> list[Record]:
        """What a user should know of."""
        return self.health.warnings

    def to_pandas(self, dtype: type = float) -> pandas.DataFrame:
        """The trajectory as a DataFrame: of float64, or with `dtype=object` of mpmath's numbers with all digits."""
        return self.trajectory.to_pandas(dtype)

    def to_csv(self, file: str | os.PathLike[str] | None = None) -> str | None:
        """Writes the trajectory with all digits, or returns it as text."""
        return self.trajectory.to_csv(file)

    def _with_picture(self) -> dict[str, Any]:
        """A picture that was not asked for is made by the same run once more."""
        if "figure" not in self._made:
            again = _made({**self._asked, "picture": True, "every": 0}, None)
            self._made["figure"], self._made["page"] = again["figure"], again["page"]
        return self._made

    def plot(self) -> Figure:
        """Motion, multipliers and errors, by matplotlib. It runs once more, unless run() had `picture=True`."""
        from ._figure import drawn

        return drawn(self._with_picture()["figure"])

    def animate(self) -> Page:
        """The page on which the motion moves beside its errors, as `hbvm run --plot FILE.html` writes it."""
        return Page(self._with_picture()["page"])

    def table(self, state: bool = False) -> str:
        """What `hbvm run` prints; with `state`, all digits of the end."""
        return self._made["state" if state else "text"]

    def __repr__(self) -> str:
        return self.table().rstrip("\n")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Run) and self._facts == other._facts

    def __reduce__(self) -> Any:
        return Run, (self._made, {**self._asked, "scene": _Pickled(self._asked["scene"])})


class _Pickled:
    """Stands for the scene of a run that was pickled."""

    def __init__(self, raw: Any) -> None:
        self.toml, self.name = (raw.toml, raw.name) if isinstance(raw, _Pickled) else (raw.toml(), raw.name)

    def raw(self) -> Any:
        return _hbvm.Scene(self.toml, self.name)


def _made(asked: dict[str, Any], progress: Progress) -> dict[str, Any]:
    global _kept
    if isinstance(asked["scene"], _Pickled):
        asked = {**asked, "scene": asked["scene"].raw()}
    points: list[Any] = []
    _kept = None
    with Bar(progress, asked["scene"].name) as callback:
        try:
            return _hbvm.run(**asked, kept=points, progress=callback)
        except KeyboardInterrupt:
            _kept = Columns(points[0]) if points else None
            when = f" at t = {_kept['t'][-1]:.6g}" if _kept else ""
            end = Interrupted(f"the run was interrupted{when}; hbvm.kept() has its mesh points until then")
            end.trajectory = _kept
            raise end from None
        except IntegrationError as end:
            _kept = Columns(points[0]) if points else None
            end.trajectory = _kept
            raise


def _start(start: Run | str | None) -> str:
    if start is None:
        return ""
    return start.json if isinstance(start, Run) else start


def run(
    scene: SceneLike,
    method: str = _hbvm.usual_method,
    *,
    step: Exact | None = None,
    until: Exact,
    precision: Precision = "double",
    solver: str = "auto",
    on_failure: str = "stop",
    reverse: bool = False,
    account: bool = False,
    shadow: bool = False,
    horizon: bool = False,
    error: bool = False,
    prove: bool = False,
    start: Run | str | None = None,
    picture: bool = False,
    portraits: Sequence[tuple[str, str]] = (),
    linear_energy: bool = False,
    every: int = 1,
    at: Exact | Sequence[Exact] = (),
    every_time: Exact | None = None,
    until_event: str | None = None,
    progress: Progress = None,
) -> Run:
    """Integrates a scene.

    step        the last is shortened if `until` is no multiple; without, one that suits the scene
    precision   "double", "quad", or "mpfr:50" or 50 for so many digits
    solver      of the stage equations: "auto", "newton", "fixed-point" or "paper"
    on_failure  "stop", or "halve": a step that cannot be made is divided
    account     tell where the time goes
    shadow      tell how many digits survived rounding
    horizon     tell how many digits of the start are lost by each time, in `health.horizon`
    error       tell how many digits are right
    prove       prove what the method does without rounding, in `proved`
    start       a run, or its JSON, from whose end this one goes on
    picture     keep what plot() and animate() show
    portraits   pairs of what the picture draws against one another: ("a.x", "a.px")
    every       steps between two rows of the trajectory; 0: none is kept
    at          times at which the state is told, too, in `at`; they need be no mesh points
    every_time  and the multiples of this
    until_event the run ends at the event of this name that the scene has, or at its third, "turn,3"
    progress    a callable f(done, of), or True for a bar of tqdm

    Ctrl-C ends it after a step, with `Interrupted`; `hbvm.kept()` then has the mesh points.

    >>> import hbvm
    >>> run = hbvm.run("double_pendulum", "hbvm:4,2", step="1/16", until=1, precision=30)
    >>> run.q["a.x"]
    0.7955498760973122607964620595837

    >>> pendulum = hbvm.scene("simple_pendulum").event("swing up: bob.x")
    >>> run = hbvm.run(pendulum, "hbvm:8,8", step="1/4", until=30, at=["1/3"])
    >>> round(float(run.events[0].t), 9), run.periods[0].crossings, run.at[0].t
    (6.743001419, 4, 0.3333333333333333)
    """
    asked = {
        "scene": scene_of(scene)._raw(),
        "method": method,
        "step": None if step is None else exact_text(step, "step"),
        "until": exact_text(until, "until"),
        "precision": str(precision),
        "solver": solver,
        "on_failure": on_failure,
        "reverse": reverse,
        "account": account,
        "shadow": shadow,
        "horizon": horizon,
        "error": error,
        "prove": prove,
        "start": _start(start),
        "picture": picture,
        "portraits": list(portraits),
        "linear_energy": linear_energy,
        "every": every,
        "at": [exact_text(t, "at") for t in ([at] if isinstance(at, str) or not isinstance(at, Sequence) else at)],
        "every_time": None if every_time is None else exact_text(every_time, "every_time"),
        "until_event": until_event,
    }
    return Run(_made(asked, progress), asked)


Run.__module__ = "hbvm"
