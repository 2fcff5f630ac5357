"""Results as the program's JSON has them, by attribute."""
from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any, Iterator

from ._number import Number

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DECIMAL = re.compile(r"-?\d+(\.\d+)?(e[+-]?\d+)?")
# What these are is a number of the working precision; all other text is a name or words.
_NUMBERS = frozenset(
    "t q p lambda q_carry p_carry delta_H step last_step until e_H e_B e_g e_hid condition worst_e_H worst_hidden H smallest first_t"
    " initial drift least least_t greatest greatest_t energy kinetic potential value period x y".split()
)
_OF_NUMBERS = frozenset(("momenta", "observed", "work", "by"))


def _is_number(key: str, inside: str, value: Any) -> bool:
    named = key in _NUMBERS or inside in _OF_NUMBERS
    return named and isinstance(value, str) and _DECIMAL.fullmatch(value) is not None


def wrapped(value: Any, key: str = "", inside: str = "") -> Any:
    if isinstance(value, dict):
        return Record(value, key)
    if isinstance(value, list):
        if value and all(_is_number(key, inside, item) for item in value):
            from ._arrays import Numbers

            return Numbers(value)
        return [wrapped(item, key, inside) for item in value]
    return Number(value) if _is_number(key, inside, value) else value


class Record:
    """What the program's JSON has under a key: by attribute, or by index if that is no name, `record["a.x"]`.

    What is called lambda in the JSON is `lambda_` here.
    """

    _facts: dict[str, Any]
    _key: str

    def __init__(self, facts: dict[str, Any], key: str = "") -> None:
        self._facts = facts
        self._key = key

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        key = name[:-1] if name.endswith("_") and name not in self._facts else name
        if key not in self._facts:
            raise AttributeError(f"there is no {name}; there are: {', '.join(self._facts)}")
        return wrapped(self._facts[key], key, self._key)

    def __getitem__(self, key: str) -> Any:
        try:
            return getattr(self, key)
        except AttributeError as missing:
            raise KeyError(str(missing)) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._facts)

    def __len__(self) -> int:
        return len(self._facts)

    def __contains__(self, key: object) -> bool:
        return key in self._facts

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key + "_" if key == "lambda" else key for key in self._facts)]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and self._facts == other._facts

    __hash__ = None  # type: ignore[assignment]

    @property
    def json(self) -> str:
        """The JSON as text."""
        return json.dumps(self._facts, indent=2, ensure_ascii=False)

    def __repr__(self) -> str:
        shown = ((key, wrapped(value, key, self._key)) for key, value in self._facts.items())
        return "Record(" + ", ".join(f"{key}={value!r}" for key, value in shown) + ")"


class Shown(Record):
    """A result that is shown as the text that the program prints."""

    def __init__(self, facts: dict[str, Any], text: str) -> None:
        super().__init__(facts)
        self._text = text

    def __repr__(self) -> str:
        return self._text.rstrip("\n")

    def __reduce__(self) -> Any:
        return type(self), (self._facts, self._text)


class Made(Record):
    """A result that comes with the text that the program prints, and with a figure."""

    def __init__(self, made: dict[str, Any]) -> None:
        super().__init__(json.loads(made["json"]))
        self._made = made

    def table(self) -> str:
        """What the program prints."""
        return self._made["text"]

    def plot(self) -> Figure:
        """The picture that the program draws, by matplotlib."""
        from ._figure import drawn

        return drawn(self._made["figure"])

    def __repr__(self) -> str:
        return self.table().rstrip("\n")

    def __reduce__(self) -> Any:
        return type(self), (self._made,)


class Listing(list):
    """A list that is shown as the table that the program prints."""

    def __init__(self, items: Any, text: str) -> None:
        super().__init__(items)
        self.text = text

    def __repr__(self) -> str:
        return self.text.rstrip("\n")

    def __reduce__(self) -> Any:
        return Listing, (list(self), self.text)


Record.__module__ = Shown.__module__ = Made.__module__ = Listing.__module__ = "hbvm"
