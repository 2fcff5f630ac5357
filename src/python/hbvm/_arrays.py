"""Columns of numbers as arrays."""
from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING, Any, Callable, Sequence

import numpy as np

from ._errors import InputError
from ._number import Number, mpf_of

if TYPE_CHECKING:
    from mpmath import mpf


class Numbers(np.ndarray):
    """A read-only array of float64 that knows all digits: `text`, `exact` and `decimal` have them.

    An entry or a slice keeps its digits, and so does an entry by its name, where entries have names. What is computed
    with the array is a plain array.

    >>> import hbvm
    >>> c = hbvm.nodes(2, digits=30).c
    >>> c
    Numbers(['0.2113248654051871177454256097490212721761991243649365619906988368',
             '0.7886751345948128822545743902509787278238008756350634380093011632'])
    >>> c.sum()
    1.0
    >>> c.exact[0] + c.exact[1]
    mpf('1.0')
    """

    _texts: Any
    #: What the entries are called, or None.
    names: list[str] | None

    def __new__(
        cls,
        texts: Sequence[str] | Callable[[], Sequence[str]],
        names: Sequence[str] | None = None,
        values: np.ndarray | None = None,
    ) -> Numbers:
        if values is None:
            values = np.array([float(text) for text in texts], dtype=np.float64)  # type: ignore[union-attr]
        self = values.view(cls)
        self._texts = texts
        self.names = list(names) if names is not None else None
        self.flags.writeable = False
        return self

    def __array_finalize__(self, source: Any) -> None:
        self._texts = None
        self.names = None

    @property
    def text(self) -> list[str]:
        """Decimal texts, which read back as the same numbers in the precision that they were computed in."""
        if self._texts is None:
            raise InputError("these numbers were computed as float64, and have no more digits than that")
        if callable(self._texts):
            self._texts = self._texts()
        return list(self._texts)

    @property
    def exact(self) -> list[mpf]:
        """Numbers of mpmath with all digits, whatever `mpmath.mp.dps` is."""
        return [mpf_of(text) for text in self.text]

    @property
    def decimal(self) -> list[Decimal]:
        """Decimals with all digits."""
        return [Decimal(text) for text in self.text]

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            if self.names is None or key not in self.names:
                raise InputError(f"there is no '{key}'; there are: {', '.join(self.names or ['none'])}")
            key = self.names.index(key)
        part = super().__getitem__(key)
        if self._texts is None:
            return part
        texts = np.array(self.text, dtype=object)[key]
        if not isinstance(part, np.ndarray):
            return Number(texts)
        return Numbers(list(texts), values=np.array(part))

    def __iter__(self) -> Any:
        if self._texts is None:
            return iter(np.asarray(self))
        return (Number(text) for text in self.text)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        plain = [np.asarray(i) if isinstance(i, Numbers) else i for i in inputs]
        return getattr(ufunc, method)(*plain, **options)

    def __repr__(self) -> str:
        if self._texts is None:
            return repr(np.asarray(self))
        most, texts = 8, self.text
        shown = [repr(text) for text in texts]
        if self.names:
            shown = [f"{name}={text}" for name, text in zip(self.names, texts)]
        if len(shown) > 2 * most:
            shown[most:-most] = [f"... {len(shown)} in all"]
        return "Numbers([" + ",\n         ".join(shown) + "])"

    def __str__(self) -> str:
        return str(np.asarray(self))

    def __reduce__(self) -> Any:
        if self._texts is None:
            return np.asarray(self).__reduce__()
        return Numbers, (self.text, self.names)


Numbers.__module__ = "hbvm"
