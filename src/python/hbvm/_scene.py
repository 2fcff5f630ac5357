"""Scenes: found by name, read, or built."""
from __future__ import annotations

import json
import os
import re
from typing import Any, Iterable, Mapping, Sequence, Union

from . import _hbvm
from ._errors import InputError
from ._number import Exact, exact_text
from ._record import Listing, Record, Shown

Vector = Sequence[Exact]
SceneLike = Union["Scene", str, "os.PathLike[str]"]

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
_ESCAPES = {ord('"'): '\\"', ord("\\"): "\\\\", **{c: f"\\u{c:04x}" for c in (*range(32), 127)}}


def _quoted(text: str) -> str:
    return '"' + text.translate(_ESCAPES) + '"'


def _key(name: str) -> str:
    return name if _BARE_KEY.fullmatch(name) else _quoted(name)


def _toml(value: Any, what: str) -> str:
    """A value of TOML. Numbers that are neither whole nor text stand as exact text in quotes."""
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        inside = ", ".join(f"{_key(key)} = {_toml(entry, what)}" for key, entry in value.items())
        return "{ " + inside + " }"
    if isinstance(value, Iterable):
        return "[" + ", ".join(_toml(entry, what) for entry in value) + "]"
    text = exact_text(value, what)
    return text if isinstance(value, int) and abs(value) < 10**15 else _quoted(text)


class Scene:
    """A mechanical system and its start, as exact text. Each method adds something, and returns the scene.

    Numbers are int, Fraction, Decimal, mpf, float or text, as "3/5" or "sqrt(2)/2". The keys are those of a scene file,
    which the page studies/scenes explains.

    >>> import hbvm
    >>> scene = hbvm.Scene(dimension=2, name="pendulum").point("pivot", (0, 0))
    >>> scene = scene.body("bob", mass=1, position=("3/5", "-4/5")).rod("pivot", "bob", 1)
    >>> scene = scene.effect("uniform_gravity", acceleration=(0, "-9.81"))
    >>> print(scene.toml)
    title = "pendulum"
    dimension = 2
    <BLANKLINE>
    [[point]]
    name = "pivot"
    position = [0, 0]
    <BLANKLINE>
    [[body]]
    name = "bob"
    mass = 1
    position = ["3/5", "-4/5"]
    velocity = [0, 0]
    <BLANKLINE>
    [[constraint]]
    kind = "rod"
    between = ["pivot", "bob"]
    length = 1
    <BLANKLINE>
    [[effect]]
    kind = "uniform_gravity"
    acceleration = [0, "-9.81"]
    <BLANKLINE>
    >>> scene.facts().degrees_of_freedom
    1
    """

    def __init__(self, dimension: int = 2, *, name: str = "scene", title: str | None = None, source: str | None = None):
        if dimension not in (1, 2, 3):
            raise InputError(f"a scene has dimension 1, 2 or 3, not {dimension}")
        self._name = name
        self._dimension = dimension
        self._head = f"title = {_quoted(title or name)}\n"
        if source:
            self._head += f"source = {_quoted(source)}\n"
        self._head += f"dimension = {dimension}\n"
        self._constants = ""
        self._observables: list[str] = []
        self._tables = ""
        self._made: Any = None

    @classmethod
    def _of(cls, made: Any) -> Scene:
        self = cls.__new__(cls)
        self._become(made)
        return self

    def _become(self, made: Any) -> None:
        self._name = made.name
        self._dimension = 0
        self._head = made.toml()
        self._constants = ""
        self._observables = []
        self._tables = ""
        self._made = made

    @property
    def name(self) -> str:
        """What it is called in messages and results."""
        return self._name

    @property
    def toml(self) -> str:
        """The text of a scene file."""
        text = self._head
        if self._observables:
            text += f"observables = {_toml(self._observables, 'observables')}\n"
        if self._constants:
            text += "\n[constants]\n" + self._constants
        return text + self._tables

    def _raw(self) -> Any:
        if self._made is None:
            self._made = _hbvm.Scene(self.toml, self._name)
        return self._made

    def _table(self, kind: str, keys: Mapping[str, Any]) -> Scene:
        self._tables += f"\n[[{kind}]]\n"
        for key, value in keys.items():
            if value is not None:
                self._tables += f"{_key(key)} = {_toml(value, f'{key} of a {kind}')}\n"
        self._made = None
        return self

    def constant(self, name: str, value: Exact) -> Scene:
        """A number with a name, which other numbers may be written with."""
        if not self._dimension:
            raise InputError("a scene that was read takes no new constant: set() changes one that it has")
        self._constants += f"{_key(name)} = {_toml(value, name)}\n"
        self._made = None
        return self

    def point(self, name: str, position: Vector, *, charge: Exact | None = None) -> Scene:
        """A point that is fixed in space: an anchor of rods, or a centre of forces."""
        return self._table("point", {"name": name, "position": position, "charge": charge})

    def body(
        self,
        name: str,
        *,
        mass: Exact | Sequence[Vector] = 1,
        position: Vector,
        velocity: Vector | None = None,
        momentum: Vector | None = None,
        charge: Exact | None = None,
    ) -> Scene:
        """A body without extent. Its mass may be a matrix. It is at rest if it has neither velocity nor momentum."""
        if velocity is None and momentum is None:
            velocity = [0] * len(position)
        keys = {"name": name, "mass": mass, "position": position, "velocity": velocity, "momentum": momentum}
        return self._table("body", {**keys, "charge": charge})

    def rigid_body(self, name: str, **keys: Any) -> Scene:
        """A rigid body, by the keys of a scene file: mass, inertia, orientation and so on."""
        return self._table("rigid_body", {"name": name, **keys})

    def attachment(self, name: str, of: str, at: Vector, *, charge: Exact | None = None) -> Scene:
        """A point in the frame of a rigid body, which constraints and effects name like a body."""
        return self._table("attachment", {"name": name, "of": of, "at": at, "charge": charge})

    def constraint(self, kind: str, **keys: Any) -> Scene:
        """A constraint by its kind and keys, as constraint("plane", body="a", normal=(0, 1), offset=0)."""
        return self._table("constraint", {"kind": kind, **keys})

    def rod(self, a: str, b: str, length: Exact) -> Scene:
        """Two bodies or points stay this far apart."""
        return self.constraint("rod", between=[a, b], length=length)

    def effect(self, kind: str, **keys: Any) -> Scene:
        """A force by its kind and keys, as effect("spring", between=["a", "b"], stiffness=10)."""
        return self._table("effect", {"kind": kind, **keys})

    def observe(self, name: str, formula: str | None = None) -> Scene:
        """A formula whose value a run tells along the motion. Without one, "energy", "linear_momentum" or
        "angular_momentum": a run tells how well it is conserved.

        >>> import hbvm
        >>> scene = hbvm.scene("double_pendulum").observe("tension", "tension(pivot, a)")
        >>> hbvm.run(scene, step="1/8", until=1)["tension"].min() > 0
        True
        """
        if formula is None:
            if not self._dimension:
                raise InputError("a scene that was read takes formulas alone: observe(name, formula)")
            self._observables.append(name)
            self._made = None
            return self
        raw = self._raw()
        raw.observe(name, formula)
        self._become(raw)
        return self

    def event(self, text: str) -> Scene:
        """A run tells when a value crosses 0, and the state there: "turn: bob.vx", or upwards alone "turn up: bob.vx".

        >>> import hbvm
        >>> run = hbvm.run(hbvm.scene("kepler").event("near: planet.y"), step="1/16", until=7)
        >>> [event.direction for event in run.events]
        ['down', 'up']
        """
        raw = self._raw()
        raw.event(text)
        self._become(raw)
        return self

    def set(self, what: str, value: Exact) -> Scene:
        """Another value of a constant, "L", or of a body's mass or charge, "a.mass".

        >>> import hbvm
        >>> hbvm.scene("double_pendulum").set("a.mass", 2).facts().energy
        -2.885
        """
        raw = self._raw()
        raw.set(what, exact_text(value, what))
        self._become(raw)
        return self

    def check(self) -> Scene:
        """Reads the scene and makes its system. What is wrong is told with its line in `toml`."""
        self._raw().check()
        return self

    def facts(self, precision: str | int = "double") -> Record:
        """What the scene is and how it starts: degrees of freedom, constraints, effects, energy, momenta."""
        found, text = _hbvm.describe(self._raw(), str(precision))
        return SceneFacts(json.loads(found), text)

    def project(self, precision: str | int = "double", hold: Sequence[str] = ()) -> Scene:
        """The scene with the nearest start that fulfils the constraints. What is held stays: "a.position",
        "crank.angle"."""
        return Scene._of(_hbvm.project(self._raw(), str(precision), list(hold)))

    def __repr__(self) -> str:
        return f"Scene({self._name!r})\n{self.toml}" if self._dimension else f"Scene({self._name!r})"

    def __reduce__(self) -> Any:
        return _read, (self.toml, self._name)


class SceneFacts(Shown):
    """What a scene is and how it starts."""


def _read(toml: str, name: str) -> Scene:
    return Scene._of(_hbvm.Scene(toml, name))


def scene(source: SceneLike, name: str = "scene") -> Scene:
    """The scene of a name that `scenes()` lists, of a file, or of a text in TOML. A scene is returned as it is.

    >>> import hbvm
    >>> hbvm.scene("kepler").facts().dimension
    2
    """
    if isinstance(source, Scene):
        return source
    if isinstance(source, str) and "=" in source and "\n" in source:
        return _read(source, name)
    return Scene._of(_hbvm.Scene.load(os.fspath(source)))


def scenes() -> Listing:
    """The scenes that are built in.

    >>> import hbvm
    >>> "double_pendulum" in [entry.name for entry in hbvm.scenes()]
    True
    """
    found, text = _hbvm.scenes()
    return Listing([Record(entry) for entry in json.loads(found)["scenes"]], text)


Scene.__module__ = SceneFacts.__module__ = "hbvm"
