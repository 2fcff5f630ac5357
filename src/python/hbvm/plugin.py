"""A fixture for pytest: references that are computed once, and kept from one session to the next."""
from __future__ import annotations

import hashlib
import json
from typing import Any, Callable

import pytest

from . import _hbvm
from ._reference import Reference, _times, reference
from ._scene import SceneLike
from ._scene import scene as scene_of


@pytest.fixture(scope="session")
def hbvm_reference(request: pytest.FixtureRequest) -> Callable[..., Reference]:
    """Is called as `hbvm.reference` is. What it found is kept in pytest's cache."""

    def kept(scene: SceneLike, *, at: Any, digits: int = 30, **options: Any) -> Reference:
        found = scene_of(scene)
        asked = json.dumps([_hbvm.version, found.toml, found.name, _times(at), digits, sorted(options.items())])
        key = "hbvm/" + hashlib.sha256(asked.encode()).hexdigest()
        cache = request.config.cache
        facts = cache.get(key, None) if cache else None
        if facts is None:
            facts = reference(found, at=at, digits=digits, **options)._facts
            if cache:
                cache.set(key, facts)
        return Reference(facts, (found.toml, found.name))

    return kept
