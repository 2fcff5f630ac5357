"""Coefficients of methods of any family, held against their order conditions."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Mapping, Union

from . import _hbvm
from ._number import exact_text
from ._record import Shown


class Coefficients(Shown):
    """What order conditions say of coefficients: orders, facts, and the entries that are wrong.

    >>> import hbvm
    >>> leapfrog = hbvm.coefficients({"a": ["1/2", "1/2"], "b": [1]})
    >>> leapfrog.family, leapfrog.orders[0].order, leapfrog.holds
    ('splitting', 2, True)
    """

    def __init__(self, facts: dict[str, Any], text: str, mended: str) -> None:
        super().__init__(facts, text)
        self._mended = mended

    @property
    def mended(self) -> str:
        """The mended coefficients in TOML; empty if nothing is to be mended, or it is not determined."""
        return self._mended

    def __reduce__(self) -> Any:
        return Coefficients, (self._facts, self._text, self._mended)


def coefficients(
    subject: Union[str, os.PathLike[str], Mapping[str, Any]],
    *,
    order: int | None = None,
    embedded_order: int | None = None,
) -> Coefficients:
    """Holds coefficients against their order conditions, and finds one or two entries that are wrong.

    subject         a file in TOML or JSON, or of a printed tableau; or the arrays by their names, {"A": ..., "b": ...}
    order           that is claimed; embedded_order likewise

    >>> import hbvm
    >>> heun = hbvm.coefficients({"A": [[0, 0], [1, 0]], "b": ["1/2", "1/3"]}, order=2)
    >>> [(wrong.entry, wrong.exact) for wrong in heun.repair]
    [('b[2]', '1/2')]
    """
    if not isinstance(subject, Mapping):
        return _judged(os.fspath(subject), order, embedded_order)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "coefficients.json")
        with open(file, "w", encoding="utf-8") as stream:
            json.dump({key: _texts(value, key) for key, value in subject.items()}, stream)
        return _judged(file, order, embedded_order)


def _judged(file: str, order: int | None, embedded_order: int | None) -> Coefficients:
    found, text, mended = _hbvm.audit_scheme(file, order, embedded_order)
    return Coefficients(json.loads(found), text, mended)


def _texts(value: Any, key: str) -> Any:
    """Numbers of an array as exact text; what is stated stays as it is."""
    if isinstance(value, str) or isinstance(value, int):
        return value
    return [exact_text(x, f"an entry of {key}") if not hasattr(x, "__iter__") or isinstance(x, str) else _texts(x, key)
            for x in value]


Coefficients.__module__ = "hbvm"
