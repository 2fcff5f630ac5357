"""Assertions for tests of one's own integrators. Their messages say what was found.

A test of pytest also has the fixture `hbvm_reference`, where its conftest.py says `pytest_plugins = ["hbvm.plugin"]`.
"""
from __future__ import annotations

from typing import Any, Callable

from ._against import Against, Names, Results, against
from ._errors import InputError
from ._order import Order, verify_order
from ._scene import SceneLike
from ._scene import scene as scene_of

__all__ = ["assert_conserves", "assert_digits", "assert_order"]


def assert_order(method: Callable[..., Any], scene: SceneLike, order: float, **options: Any) -> Order:
    """A method has this order, or a higher one. The options are those of `verify_order`.

    >>> from hbvm.testing import assert_order
    >>> import numpy as np
    >>> def euler(q, p, h):
    ...     return q + h * p, p - h * q / np.dot(q, q) ** 1.5
    >>> assert_order(euler, "kepler", order=1).holds
    True
    >>> assert_order(euler, "kepler", order=2)
    Traceback (most recent call last):
        ...
    AssertionError: order 1.00 +- 0.00 of p over h = 1/8 ... 1/8192, and 2 is claimed
    """
    __tracebackhide__ = True
    found = verify_order(method, scene, order, **options)
    if not found.holds:
        raise AssertionError(found.message)
    return found


def assert_digits(results: Results, scene: SceneLike, digits: float, columns: Names = None) -> Against:
    """So many digits of results are right, of all components at all times. Results and columns are those of
    `Reference.against`.

    >>> import hbvm
    >>> from hbvm.testing import assert_digits
    >>> run = hbvm.run("kepler", "verlet", step="1/64", until=2)
    >>> assert_digits(run, "kepler", 2).least_digits > 2
    True
    >>> assert_digits(run, "kepler", 4)
    Traceback (most recent call last):
        ...
    AssertionError: 2.7 digits are right of planet.py at t = 2, and 4 are asked for
    """
    __tracebackhide__ = True
    found = _beside(results, scene, columns)
    if not found.least_digits >= digits:
        name, t, right = _least(found)
        raise AssertionError(f"{right:.1f} digits are right of {name} at t = {float(t):g}, and {digits:g} are asked for")
    return found


def assert_conserves(
    results: Results, scene: SceneLike, within: float, what: str = "energy", columns: Names = None
) -> Against:
    """The energy, or with what="constraints" these, stay what they are, but for so much of the size of their terms.
    Results have q, and p or velocities of all coordinates.

    >>> import hbvm
    >>> from hbvm.testing import assert_conserves
    >>> run = hbvm.run("double_pendulum", "hbvm:auto,3", step="1/16", until=10)
    >>> found = assert_conserves(run, "double_pendulum", within=1e-10)
    >>> assert_conserves(hbvm.run("kepler", "verlet", step="1/64", until=2), "kepler", within=1e-6)
    Traceback (most recent call last):
        ...
    AssertionError: the energy is off by 3.3e-04 at t = 2, and 1e-06 is asked for
    """
    __tracebackhide__ = True
    keys = {"energy": "log10_H_drift", "constraints": "log10_g_drift"}
    if what not in keys:
        raise InputError(f"what is conserved is 'energy' or 'constraints', not {what!r}")
    found = _beside(results, scene, columns)
    file = found._facts["files"][0]
    drift = [10**log if log is not None else 0.0 for log in file[keys[what]]]
    if not drift:
        raise InputError(f"the results have not all coordinates of q and p: {'; '.join(file['unused'])}")
    worst = max(range(len(drift)), key=drift.__getitem__)
    if not drift[worst] <= within:
        verb = "is" if what == "energy" else "are"
        raise AssertionError(
            f"the {what} {verb} off by {drift[worst]:.1e} at t = {float(file['t'][worst]):g}, and {within:g} is asked for"
        )
    return found


def _beside(results: Results, scene: SceneLike, columns: Names) -> Against:
    return against(scene_of(scene)._raw(), [results], columns, (), False, None)


def _least(found: Against) -> tuple[str, str, float]:
    """The component with the fewest right digits, the time, and how many they are."""
    file = found._facts["files"][0]
    return min(
        (
            (name, t, right)
            for name, digits in file["right_digits"].items()
            for t, right in zip(file["t"], digits)
            if right is not None
        ),
        key=lambda one: one[2],
    )
