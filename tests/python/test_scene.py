"""Scenes: by name, file, text, and built."""
import pathlib
import pickle
from fractions import Fraction

import pytest

import hbvm

STUDIES = pathlib.Path(__file__).resolve().parents[2] / "studies"
FILE = STUDIES / "scenes/double_pendulum.toml"


def built():
    return (
        hbvm.Scene(dimension=2, name="pair")
        .constant("L", Fraction(3, 2))
        .point("pivot", (0, 0))
        .body("a", mass=2, position=("3/5", "-4/5"), velocity=("4/5", "3/5"))
        .body("b", position=("3/5", "-23/10"), velocity=("4/5", "3/5"))
        .rod("pivot", "a", 1)
        .rod("a", "b", "L")
        .effect("uniform_gravity", acceleration=(0, -1))
        .observe("energy")
    )


def test_a_scene_is_found_by_name_file_and_text():
    texts = [hbvm.scene(source).toml for source in ("double_pendulum", FILE, str(FILE), FILE.read_text())]
    assert texts == [FILE.read_text()] * 4
    scene = hbvm.scene("kepler")
    assert hbvm.scene(scene) is scene


def test_what_is_built_is_a_scene_file():
    scene = built()
    facts = scene.check().facts()
    assert facts.bodies == 2 and facts.degrees_of_freedom == 2
    assert hbvm.scene(scene.toml, name="pair").facts().json == facts.json
    run = hbvm.run(scene, step="1/8", until=1)
    assert "energy" in run.observables and run.e_g < 1e-13


def test_every_kind_of_table_can_be_written():
    scene = (
        hbvm.Scene(dimension=3)
        .rigid_body("top", fixed_at=(0, 0, 0), mass=1, center=(0, 0, "1/2"), inertia=(1, 1, "1/2"),
                    orientation={"axis": [1, 0, 0], "angle": "pi/6"}, angular_velocity=(0, 0, 9))
        .attachment("tip", "top", (0, 0, 1))
        .effect("uniform_gravity", acceleration=(0, 0, "-9.81"))
    )
    assert 'orientation = { axis = [1, 0, 0], angle = "pi/6" }' in scene.toml
    scene.observe("height", "tip.z")
    run = hbvm.run(scene, step="1/64", until="1/4")
    assert run["height"][0] == pytest.approx(3**0.5 / 2)


def test_names_with_quotes_are_names():
    name = 'say "a" \\ b'
    scene = hbvm.Scene(1).body(name, position=[1]).effect("formula", U="-x^2/2")
    assert hbvm.run(scene, step="1/8", until=1).q.names == [name + ".x"]


def test_the_program_tells_what_is_wrong_and_where():
    with pytest.raises(hbvm.InputError, match="scene:4: body 'a': '1/0'"):
        hbvm.Scene(2).body("a", position=(0, 0), velocity=("1/0", 0)).effect("uniform_gravity", acceleration=(0, -1)).check()
    with pytest.raises(hbvm.InputError, match="did you mean 'kepler'"):
        hbvm.scene("keplar")
    with pytest.raises(hbvm.InputError, match="dimension 1, 2 or 3, not 4"):
        hbvm.Scene(4)
    with pytest.raises(hbvm.InputError, match="position of a body is None"):
        hbvm.Scene(1).body("a", position=[None])
    assert issubclass(hbvm.InputError, hbvm.Error) and issubclass(hbvm.InputError, ValueError)


def test_set_and_observe_change_a_scene_that_was_read():
    scene = hbvm.scene("double_pendulum")
    before = scene.facts().energy
    assert scene.set("a.mass", Fraction(7, 2)) is scene
    assert scene.facts().energy != before
    scene.observe("angle of a", "angle(pivot, a)")
    assert "angle of a" in hbvm.run(scene, step="1/8", until=1).columns
    with pytest.raises(hbvm.InputError, match="a.mas"):
        scene.set("a.mas", 1)


def test_project_moves_a_start_to_where_constraints_hold():
    scene = hbvm.Scene(2).point("o", (0, 0)).body("a", position=("3/5", "-3/5")).rod("o", "a", 1)
    scene.effect("uniform_gravity", acceleration=(0, -1))
    with pytest.raises(hbvm.InputError):
        scene.check()
    q = hbvm.run(scene.project(precision=30), step="1/8", until="1/8", precision=30)
    assert q["g"][0] < 1e-29


def test_scenes_are_pickled():
    for scene in (built(), hbvm.scene("kepler").set("planet.mass", 2)):
        again = pickle.loads(pickle.dumps(scene))
        assert again.toml == scene.toml and again.name == scene.name


def test_scenes_and_methods_are_listed():
    assert {"kepler", "double_pendulum"} <= {entry.name for entry in hbvm.scenes()}
    assert "double_pendulum" in repr(hbvm.scenes())
    kinds = {kind.name: kind for kind in hbvm.methods()}
    assert kinds["hbvm"].form == "hbvm:K,S" and "hbvm:K,S" in repr(hbvm.methods())
