"""Orders of methods that are known, right and wrong, in float64 and in many digits."""
import mpmath
import numpy as np
import pytest

import hbvm
from hbvm.testing import assert_conserves, assert_digits, assert_order

pytest_plugins = ["pytester"]


def force(q):
    r2 = np.dot(q, q)
    return -q / r2**1.5 if q.dtype == float else -q / (r2 * mpmath.sqrt(r2))


def verlet(q, p, h):
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)


def forest_ruth(q, p, h):
    """A symplectic splitting of order 4."""
    root = mpmath.cbrt(2) if q.dtype == object else 2 ** (1 / 3)
    first = 1 / (2 - root)
    for part in (first, 1 - 2 * first, first):
        q, p = verlet(q, p, part * h)
    return q, p


def runge_kutta(q, p, h, half=2, weight=6):
    k1, l1 = p, force(q)
    k2, l2 = p + h / half * l1, force(q + h / half * k1)
    k3, l3 = p + h / 2 * l2, force(q + h / 2 * k2)
    k4, l4 = p + h * l3, force(q + h * k3)
    return (
        q + h * (k1 / weight + k2 / 3 + k3 / 3 + k4 / 6),
        p + h * (l1 / weight + l2 / 3 + l3 / 3 + l4 / 6),
    )


def wrong_stage(q, p, h):
    return runge_kutta(q, p, h, half=3)


def wrong_digit(q, p, h):
    """A weight of 0.16667."""
    return runge_kutta(q, p, h, weight=100000 / 16667 if q.dtype == float else mpmath.mpf(100000) / 16667)


CASES = [
    (runge_kutta, 4, "holds"),
    (verlet, 2, "holds"),
    (forest_ruth, 4, "holds"),
    (runge_kutta, 3, "holds"),
    (wrong_stage, 4, "fails"),
    (wrong_digit, 4, "fails"),
    (verlet, 4, "fails"),
    (runge_kutta, 5, "fails"),
]


@pytest.mark.parametrize("digits", [None, 40])
@pytest.mark.parametrize(("method", "order", "verdict"), CASES)
def test_verdicts_are_right(method, order, verdict, digits):
    found = hbvm.verify_order(method, "kepler", order, digits=digits)
    assert found.verdict == verdict, repr(found)
    assert found.holds == bool(found) == (verdict == "holds")


def test_another_motion_is_told_of():
    def henon_heiles(q):
        return np.array([-q[0] - 2 * q[0] * q[1], -q[1] - q[0] ** 2 + q[1] ** 2])

    def step(q, p, h, force=henon_heiles):
        p = p + h / 2 * force(q)
        q = q + h * p
        return q, p + h / 2 * force(q)

    assert hbvm.verify_order(step, "henon_heiles", 2).holds
    assert hbvm.verify_order(step, "henon_heiles", 3).verdict == "fails"
    other = hbvm.verify_order(lambda q, p, h: step(q, p, h, lambda q: 2 * henon_heiles(q)), "henon_heiles", 2)
    assert other.verdict == "fails" and "another motion" in other.message


def test_the_verdict_is_the_same_every_time():
    messages = {hbvm.verify_order(forest_ruth, "kepler", 4).message for _ in range(5)}
    assert len(messages) == 1


def test_messages_say_what_was_left_out():
    found = hbvm.verify_order(runge_kutta, "kepler", 4)
    assert "finest steps are round-off and were left out" in found.message and found.message.startswith("order 4.0")
    left_out = [rung for rung in found.rungs[found.part] if not rung.is_clean]
    assert len(left_out) == 2 and all(rung.error < -35 for rung in left_out)
    wrong = hbvm.verify_order(wrong_digit, "kepler", 4)
    assert "Errors stop falling at" in wrong.message and "wrong digit" in wrong.message


def test_an_iteration_that_ends_early_is_told_of_and_can_be_allowed_for():
    def sloppy(q, p, h):
        q, p = runge_kutta(q, p, h)
        return q, p * (1 + 3e-14)

    assert hbvm.verify_order(sloppy, "kepler", 4).verdict != "holds"
    allowed = hbvm.verify_order(sloppy, "kepler", 4, tolerance=1e-10)
    assert allowed.holds and "below the tolerance" in allowed.message


def test_a_solver_is_judged_too():
    def solve(scene, h):
        return hbvm.run(scene, "hbvm:4,2", step=h, until=h * round(0.5 / h))

    def output(scene, h):
        run = solve(scene, h)
        return run.q, run.output.p

    # Of even s the propagated p has order s alone, and that of the output state order 2s.
    assert hbvm.verify_order(solve, "kepler", 4, until="1/2").holds
    assert hbvm.verify_order(output, "double_pendulum", 4, until="1/2").holds
    propagated = hbvm.verify_order(solve, "double_pendulum", 4, until="1/2")
    assert propagated.verdict == "fails" and propagated.part == "p" and abs(propagated.rate - 2) < 0.05


def test_steps_that_give_no_number_are_left_out_and_wrong_shapes_refused():
    def fails_when_coarse(q, p, h):
        return runge_kutta(q, p, h) if h < 0.1 else (q * np.nan, p)

    found = hbvm.verify_order(fails_when_coarse, "kepler", 4)
    assert found.holds and found.rungs["q"][0].step < 0.1
    with pytest.raises(hbvm.InputError, match="q has 1 entries, and the scene has 2 coordinates"):
        hbvm.verify_order(lambda q, p, h: (q[:1], p), "kepler", 4)
    with pytest.raises(hbvm.InputError, match="no finite number"):
        hbvm.verify_order(lambda q, p, h: (q * np.inf, p), "kepler", 4)
    with pytest.raises(hbvm.InputError, match="returns q and p"):
        hbvm.verify_order(lambda scene, h: 7, "kepler", 4)


def test_an_order_is_drawn():
    figure = hbvm.verify_order(verlet, "kepler", 2).plot()
    assert [line.get_label() for line in figure.axes[0].lines][-1] == "slope 2"


def trajectory(n):
    run = hbvm.run("kepler", step="1/32", until="1/32")
    q, p = (np.array([run[name][0] for name in names]) for names in (run.names.q, run.names.p))
    rows = [[0.0, *q, *p]]
    for i in range(n):
        q, p = forest_ruth(q, p, 2 / n)
        rows.append([(i + 1) * 2 / n, *q, *p])
    return np.array(rows)


NAMES = ["t", "planet.x", "planet.y", "planet.px", "planet.py"]


def test_assertions_hold_for_what_is_right_and_tell_what_is_wrong():
    rows = trajectory(64)
    assert_order(verlet, "kepler", 2)
    assert_digits(rows, "kepler", 3, columns=NAMES)
    assert_conserves(rows, "kepler", within=1e-4, columns=NAMES)
    with pytest.raises(AssertionError, match=r"order 2\.0\d \+- 0\.0\d of [qp] over h = 1/8 ... 1/8192, and 4 is claimed"):
        assert_order(verlet, "kepler", 4)
    with pytest.raises(AssertionError, match=r"digits are right of planet\.p?[xy] at t = \S+, and 12 are asked for"):
        assert_digits(rows, "kepler", 12, columns=NAMES)
    with pytest.raises(AssertionError, match=r"the energy is off by \S+ at t = \S+, and 1e-12 is asked for"):
        assert_conserves(rows, "kepler", within=1e-12, columns=NAMES)
    with pytest.raises(hbvm.InputError, match="not all coordinates"):
        assert_conserves(rows[:, :3], "kepler", within=1, columns=NAMES[:3])


def test_constraints_are_conserved():
    run = hbvm.run("double_pendulum", step="1/16", until=2)
    assert_conserves(run, "double_pendulum", within=1e-13, what="constraints")
    with pytest.raises(AssertionError, match="the constraints are off by"):
        assert_conserves(run, "double_pendulum", within=1e-20, what="constraints")
    with pytest.raises(hbvm.InputError, match="'energy' or 'constraints'"):
        assert_conserves(run, "double_pendulum", within=1, what="mass")


def test_the_fixture_keeps_references(pytester):
    pytester.makeconftest('pytest_plugins = ["hbvm.plugin"]')
    pytester.makepyfile("""
        import hbvm, hbvm.plugin
        made = []
        def test_it(hbvm_reference, monkeypatch):
            find = hbvm.plugin.reference
            monkeypatch.setattr(hbvm.plugin, "reference", lambda *a, **k: made.append(1) or find(*a, **k))
            ref = hbvm_reference("kepler", at=1, digits=20)
            print("computed", len(made), ref.q[0].text[0])
    """)
    first, second = (pytester.runpytest_subprocess("-s").stdout.str() for _ in range(2))
    assert "computed 1 " in first and "computed 0 " in second
    digits = [text.split("computed ")[1].split()[1] for text in (first, second)]
    assert digits[0] == digits[1]
