"""Exact numbers: what goes in, and what comes out."""
from __future__ import annotations

import operator
import sys
import warnings
from decimal import MAX_EMAX, MAX_PREC, MIN_EMIN, Context, Decimal
from fractions import Fraction
from numbers import Rational
from typing import TYPE_CHECKING, Any, Union

from ._errors import InputError

if TYPE_CHECKING:
    from mpmath import mpf

#: What is taken for a number: int, str, Fraction, Decimal, mpmath's mpf, float, and the like of numpy and gmpy2.
Exact = Union[int, str, Fraction, Decimal, float, Any]

_EXACT = Context(prec=MAX_PREC, Emax=MAX_EMAX, Emin=MIN_EMIN)
_warned_of_floats = False


class FloatWarning(UserWarning):
    """A float went in where a decimal was meant."""


FloatWarning.__module__ = "hbvm"


class Number(float):
    """A number of a result. It computes as a float does, and has all its digits in `text`, `exact` and `decimal`.

    >>> import hbvm
    >>> x = hbvm.Number("0.12345678901234567890123")
    >>> x
    0.12345678901234567890123
    >>> 2 * x
    0.24691357802469135
    >>> x.exact * 2  # doctest: +SKIP
    mpf('0.24691357802469135780246')
    """

    __slots__ = ("text",)
    #: The decimal text, which reads back as the same number in the precision that it was computed in.
    text: str

    def __new__(cls, text: str) -> Number:
        self = super().__new__(cls, text)
        self.text = text
        return self

    @property
    def exact(self) -> mpf:
        """An mpf with all digits, whatever `mpmath.mp.dps` is. What is computed with it is rounded to `mp.dps`."""
        return mpf_of(self.text)

    @property
    def decimal(self) -> Decimal:
        """A Decimal with all digits."""
        return Decimal(self.text)

    def __repr__(self) -> str:
        return self.text

    __str__ = __repr__

    def __format__(self, spec: str) -> str:
        return super().__format__(spec) if spec else self.text

    def __reduce__(self) -> tuple:
        return Number, (self.text,)


Number.__module__ = "hbvm"


def mpf_of(text: str) -> mpf:
    """The decimal as an mpf that reads back as the same number."""
    from mpmath import libmp, mp

    guard = 64
    bits = guard + 10 * (len(text) + 1) // 3
    return mp.make_mpf(libmp.from_str(text, bits, "n"))


def exact_text(value: Exact, what: str = "a number") -> str:
    """The exact text of a number, as scenes and requests take it.

    >>> from fractions import Fraction
    >>> exact_text(Fraction(-3, 5)), exact_text("2*pi"), exact_text(0.375)
    ('-3/5', '2*pi', '0.375')
    """
    if isinstance(value, str):
        return value
    if isinstance(value, Number):
        return value.text
    if isinstance(value, bool) or value is None:
        raise InputError(f"{what} is {value!r}, which is no number")
    if isinstance(value, Decimal):
        return _finite_text(value, what)
    if hasattr(value, "_mpf_"):
        return _text_of_mpf(value, what)
    if isinstance(value, float):
        return _text_of_float(float(value), what)
    if isinstance(value, Rational) and value.denominator != 1:
        return f"{int(value.numerator)}/{int(value.denominator)}"
    try:
        return str(Decimal(operator.index(value)))
    except TypeError:
        pass
    if hasattr(value, "as_integer_ratio"):
        try:
            numerator, denominator = value.as_integer_ratio()
        except (ValueError, OverflowError):
            raise InputError(f"{what} is {value}: it must be finite") from None
        return _binary_text(int(numerator), int(denominator).bit_length() - 1)
    raise InputError(
        f"{what} is of type {type(value).__name__}: use int, str, Fraction, Decimal, mpf or float"
    )


def _finite_text(value: Decimal, what: str) -> str:
    if not value.is_finite():
        raise InputError(f"{what} is {value}: it must be finite")
    return str(value)


def _binary_text(mantissa: int, power: int) -> str:
    """The decimal text of mantissa / 2^power, with all its digits."""
    if power <= 0:
        return str(Decimal(mantissa << -power))
    return str(Decimal(mantissa * 5**power).scaleb(-power, _EXACT))


def _text_of_mpf(value: Any, what: str) -> str:
    sign, mantissa, exponent, bits = value._mpf_
    if not mantissa and exponent:
        raise InputError(f"{what} is {value}: it must be finite")
    return _binary_text(-int(mantissa) if sign else int(mantissa), -int(exponent))


def _text_of_float(value: float, what: str) -> str:
    exact = Decimal(value)
    text = _finite_text(exact, what)
    short = repr(value)
    digits = len(short.replace(".", "").replace("-", "").split("e")[0].strip("0"))
    if Decimal(short) != exact and digits < 16 and abs(value) >= sys.float_info.min:
        _warn_of_float(short, text)
    return text


def _warn_of_float(short: str, text: str) -> None:
    global _warned_of_floats
    if _warned_of_floats:
        return
    _warned_of_floats = True
    warnings.warn(
        f"the float {short} is taken as the binary number that it is, {text[:24]}...: "
        f'write "{short}" or Decimal("{short}") for the decimal',
        FloatWarning,
        stacklevel=2,
    )
