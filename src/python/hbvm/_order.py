"""The order of a method of one's own, measured above round-off."""
from __future__ import annotations

import inspect
import math
from typing import TYPE_CHECKING, Any, Callable, Iterator, NamedTuple

from . import _hbvm
from ._errors import InputError
from ._number import Exact, Number, exact_text, mpf_of
from ._reference import exact_end
from ._run import run as made_run
from ._scene import SceneLike
from ._scene import scene as scene_of

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure

    from ._scene import Scene

_COARSEST = 4  # of the steps that suit the scene
_STEPS = 4  # of the coarsest, to the end
_GUARD = 15  # digits of the reference beyond those of the method
_SPREADS = 8  # what is taken for round-off, over what it moved the end by
_STARTS = 3  # that differ by round-off


class Rung(NamedTuple):
    """An error at one step."""

    step: Number
    error: float  #: log2 of the error, over the greatest coordinate
    floor: float  #: log2 of what round-off explains of it

    @property
    def is_clean(self) -> bool:
        """Whether it is above round-off."""
        return self.error > self.floor


class Order:
    """The order that was measured, whether it is the one that is claimed, and the errors at each step.

    `verdict` is "holds", "fails" or "undecidable". `rate` and `uncertainty` are None if too few errors are above
    round-off. `message` says it in words.
    """

    def __init__(self, claimed: float, rungs: dict[str, list[Rung]], tolerance: float) -> None:
        #: The order that is claimed.
        self.claimed = claimed
        #: Errors of "q" and of "p", from coarse to fine.
        self.rungs = rungs
        self._tolerance = tolerance
        self._rates = {part: _rate(ladder) for part, ladder in rungs.items()}
        verdicts = {part: _hbvm.order_verdict(rate, claimed) for part, rate in self._rates.items()}
        worst = ("fails", "undecidable", "holds")
        #: "q" or "p", of which the rest is told: that which is worse.
        self.part = min(verdicts, key=lambda part: (worst.index(verdicts[part]), (self._rates[part] or (0, 0))[0]))
        self.verdict: str = verdicts[self.part]
        rate = self._rates[self.part]
        self.rate: float | None = rate[0] if rate else None
        self.uncertainty: float | None = rate[1] if rate else None

    @property
    def holds(self) -> bool:
        """Whether it has the order that is claimed, or a higher one."""
        return self.verdict == "holds"

    @property
    def message(self) -> str:
        """What was found, over which steps, and what was left out."""
        ladder = self.rungs[self.part]
        clean = [rung for rung in ladder if rung.is_clean]
        if not clean:
            return f"no error of {self.part} is above round-off: the steps are too short, or the method is exact"
        over = f"over h = {_step(clean[0].step)} ... {_step(clean[-1].step)}"
        if self.rate is None:
            text = f"the order of {self.part} cannot be told {over}: it takes five errors above round-off"
        elif math.isinf(self.uncertainty or 0):
            text = f"errors of {self.part} follow no power of the step {over}"
        else:
            text = f"order {self.rate:.2f} +- {self.uncertainty:.2f} of {self.part} {over}"
        if self.verdict != "holds" or (self.rate or 0) > self.claimed + 0.5:
            text += f", and {self.claimed:g} is claimed"
        return text + self._left_out(ladder) + self._advice(clean)

    def _left_out(self, ladder: list[Rung]) -> str:
        below = [rung for rung in ladder if not rung.is_clean]
        if not below:
            return ""
        what = "below the tolerance" if self._tolerance else "round-off"
        number = _WORDS[len(below)] if len(below) < len(_WORDS) else str(len(below))
        if len(below) == 1:
            return f"; the finest step is {what} and was left out"
        return f"; the {number} finest steps are {what} and were left out"

    def _advice(self, clean: list[Rung]) -> str:
        if self.verdict == "holds":
            return ""
        if self.rate is None:
            return ". More digits (digits=50) or a later end (until=) leave room for more steps"
        percent = -6.6
        if abs(self.rate) < 0.25 and clean[-1].error > percent:
            return ". Errors do not fall: the method computes another motion than the scene's"
        slopes = [a.error - b.error for a, b in zip(clean, clean[1:])]
        if len(slopes) > 3 and slopes[-1] < 0.5 < slopes[0]:
            size = 2 ** clean[-1].error
            return (
                f". Errors stop falling at {size:.1e}, above round-off: a wrong digit of a coefficient, or what an "
                "iteration leaves (say tolerance= then)"
            )
        return ""

    def table(self) -> str:
        """Errors at each step, and the slopes between them."""
        rows = []
        ladders = list(self.rungs.items())
        for number in range(max(len(ladder) for _, ladder in ladders)):
            row = [_step(ladders[0][1][number].step)]
            for _, ladder in ladders:
                rung = ladder[number]
                slope = f"{ladder[number - 1].error - rung.error:.2f}" if number else ""
                row += [f"{_power(rung.error)}", slope if rung.is_clean else "round-off"]
            rows.append(row)
        columns = ["step"] + [column for part, _ in ladders for column in (f"error of {part}", "slope")]
        return _hbvm.table_text(f"{self.verdict}: {self.message}", columns, rows, "text")

    def __repr__(self) -> str:
        return self.table().rstrip("\n")

    def __bool__(self) -> bool:
        return self.holds

    def plot(self) -> Figure:
        """Errors against the step, what round-off explains of them, and the slope that is claimed."""
        import matplotlib
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(figsize=(5.4, 4.2))
        for part, ladder in self.rungs.items():
            steps = [math.log2(rung.step) for rung in ladder]
            (line,) = axes.plot(steps, [rung.error for rung in ladder], marker="o", label=f"error of {part}")
            axes.plot(steps, [rung.floor for rung in ladder], linestyle=":", color=line.get_color(), linewidth=1)
        clean = [rung for rung in self.rungs[self.part] if rung.is_clean] or self.rungs[self.part]
        start, end = math.log2(clean[0].step), math.log2(clean[-1].step)
        slope = [clean[0].error, clean[0].error + self.claimed * (end - start)]
        axes.plot([start, end], slope, color="black", linestyle="--", linewidth=1, label=f"slope {self.claimed:g}")
        axes.xaxis.set_major_formatter(lambda value, _: f"$2^{{{value:g}}}$")
        axes.yaxis.set_major_formatter(lambda value, _: f"$10^{{{value * math.log10(2):.0f}}}$")
        axes.set(xlabel="step h", ylabel="error at the end, relative", title=self.verdict)
        axes.legend()
        figure.tight_layout()
        if "inline" in matplotlib.get_backend().lower():
            plt.close(figure)
        return figure


_WORDS = ("no", "one", "two", "three", "four", "five", "six")


def _rate(ladder: list[Rung]) -> tuple[float, float] | None:
    return _hbvm.measured_rate([(math.log2(rung.step), rung.error, rung.floor) for rung in ladder])


def _step(step: Number) -> str:
    parts = 1 / step
    return f"1/{parts:.0f}" if parts > 1.5 and parts == round(parts) else f"{float(step):.6g}"


def _power(log2: float) -> str:
    exponent = math.floor(log2 * math.log10(2))
    return f"{10 ** (log2 * math.log10(2) - exponent):.2f}e{exponent:+03d}" if math.isfinite(log2) else "0"


def _log2(value: Any) -> float:
    if not value:
        return -math.inf
    if isinstance(value, float):
        return math.log2(value)
    from mpmath import libmp

    _, mantissa, exponent, bits = value._mpf_
    return math.log2(libmp.to_float((0, mantissa, -bits, bits))) + int(exponent) + int(bits)


class _Arithmetic:
    """float64, or mpmath's numbers with so many digits: how vectors of them are made and compared."""

    def __init__(self, digits: int | None) -> None:
        self.digits = digits
        self.precision = "double" if digits is None else _hbvm.precision_name(f"mpfr:{max(digits, 20)}")
        self.log2_epsilon = -52.0 if digits is None else -math.log2(10) * digits

    def scope(self) -> Any:
        if self.digits is None:
            import numpy as np

            return np.errstate(all="ignore")
        import mpmath

        return mpmath.workdps(self.digits)

    def number(self, text: str) -> Any:
        return float(text) if self.digits is None else +mpf_of(text)

    def vector(self, texts: list[str]) -> np.ndarray:
        import numpy as np

        return np.array([self.number(text) for text in texts], dtype=float if self.digits is None else object)

    def moved(self, vector: np.ndarray, which: int) -> np.ndarray:
        """The vector with round-off in it, of a sign that differs from entry to entry."""
        epsilon = 2.0**-52 if self.digits is None else 2 ** self.number(str(self.log2_epsilon))
        signs = [(1, -1)[(i * (2 * which + 1) // 2 + which) % 2] for i in range(len(vector))]
        import numpy as np

        return vector + vector * epsilon * np.array(signs)


def _log2_size(vector: Any) -> float:
    """Of its length: a smooth function of the entries."""
    logs = [_log2(abs(entry)) for entry in vector]
    most = max(logs, default=-math.inf)
    if not math.isfinite(most):
        return most
    return most + math.log2(sum(4.0 ** (log - most) for log in logs)) / 2


def _exact(vector: Any, length: int, what: str) -> list[Any]:
    """The entries as mpmath's numbers. None if one is not finite."""
    from mpmath import isfinite, mp

    entries = list(vector)
    if len(entries) != length:
        raise InputError(f"{what} has {len(entries)} entries, and the scene has {length} coordinates")
    numbers = [mp.mpf(float(x)) if isinstance(x, float) else mp.mpf(x) for x in entries]
    return numbers if all(isfinite(number) for number in numbers) else []


class _Subject:
    """A method of one's own on a scene: it makes the end from a number of steps."""

    def __init__(
        self, method: Callable[..., Any], scene: Scene, arithmetic: _Arithmetic, usual: str, until: str
    ) -> None:
        self._method = method
        self._scene = scene
        self._arithmetic = arithmetic
        self._until = until
        #: Steps of the coarsest run.
        self.fewest = max(_STEPS, math.ceil(float(until) / (_COARSEST * float(_hbvm.decimal(usual, "double")))))
        self.is_stepper = _positional(method) != 2
        run = made_run(scene, step=usual, until=usual, precision=arithmetic.precision)
        self.names = run.names.q, run.names.p
        self._start = [[run[name].text[0] for name in names] for names in self.names]

    def step(self, n: int) -> str:
        return _hbvm.decimal(f"({self._until})/{n}", self._arithmetic.precision)

    def end(self, n: int, moved: int | None = None) -> tuple[Any, Any]:
        h = self._arithmetic.number(self.step(n))
        if not self.is_stepper:
            return self._parts(self._method(self._scene, h))
        q, p = (self._arithmetic.vector(texts) for texts in self._start)
        if moved is not None:
            q, p = self._arithmetic.moved(q, moved), self._arithmetic.moved(p, moved + 1)
        for _ in range(n):
            q, p = self._method(q, p, h)
        return q, p

    def _parts(self, found: Any) -> tuple[Any, Any]:
        """q and p at the end, of a pair or of columns by their names."""
        if isinstance(found, tuple) and len(found) == 2:
            return found
        try:
            q, p = ([list(found[name])[-1] for name in names] for names in self.names)
        except (KeyError, IndexError, TypeError):
            raise InputError(
                f"solve(scene, h) returns q and p at the end, or columns {', '.join(self.names[0] + self.names[1])}"
            ) from None
        return q, p


def _positional(method: Callable[..., Any]) -> int:
    """How many arguments it needs."""
    parameters = inspect.signature(method).parameters.values()
    return sum(
        parameter.default is parameter.empty and parameter.kind in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD)
        for parameter in parameters
    )


def _differences(subject: _Subject, ends: tuple[Any, Any], others: tuple[Any, Any]) -> list[float]:
    """log2 of the distances of q and of p. None where a number is not finite."""
    found = []
    for what, vector, other, names in zip("qp", ends, others, subject.names):
        a, b = _exact(vector, len(names), what), _exact(other, len(names), what)
        if not a or not b:
            return []
        found.append(_log2_size([x - y for x, y in zip(a, b)]))
    return found


def _ladder(
    subject: _Subject, exact: tuple[Any, Any], lost: float, tolerance: float, most_steps: int
) -> Iterator[list[Rung]]:
    """Rungs of q and p, from coarse to fine, until two in a row are round-off."""
    import mpmath

    arithmetic = subject._arithmetic
    sizes = [_log2_size(_exact(vector, len(vector), "")) for vector in exact]
    n, in_round_off = subject.fewest, 0
    while n <= most_steps and in_round_off < 2:
        with arithmetic.scope():
            end = subject.end(n)
        with mpmath.workdps((arithmetic.digits or 16) + 2 * _GUARD):
            errors = _differences(subject, end, exact)
            # What rounding each step may add up to, and what the motion makes of it.
            rounding = arithmetic.log2_epsilon + math.log2(2 + math.sqrt(n)) + lost * math.log2(10)
            floors = [rounding + size for size in sizes]
            near = errors and any(error < floor + 20 for error, floor in zip(errors, floors))
        if near and subject.is_stepper:
            for which in range(_STARTS):
                with arithmetic.scope():
                    moved = subject.end(n, which)
                with mpmath.workdps((arithmetic.digits or 16) + 2 * _GUARD):
                    spread = _differences(subject, moved, end)
                floors = [max(f, s + math.log2(_SPREADS)) for f, s in zip(floors, spread)]
        if errors:
            left = _log2(tolerance)
            floors = [max(floor - size, left) for floor, size in zip(floors, sizes)]
            errors = [error - size for error, size in zip(errors, sizes)]
            rungs = [Rung(Number(subject.step(n)), error, floor) for error, floor in zip(errors, floors)]
            in_round_off = in_round_off + 1 if not any(rung.is_clean for rung in rungs) else 0
            yield rungs
        n *= 2


def verify_order(
    method: Callable[..., Any],
    scene: SceneLike,
    order: float,
    *,
    digits: int | None = None,
    until: Exact | None = None,
    tolerance: float = 0.0,
    most_steps: int | None = None,
) -> Order:
    """Measures the order of a method of one's own, and decides whether it is the one that is claimed.

    method      a stepper, step(q, p, h) -> q, p, or solve(scene, h), which returns q and p at the end, or columns by
                their names, as a DataFrame has them
    digits      of mpmath's numbers that q, p and h are; without, they are float64
    until       the end; without, sixteen steps that suit the scene
    tolerance   relative, of an iteration in the method: errors below say nothing of its order
    most_steps  of the finest run: without, 4096 in float64 and 512 in more digits

    Steps are halved until what is left is round-off. Errors are those against a reference with more digits. What
    round-off explains is measured by starts that differ by it. The judge is that of `hbvm audit`.

    >>> import hbvm, numpy as np
    >>> force = lambda q: -q / np.dot(q, q) ** 1.5
    >>> def verlet(q, p, h):
    ...     p = p + h / 2 * force(q)
    ...     q = q + h * p
    ...     return q, p + h / 2 * force(q)
    >>> found = hbvm.verify_order(verlet, "kepler", order=2)
    >>> found.verdict, round(found.rate, 1)
    ('holds', 2.0)
    >>> hbvm.verify_order(verlet, "kepler", order=4).verdict
    'fails'
    """
    found = scene_of(scene)
    arithmetic = _Arithmetic(digits)
    long_enough = "2^20"
    usual = _hbvm.usual_step(found._raw(), long_enough if until is None else exact_text(until, "until"))
    end = f"{_COARSEST * _STEPS}*({usual})" if until is None else exact_text(until, "until")
    end = _hbvm.decimal(end, arithmetic.precision)
    q, p, lost = exact_end(found.toml, found.name, end, (digits or 16) + _GUARD)
    subject = _Subject(method, found, arithmetic, usual, end)
    rungs = list(_ladder(subject, (q, p), lost, float(tolerance), most_steps or (4096 if digits is None else 512)))
    if not rungs:
        raise InputError("the method gives no finite number at any step")
    return Order(order, {"q": [rung[0] for rung in rungs], "p": [rung[1] for rung in rungs]}, float(tolerance))


Order.__module__ = Rung.__module__ = "hbvm"
