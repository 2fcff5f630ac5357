"""Solutions with as many digits as asked for."""
from __future__ import annotations

import functools
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any, Sequence, Union

from . import _hbvm
from ._against import Against, Names, Results, against
from ._errors import InputError
from ._facts import precision_of
from ._number import Exact, exact_text
from ._progress import Bar, Progress
from ._record import Record
from ._scene import SceneLike
from ._scene import scene as scene_of

if TYPE_CHECKING:
    from mpmath import mpf

    from ._arrays import Numbers


class Reference(Record):
    """States whose digits are found by two routes that share only the scene, or are proved.

    `t`, `H` and `agreed` have an entry for each time. So have `q`, `p` and `lambda_`, which are lists of arrays with
    names: `ref.q[-1]["a.x"]`. The records in `times` have all else.

    >>> import hbvm
    >>> ref = hbvm.reference("kepler", at=[1, 2], digits=30)
    >>> ref.t, ref.agreed[0] > 30
    (Numbers(['1',
             '2']), True)
    >>> ref.q[-1]["planet.x"]
    -1.205725352376450721580365884623
    """

    def __init__(self, facts: dict[str, Any], scene: tuple[str, str], proof: str = "") -> None:
        super().__init__(facts)
        self._scene = scene
        self._proof = proof

    @property
    def proof(self) -> str:
        """What proves the digits, as the text of a file for `check_proof`. Empty if they are not proved."""
        return self._proof

    def _vectors(self, key: str) -> list[Numbers]:
        from ._arrays import Numbers

        return [Numbers(state[key], self._facts["names"][key]) for state in self._facts["times"]]

    @property
    def t(self) -> Numbers:
        """The times; as they were asked for they are in `times`."""
        from ._arrays import Numbers

        precision = precision_of(self._facts["digits"])
        return Numbers([_hbvm.decimal(state["t"], precision) for state in self._facts["times"]])

    @property
    def q(self) -> list[Numbers]:
        """Positions at each time."""
        return self._vectors("q")

    @property
    def p(self) -> list[Numbers]:
        """Momenta at each time, tangential."""
        return self._vectors("p")

    @property
    def lambda_(self) -> list[Numbers]:
        """Multipliers at each time."""
        return self._vectors("lambda")

    @property
    def H(self) -> Numbers:
        """The energy at each time."""
        from ._arrays import Numbers

        return Numbers([state["H"] for state in self._facts["times"]])

    @property
    def agreed(self) -> list[int | None]:
        """Digits on which all routes agree, at each time; None of one route alone."""
        return [state["agreed"] for state in self._facts["times"]]

    def against(
        self,
        *results: Results,
        columns: Names = None,
        steps: Sequence[Exact] = (),
        cost: bool = False,
        progress: Progress = None,
    ) -> Against:
        """How many digits of results of any program are right, at their own times.

        results   a CSV file or its text, a DataFrame, a dict of columns, an array, or a run
        columns   what their columns are, {theirs: ours}: theirs an expression in their names, ours "t" or a name of q,
                  p or a velocity, {"sin(theta)": "bob.x"}. Of an array the names of its columns, ["t", "bob.x"].
        steps     that each was made with: the order of convergence is told then
        cost      also plan the cheapest run with as many digits as the best of them, which may take minutes

        >>> import hbvm
        >>> ref = hbvm.reference("kepler", at=2, digits=20)
        >>> mine = [hbvm.run("kepler", "verlet", step=step, until=2) for step in ("1/64", "1/128")]
        >>> found = ref.against(*mine, steps=("1/64", "1/128"))
        >>> abs(found.orders[0] - 2) < 0.1
        True
        >>> found.files[0].mostly
        'along the motion, which keeps H and the constraints better, as where it runs late'
        """
        return against(_hbvm.Scene(*self._scene), results, columns, steps, cost, progress)

    def table(self) -> str:
        """Names and numbers with all digits, time by time."""
        text = ""
        for state in self._facts["times"]:
            rows = []
            for key in ("q", "p", "lambda"):
                rows += [[key, name, value] for name, value in zip(self._facts["names"][key], state[key])]
            rows.append(["H", "", state["H"]])
            agreed = state["agreed"]
            confirmed = f"the routes agree in {agreed} digits" if agreed is not None else "one route: not confirmed"
            if "radius" in state:
                confirmed = f"proved: q is within {state['radius']['q']} of the number that was rounded"
            text += _hbvm.table_text(f"t = {state['t']}; {confirmed}", ["", "name", "value"], rows, "text")
        return text

    def __repr__(self) -> str:
        return self.table().rstrip("\n")

    def __reduce__(self) -> Any:
        return Reference, (self._facts, self._scene, self._proof)


def _times(at: Any) -> list[str]:
    several = not isinstance(at, str) and hasattr(at, "__iter__")
    return [exact_text(time, "a time of the reference") for time in (at if several else [at])]


def reference(
    scene: SceneLike,
    *,
    at: Union[Exact, Sequence[Exact]],
    digits: int = 30,
    route: str = "",
    prove: bool = False,
    force: bool = False,
    progress: Progress = None,
) -> Reference:
    """The motion at one time or several, with so many digits after the leading one of each vector's greatest component.

    route   "taylor", "hbvm" or "closed_form" alone: nothing is confirmed then
    prove   prove the digits, by bounds of the motion step by step, in place of two routes that agree
    force   do also what is expected to take more than a day, or 16 GB

    >>> import hbvm
    >>> hbvm.reference("simple_pendulum", at=1, digits=20, prove=True).proved
    20
    """
    found = scene_of(scene)
    with Bar(progress, found.name) as callback:
        made, proof = _hbvm.reference(
            scene=found._raw(),
            times=_times(at),
            digits=digits,
            route=route,
            force=force,
            prove=prove,
            progress=callback,
        )
    return Reference(json.loads(made), (found.toml, found.name), proof)


def check_proof(proof: str | os.PathLike[str], *, progress: Progress = None) -> Reference:
    """Goes through a proof again, each step by itself, and returns the reference that it proves.

    proof   a file, as `hbvm reference --prove --out FILE.proof` writes it, or its text, `Reference.proof`

    >>> import hbvm
    >>> ref = hbvm.reference("simple_pendulum", at=1, digits=12, prove=True)
    >>> hbvm.check_proof(ref.proof).q[0].text == ref.q[0].text
    True
    """
    text, name = str(proof), "proof"
    if "\n" not in text:
        name = text
        try:
            text = pathlib.Path(name).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"{name} cannot be read: {error}") from None
    with Bar(progress, "check") as callback:
        made, toml, scene_name = _hbvm.check_proof(text=text, name=name, progress=callback)
    return Reference(json.loads(made), (toml, scene_name), text)


@functools.lru_cache(maxsize=32)
def exact_end(toml: str, name: str, until: str, digits: int) -> tuple[list[mpf], list[mpf], float]:
    """q and p at the end of a motion, and by how many decimal digits it magnifies errors."""
    found = reference(scene_of(toml, name), at=until, digits=digits)
    return found.q[0].exact, found.p[0].exact, max(0.0, found.digits_lost)


Reference.__module__ = "hbvm"
