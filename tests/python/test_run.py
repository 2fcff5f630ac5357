"""Runs are those of the program."""
import json
import os
import pathlib
import pickle
import subprocess

import mpmath
import numpy as np
import pytest

import hbvm

SCHEMA = json.loads((pathlib.Path(__file__).resolve().parents[2] / "studies/run.schema.json").read_text())
PROGRAM = os.environ.get("HBVM_PROGRAM")
PENDULUM = {"scene": "double_pendulum", "method": "hbvm:4,2", "step": "1/16", "until": 2, "precision": "mpfr:50"}


def changing(facts):
    """What differs from run to run is left out."""
    return {key: value for key, value in facts.items() if key not in ("cpu_seconds", "states")}


@pytest.mark.skipif(not PROGRAM, reason="HBVM_PROGRAM names no program")
def test_every_digit_is_that_of_the_program(tmp_path):
    run = hbvm.run(**{**PENDULUM, "precision": "mpfr:200"})
    command = [PROGRAM, "run", "double_pendulum", "--method", "hbvm:4,2", "--step", "1/16", "--until", "2"]
    file = tmp_path / "run.csv"
    command += ["--precision", "mpfr:200", "--json"]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert changing(json.loads(said)) == changing(json.loads(run.json))
    subprocess.run([*command[:-1], "--out", str(file)], check=True, capture_output=True)
    assert run.to_csv() == file.read_text()
    read = hbvm.read_csv(file)
    assert read.columns == run.columns and all(read[name].text == run[name].text for name in run.columns)


@pytest.mark.skipif(not PROGRAM, reason="HBVM_PROGRAM names no program")
def test_the_version_is_that_of_the_program():
    said = subprocess.run([PROGRAM, "--version"], check=True, capture_output=True, text=True).stdout
    assert hbvm.__version__ == said.strip()


def test_columns_and_states_are_reached():
    run = hbvm.run(**PENDULUM)
    assert run.t.shape == (33,) and run.t[-1] == 2 and run.t.text[1] == "0.0625"
    assert run["a.x"].text[-1] == run.q["a.x"].text == run.q.text[0]
    assert run.p.names == ["a.px", "a.py", "b.px", "b.py"] and len(run.lambda_) == 2
    assert np.array_equal(run.energy_error, run["delta_H"])
    assert run.steps == 32 and run["steps"] == 32 and run.precision == "mpfr:50"
    assert run.health.warnings[0].name == run.warnings[0].name == "even_s_drift"
    with pytest.raises(hbvm.InputError, match="there are: t, a.x"):
        run["c.x"]
    with pytest.raises(AttributeError, match="there are: scene, method"):
        run.stepz


def test_the_repr_is_what_the_program_prints():
    run = hbvm.run(**PENDULUM)
    assert "energy                  e_H" in repr(run) and "WARNING even_s_drift" in repr(run)
    assert run.q.text[1] in run.table(state=True)
    assert "23 left out" in repr(run.trajectory)


def test_a_trajectory_is_kept_as_asked():
    assert hbvm.run(**PENDULUM, every=10).t.text == ["0", "0.625", "1.25", "1.875", "2"]
    run = hbvm.run(**PENDULUM, every=0)
    assert run.t.text == ["2"] and len(run.trajectory) == 0


def test_a_run_goes_on_from_another():
    whole = hbvm.run(**PENDULUM)
    half = hbvm.run(**{**PENDULUM, "until": 1})
    rest = hbvm.run(**{**PENDULUM, "until": 1}, start=half)
    assert np.allclose(rest.q, whole.q, rtol=0, atol=1e-14) and rest.start == "start.json"
    assert max(abs(a - b) for a, b in zip(rest.q.exact, whole.q.exact)) < mpmath.mpf(10) ** -45


def walk(facts, result, path, seen):
    """Every key of the JSON is an attribute with its value."""
    for key, value in facts.items():
        seen.add(".".join([*path, key]))
        found = getattr(result, key + "_" if key == "lambda" else key) if key.isidentifier() else result[key]
        if path + [key] == ["t"]:
            assert found.text[-1] == value
        elif isinstance(value, dict):
            walk(value, found, [*path, key], seen)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for one, record in zip(value, found):
                walk(one, record, [*path, key], seen)
        elif isinstance(value, list):
            assert [str(item) for item in getattr(found, "text", found)] == [str(item) for item in value]
        elif isinstance(found, hbvm.Number):
            assert found.text == value
        else:
            assert found == value


DRAGGED = """
dimension = 2
body = [{ name = "a", mass = 1, position = [0, -1], velocity = [1, 0] }]
effect = [{ kind = "drag", linear = 1 }]
"""


def schema_keys(schema, path=()):
    """The names of all that the schema tells of, without what is inside a state."""
    for key, value in schema.get("properties", {}).items():
        yield ".".join([*path, key])
        for inside in (value, value.get("items", {}), *value.get("oneOf", []), *value.get("anyOf", [])):
            if key != "states":
                yield from schema_keys(inside, (*path, key))


def test_every_key_of_the_schema_is_an_attribute():
    seen = {"states"}
    pendulum = hbvm.scene("double_pendulum").observe("tension", "tension(pivot, a)")
    runs = [
        hbvm.run(pendulum, until=1, step="1/8", error=True, shadow=True, account=True, horizon=True),
        hbvm.run("kepler", until=1, step="1/8", on_failure="halve", reverse=True),
        hbvm.run("double_pendulum", "hbvm:4,2", until=1, step="1/8", start=hbvm.run("double_pendulum", until=1)),
        hbvm.run("kepler", until=20, step=1, on_failure="halve", error=True),
        hbvm.run(DRAGGED, until=1, step="1/8"),
        hbvm.run(hbvm.scene("double_pendulum").project(), until=1, step="1/8", precision=40),
        hbvm.run(**PENDULUM),
        hbvm.run("bead_on_torus", until=1, step="1/4"),
        hbvm.run(hbvm.scene("simple_pendulum").event("swing: bob.x").observe("y", "bob.y"), step="1/4", until="91/3", at=["1/3"]),
        hbvm.run("double_pendulum", "hbvm:2,2", until=1, step="1/8", precision=20, prove=True),
    ]
    for run in runs:
        walk(json.loads(run.json), run, [], seen)
        assert len(run.states) == run.steps + 1
    keys = set(schema_keys(SCHEMA))
    rare = {"health.horizon.failure", "shadow.failure", "error.failure", "chosen.raised.t", "chosen.raised.k", "chosen.raised.r"}
    assert len(keys) > 60
    assert keys - seen - rare == set()


def test_results_are_pickled():
    run = hbvm.run(**PENDULUM)
    again = pickle.loads(pickle.dumps(run))
    assert again == run and again.to_csv() == run.to_csv() and repr(again) == repr(run)
    assert len(again.plot().axes) == len(run.plot().axes)


def test_pandas_has_floats_or_all_digits():
    pandas = pytest.importorskip("pandas")
    run = hbvm.run(**PENDULUM)
    floats, exact = run.to_pandas(), run.to_pandas(dtype=object)
    assert isinstance(floats, pandas.DataFrame) and list(floats.columns) == run.columns
    assert (floats.dtypes == np.float64).all() and floats["a.x"].tolist() == run["a.x"].tolist()
    assert exact["a.x"].tolist() == run["a.x"].exact and isinstance(exact["a.x"][1], mpmath.mpf)
    with pytest.raises(TypeError, match="float or object"):
        run.to_pandas(dtype=int)


def test_a_csv_that_cannot_be_read_is_refused(tmp_path):
    file = tmp_path / "short.csv"
    file.write_text("t,x\n0,1\n1\n")
    with pytest.raises(hbvm.InputError, match="row 2 has 1 cells, and there are 2 columns"):
        hbvm.read_csv(file)


def test_the_figure_shows_motion_multipliers_and_errors():
    figure = hbvm.run("double_pendulum", until=4, step="1/16").plot()
    assert [axes.get_title() for axes in figure.axes] == ["Motion", "Lagrange multipliers", "Errors of energy and constraints"]
    trace = max((line.get_xydata() for line in figure.axes[0].lines), key=len)
    run = hbvm.run("double_pendulum", until=4, step="1/16")
    assert len(trace) > 64 and np.allclose(trace[-1], run.q[2:], atol=1e-12)
    assert figure.axes[0].get_aspect() == 1


def test_a_picture_that_is_asked_for_is_that_which_is_made_later():
    asked, later = (hbvm.run("double_pendulum", until=2, step="1/16", picture=picture) for picture in (True, False))
    assert asked.animate().html == later.animate().html


def test_the_page_moves_in_a_notebook(tmp_path):
    page = hbvm.run("double_pendulum", until=1, step="1/16").animate()
    shown = page._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and "&lt;script" in shown and "<script" not in shown
    page.save(tmp_path / "motion.html")
    assert (tmp_path / "motion.html").read_text() == page.html


def test_wrong_requests_have_the_words_of_the_program():
    for wrong, words in (
        ({"method": "hbmv:4,2"}, "did you mean"),
        ({"at": [5000]}, "at"),
        ({"precision": "mpfr:7"}, "20"),
        ({"solver": "magic"}, "solver"),
        ({"every": -1}, "-1"),
    ):
        with pytest.raises(hbvm.InputError, match=words):
            hbvm.run(**{**PENDULUM, **wrong})
