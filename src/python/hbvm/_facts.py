"""Methods there are, and nodes."""
from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _hbvm
from ._record import Listing, Record

if TYPE_CHECKING:
    from ._arrays import Numbers


class Nodes(NamedTuple):
    """Gauss-Legendre abscissae c and weights b on [0, 1]."""

    c: Numbers
    b: Numbers
    precision: str


def precision_of(digits: int) -> str:
    """The cheapest precision with so many decimal digits.

    >>> import hbvm
    >>> hbvm.precision_of(12), hbvm.precision_of(50)
    ('double', 'mpfr:50')
    """
    least = 20
    if digits <= 15:
        return "double"
    return _hbvm.precision_name(f"mpfr:{max(digits, least)}")


def nodes(n: int, *, digits: int = 15) -> Nodes:
    """Gauss-Legendre abscissae and weights with so many digits.

    >>> import hbvm
    >>> hbvm.nodes(3, digits=50).c.text[1]
    '0.5'
    """
    from ._arrays import Numbers

    precision, c, b = _hbvm.nodes(n, precision_of(digits))
    return Nodes(Numbers(c), Numbers(b), precision)


def methods() -> Listing:
    """The methods there are, and what each keeps.

    >>> import hbvm
    >>> [kind.order for kind in hbvm.methods() if kind.name == "hbvm"]
    ['2S']
    """
    found, text = _hbvm.methods()
    kinds: Any = json.loads(found)
    return Listing([Record(kind) for kind in kinds["methods"]], text)


Nodes.__module__ = "hbvm"
