"""Claims about methods, and whether they hold."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Sequence, Union

from . import _hbvm
from ._errors import InputError
from ._number import Exact, exact_text
from ._progress import Bar, Progress
from ._record import Record

Row = Sequence[Exact]


class Audit(Record):
    """Findings, each with its verdict: "holds", "fails", "undecidable", "degenerate" or "not run".

    >>> import hbvm
    >>> heun = hbvm.audit(A=[[0, 0], [1, 0]], b=["1/2", "1/2"], order=2)
    >>> heun.holds
    True
    >>> heun.findings[0].verdict
    'holds'
    """

    @property
    def findings(self) -> list[Record]:
        """What was found out about each claim: the JSON calls them `claims`."""
        return self.claims

    @property
    def holds(self) -> bool:
        """Whether every claim holds."""
        return self.count("holds") == len(self.findings)

    def count(self, verdict: str) -> int:
        """How many findings have this verdict."""
        return sum(finding.verdict == verdict for finding in self.findings)

    def table(self, form: str = "text") -> str:
        """A row a claim, as "text", "markdown", "latex" or "csv"."""
        columns = ["verdict", "quantity", "problem", "method", "claimed", "measured", "precision"]
        rows = []
        for finding in self._facts["claims"]:
            known = {key: "" if value is None else str(value) for key, value in finding.items()}
            measured = _measured(finding)
            row = [known.get(key, "") for key in ("verdict", "quantity", "problem", "method")]
            rows.append([*row, _shown(finding.get("predicted")), measured, known.get("precision", "")])
        return _hbvm.table_text(self._facts["summary"], columns, rows, form)

    def __repr__(self) -> str:
        return self.table().rstrip("\n")

    def __reduce__(self) -> Any:
        return Audit, (self._facts,)


def _shown(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, (int, float)) else str(value or "")


def _measured(finding: dict[str, Any]) -> str:
    value, uncertainty = finding.get("measured"), finding.get("uncertainty")
    if value is None:
        return ""
    return f"{value:.4g} +- {uncertainty:.2g}" if uncertainty else _shown(value)


def _claims_of_text(text: str) -> Any:
    """A text in TOML: claims if it has tables [[claim]], else a tableau."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "text.toml")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)
        return _claims_of_file(file, text)


def _claims_of_file(file: str, text: str) -> Any:
    return _hbvm.read_claims(file) if "[[claim]]" in text else _hbvm.read_tableau_claims(file)


def _claims_about(subject: Any) -> Any:
    if isinstance(subject, str) and "\n" in subject:
        return _claims_of_text(subject)
    name = os.fspath(subject)
    if os.path.isfile(name):
        with open(name, encoding="utf-8") as stream:
            return _claims_of_file(name, stream.read())
    if name in ("paper", "paper:full"):
        return _hbvm.paper_claims(name.endswith("full"))
    return _hbvm.method_claims(name)


def audit(
    subject: Union[str, os.PathLike[str], None] = None,
    *,
    A: Sequence[Row] | None = None,
    b: Row | None = None,
    c: Row | None = None,
    order: int | None = None,
    digits: int | None = None,
    name: str = "tableau",
    until: Exact | None = None,
    jobs: int = 1,
    limit: float = 120,
    coefficient_digits: int = 1000,
    progress: Progress = None,
) -> Audit:
    """Decides what is claimed of a method, with as many digits as it takes.

    subject   a method of the program, "hbvm:4,2"; a file or a text in TOML with a tableau or with claims; or "paper"
    A, b, c   a Runge-Kutta tableau instead, of exact numbers; c are the row sums of A if it is absent
    order     that its author claims
    digits    to which its author gives the numbers that are decimals
    until     look at all of the motion up to this time
    limit     seconds of processor time that a claim may take; 0: any

    >>> import hbvm
    >>> wrong = hbvm.audit(A=[[0, 0], [1, 0]], b=["1/2", "1/3"], order=2)
    >>> wrong.holds, wrong.findings[0].reason
    (False, 'the conditions of order 1 are met to 0 digits only')
    """
    if (subject is None) == (A is None or b is None):
        raise InputError("audit takes a method, a file or a text, or else a tableau by A and b")
    if subject is not None:
        claims = _claims_about(subject)
    else:
        matrix = [[exact_text(a, "an entry of A") for a in row] for row in A or []]
        weights = [exact_text(weight, "an entry of b") for weight in b or []]
        nodes = [exact_text(node, "an entry of c") for node in c] if c is not None else []
        claims = _hbvm.tableau_claims(name, matrix, weights, nodes, order, digits)
    with Bar(progress, "audit") as callback:
        found = _hbvm.audit(
            claims=claims,
            jobs=jobs,
            limit=limit,
            until=None if until is None else exact_text(until, "until"),
            coefficient_digits=coefficient_digits,
            progress=callback,
        )
    return Audit(json.loads(found))


Audit.__module__ = "hbvm"
