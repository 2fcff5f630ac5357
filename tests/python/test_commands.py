"""References, audits, plans and studies: what the program's other commands do."""
import pathlib
import pickle
import shutil
from fractions import Fraction

import mpmath
import numpy as np
import pytest

import hbvm

STUDIES = pathlib.Path(__file__).resolve().parents[2] / "studies"


def test_a_reference_has_the_digits_that_it_promises():
    ref = hbvm.reference("simple_pendulum", at=["5/2", 10], digits=50)
    assert ref.t.tolist() == [2.5, 10] and ref.times[0].t == "5/2" and all(agreed >= 50 for agreed in ref.agreed)
    more = hbvm.reference("simple_pendulum", at=[10], digits=80)
    for name in ref.q[1].names:
        assert abs(ref.q[1][name].exact - more.q[0][name].exact) < mpmath.mpf(10) ** -49
    assert ref.q[-1]["bob.x"].text == ref.times[1].q.text[0]
    assert len(ref.lambda_[0]) == 1 and ref.p[0].names == ["bob.px", "bob.py"] and len(ref.H) == 2
    assert "the routes agree in" in repr(ref)
    again = pickle.loads(pickle.dumps(ref))
    assert again == ref


def test_a_reference_is_proved():
    ref = hbvm.reference("kepler", at=1, digits=20, prove=True)
    assert ref.proved == 20 and ref.times[0].radius.q < 1e-20 and "proved" in repr(ref)


def test_times_that_cannot_be_are_refused():
    for at in ([], [2, 1], -1):
        with pytest.raises(hbvm.InputError):
            hbvm.reference("kepler", at=at)


def verlet(n):
    """Kepler's problem by velocity Verlet from its scene's start, until t = 2."""
    h = 2 / n
    run = hbvm.run("kepler", step=1, until=1)
    q, p = np.array([run["planet.x"][0], run["planet.y"][0]]), np.array([run["planet.px"][0], run["planet.py"][0]])
    rows = [[0.0, *q, *p]]
    for i in range(n):
        p = p - h / 2 * q / np.dot(q, q) ** 1.5
        q = q + h * p
        p = p - h / 2 * q / np.dot(q, q) ** 1.5
        rows.append([(i + 1) * h, *q, *p])
    return np.array(rows)


NAMES = ["t", "planet.x", "planet.y", "planet.px", "planet.py"]


def test_results_of_ones_own_code_are_compared_in_any_form(tmp_path):
    pandas = pytest.importorskip("pandas")
    ref = hbvm.reference("kepler", at=2, digits=20)
    mine = verlet(64)
    found = ref.against(mine, columns=NAMES)
    assert 2 < found.least_digits < 4 and "least right" in repr(found)
    columns = {name: mine[:, i] for i, name in enumerate(NAMES)}
    frame = pandas.DataFrame(columns)
    frame.to_csv(tmp_path / "mine.csv", index=False)
    exact = {name: [mpmath.mpf(float(x)) for x in column] for name, column in columns.items()}
    for same in (columns, frame, tmp_path / "mine.csv", frame.to_csv(index=False), exact):
        assert ref.against(same).least_digits == pytest.approx(found.least_digits, abs=1e-6)
    assert pickle.loads(pickle.dumps(found)) == found


def test_columns_are_mapped():
    mine = verlet(64)
    theirs = {"time": mine[:, 0], "u": -mine[:, 1], "w": mine[:, 2]}
    found = hbvm.reference("kepler", at=2).against(theirs, columns={"-u": "planet.x", "w": "planet.y"})
    assert found.least_digits > 2
    assert [name for name in found.files[0].right_digits] == ["planet.x", "planet.y"]


def test_the_order_between_results_is_told():
    ref = hbvm.reference("kepler", at=2)
    found = ref.against(verlet(64), verlet(128), columns=NAMES, steps=["1/32", "1/64"])
    assert found.orders[0] == pytest.approx(2, abs=0.1)
    with pytest.raises(hbvm.InputError, match="1 steps for 2 results"):
        ref.against(verlet(64), verlet(128), columns=NAMES, steps=["1/32"])


def test_arrays_without_names_are_refused():
    ref = hbvm.reference("kepler", at=2)
    with pytest.raises(hbvm.InputError, match="no names"):
        ref.against(verlet(8))
    with pytest.raises(hbvm.InputError, match="4 names"):
        ref.against(verlet(8), columns=NAMES[:-1])


KUTTA = {"A": [[0, 0, 0, 0], ["1/2", 0, 0, 0], [0, "1/2", 0, 0], [0, 0, 1, 0]], "order": 4}


def test_a_tableau_is_audited():
    right = hbvm.audit(**KUTTA, b=["1/6", "1/3", "1/3", "1/6"])
    wrong = hbvm.audit(**KUTTA, b=["1/6", "1/3", "1/3", "1/7"])
    assert right.holds and not wrong.holds and wrong.count("fails") > 0
    assert "1.6667e-01" in wrong.findings[0].reason
    assert "order conditions" in repr(right) and right.table("csv").startswith("verdict,")
    assert "| verdict" in right.table("markdown") and "tabular" in right.table("latex")


def test_coefficients_are_judged_and_mended(tmp_path):
    wrong = {"A": [[0, 0, 0], [Fraction(1, 2), 0, 0], [-1, 2, 0]], "b": ["1/6", "2/3", "1/8"]}
    found = hbvm.coefficients(wrong, order=3)
    assert not found.holds
    assert [(entry.entry, entry.exact) for entry in found.repair] == [("b[3]", "1/6")]
    assert "repair: b[3] = 1/6" in repr(found)
    file = tmp_path / "mended.toml"
    file.write_text(found.mended)
    mended = hbvm.coefficients(file)
    assert mended.holds and mended.orders[0].order == 3
    assert repr(pickle.loads(pickle.dumps(mended))) == repr(mended)
    with pytest.raises(hbvm.InputError, match="no family"):
        hbvm.coefficients({"q": [1]})


def test_files_texts_and_methods_are_audited():
    file = STUDIES / "orders_beyond_round_off/gauss_with_a_wrong_digit.toml"
    for subject in (file, str(file), file.read_text()):
        assert hbvm.audit(subject).count("fails") > 0
    claims = '[[claim]]\nquantity = "q"\nproblem = "kepler"\nmethod = "hbvm:4,2"\nrate = "2*s"\n'
    assert hbvm.audit(claims).holds
    assert hbvm.audit("hbvm:3,1").holds
    for wrong in ({}, {"A": [[0]]}, {"subject": "hbvm:4,2", "A": [[0]], "b": [1]}):
        with pytest.raises(hbvm.InputError, match="audit takes"):
            hbvm.audit(**wrong)


def test_a_plan_has_the_digits():
    plan = hbvm.cost("kepler", digits=20, until=2)
    run = hbvm.run("kepler", plan.pick.method, step=plan.pick.step, until=2, precision=plan.pick.precision)
    ref = hbvm.reference("kepler", at=2, digits=30)
    assert max(abs(a - b) for a, b in zip(run.q.exact, ref.q[0].exact)) < mpmath.mpf(10) ** -19.5
    assert plan.runners_up and plan.pick.method in repr(plan)


def test_methods_are_compared():
    found = hbvm.compare("kepler", ["verlet", "hbvm:auto,3"], step="1/16", until=4, reference=True)
    assert [run.method for run in found.runs] == ["verlet", "hbvm:auto,3"]
    assert found.runs[1].digits > found.runs[0].digits
    assert len(found.plot().axes) >= 2 and "<html" in found.animate().html
    assert "this is rattle" in repr(found) and pickle.loads(pickle.dumps(found)) == found


def test_orders_of_methods_are_measured():
    found = hbvm.convergence("kepler", ["hbvm:4,2", "verlet"], steps="1/4:1/128", precisions=[40])
    rates = [method.orders.q for method in found.methods]
    assert abs(rates[0].rate - 4) < 0.05 and abs(rates[1].rate - 2) < 0.05
    assert found.methods[0].points[0].error.q > found.methods[0].points[-1].error.q
    assert len(found.plot().axes) == 2


def test_a_study_is_run(tmp_path):
    folder = tmp_path / "table"
    shutil.copytree(STUDIES / "table_1_simple_pendulum", folder, ignore=shutil.ignore_patterns("results"))
    found = hbvm.study(folder, out=tmp_path / "out")
    assert found.agreed == found.stated > 0 and "printed figures agree" in repr(found)
    assert (tmp_path / "out").is_dir()


def test_nodes_have_all_digits():
    found = hbvm.nodes(2, digits=100)
    with mpmath.workdps(110):
        expected = (1 - 1 / mpmath.sqrt(3)) / 2
        assert abs(found.c.exact[0] - expected) < mpmath.mpf(10) ** -100
    assert found.precision == "mpfr:100" and hbvm.nodes(4).precision == "double"
    assert float(found.b.sum()) == 1
