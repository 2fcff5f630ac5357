"""Numbers go in exactly, and come out with all digits."""
import pickle
import warnings
from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import pytest

import hbvm
from hbvm._number import exact_text, mpf_of

DIGITS = 200
THIRD = "0." + "3" * (DIGITS + 10)


def scene(x):
    """A body that moves from x = 0 with velocity x, without force."""
    return hbvm.Scene(1).body("a", position=[0], velocity=[x]).effect("trap", center="o", stiffness=0, exponent=2).point(
        "o", [0]
    )


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (7, "7"),
        (-(10**30), "-" + "1" + "0" * 30),
        (Fraction(-3, 5), "-3/5"),
        (Fraction(4, 2), "2"),
        (Decimal("0.1"), "0.1"),
        (Decimal("1e-400"), "1E-400"),
        (0.375, "0.375"),
        (np.float64(0.5), "0.5"),
        (np.int32(-3), "-3"),
        (np.longdouble(0.25), "0.25"),
        (mpmath.mpf(3) / 8, "0.375"),
        (mpmath.mpf(0), "0"),
        ("sqrt(2)/3", "sqrt(2)/3"),
        (hbvm.Number("0.10"), "0.10"),
    ],
)
def test_the_text_of_a_number_is_exact(value, text):
    assert exact_text(value) == text


def test_every_float_and_mpf_is_the_binary_number_that_it_is():
    for value in (1 / 3, 0.1 + 0.2, 2.0**-1074, 1.7976931348623157e308, -1e22):
        assert Fraction(exact_text(value)) == Fraction(value)
    with mpmath.workdps(DIGITS):
        for value in (mpmath.mpf(1) / 3, -mpmath.pi * mpmath.mpf(10) ** 50, mpmath.mpf(2) ** -800):
            sign, mantissa, exponent, _ = value._mpf_
            expected = Fraction(int(mantissa)) * Fraction(2) ** exponent * (-1 if sign else 1)
            assert Fraction(exact_text(value)) == expected


def test_a_float_that_stands_for_a_decimal_is_warned_of_once():
    with pytest.warns(hbvm.FloatWarning, match='write "0.1"'):
        text = exact_text(0.1)
    assert Fraction(text) == Fraction(0.1) != Fraction(1, 10)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exact_text(0.2)


def test_floats_that_are_meant_are_not_warned_of():
    for value in (0.5, 1.0, 1 / 3, 2**0.5, 1e22, 0.0):
        exact_text(value)


@pytest.mark.parametrize(
    "value", [float("nan"), float("inf"), Decimal("NaN"), mpmath.inf, mpmath.nan, np.longdouble("inf"), None, True, 1j, [1]]
)
def test_what_is_no_number_is_refused(value):
    with pytest.raises(hbvm.InputError, match="step"):
        exact_text(value, "step")


def test_two_hundred_digits_go_there_and_back():
    precision = f"mpfr:{DIGITS}"
    run = hbvm.run("double_pendulum", step="1/8", until="1/2", precision=precision)
    texts = run.q.text
    assert all(len(text) > DIGITS - 5 for text in texts)
    for number, exact, text in zip(run.q, run.q.exact, texts):
        assert number.text == text
        # A body that is put there is there, by the text and by mpmath's number.
        for value in (text, exact, number, number.decimal):
            start = scene(0)
            start._tables = start._tables.replace("position = [0]", f'position = ["{exact_text(value)}"]', 1)
            there = hbvm.run(start, step=1, until=1, precision=precision)
            assert there["a.x"].text[0] == text


def test_an_mpf_in_equals_the_text_in():
    with mpmath.workdps(DIGITS + 20):
        by_mpf = hbvm.run(scene(mpmath.mpf(THIRD)), step=1, until=1, precision=DIGITS)
    by_text = hbvm.run(scene(THIRD), step=1, until=1, precision=DIGITS)
    assert by_mpf.q.text == by_text.q.text
    assert by_text.q.text[0].startswith("0." + "3" * (DIGITS - 2))


def test_a_float_in_is_not_the_decimal():
    with pytest.warns(hbvm.FloatWarning):
        by_float = hbvm.run(scene(0.1), step=1, until=1, precision=60)
    by_text = hbvm.run(scene("0.1"), step=1, until=1, precision=50)
    assert Fraction(by_float.q.text[0]) == Fraction(0.1)
    assert by_text.q.text == ["0.1"]


def test_a_number_computes_as_a_float_and_keeps_its_digits():
    x = hbvm.Number(THIRD)
    assert x == 1 / 3 and x + 1 == 4 / 3 and type(x + 1) is float
    assert repr(x) == str(x) == f"{x}" == THIRD and f"{x:.3f}" == "0.333"
    assert x.decimal == Decimal(THIRD)
    assert pickle.loads(pickle.dumps(x)).text == THIRD
    assert mpmath.libmp.to_str(x.exact._mpf_, DIGITS + 10) == THIRD


def test_mpf_has_the_digits_whatever_mpmath_computes_with():
    with mpmath.workdps(5):
        x = mpf_of(THIRD)
    assert mpmath.libmp.to_str(x._mpf_, DIGITS + 10) == THIRD


def test_arrays_are_float64_and_know_their_digits():
    run = hbvm.run("kepler", step="1/8", until=1, precision=DIGITS)
    x = run["planet.x"]
    assert isinstance(x, np.ndarray) and x.dtype == np.float64 and x.shape == (9,)
    assert x.tolist() == [float(text) for text in x.text]
    assert [f"{number}" for number in x] == x.text
    assert x[3].text == x.text[3] and x[-1].text == x.text[-1]
    assert x[2:5].text == x.text[2:5] and x[::-1].text == x.text[::-1]
    assert x[x > 0].text == [text for text in x.text if not text.startswith("-")]
    assert [str(d) for d in x.decimal[:1]] == x.text[:1]
    twice = 2 * x
    assert type(twice) is np.ndarray and type(np.sin(x)) is np.ndarray and twice[0] == 2 * x[0]
    assert float(x.max()) == max(x.tolist())
    with pytest.raises(ValueError, match="read-only"):
        x[0] = 1
    again = pickle.loads(pickle.dumps(x))
    assert again.text == x.text


def test_what_is_computed_has_no_more_digits_than_float64():
    x = hbvm.nodes(3, digits=50).c
    with pytest.raises(hbvm.InputError, match="no more digits"):
        np.concatenate([x, x]).view(hbvm.Numbers).text


def test_names_reach_entries():
    q = hbvm.run("double_pendulum", step="1/8", until=1).q
    assert q.names == ["a.x", "a.y", "b.x", "b.y"] and q["b.x"] == q[2]
    with pytest.raises(hbvm.InputError, match="there are: a.x, a.y, b.x, b.y"):
        q["c.x"]
