"""The package: its pages, its names, and what it costs to import."""
import doctest
import importlib
import pathlib
import pkgutil
import subprocess
import sys

import pytest

import hbvm

MODULES = sorted(name for _, name, _ in pkgutil.iter_modules(hbvm.__path__) if name != "_hbvm")
SOURCES = pathlib.Path(__file__).resolve().parents[2] / "src/python"


@pytest.mark.parametrize("name", ["", *MODULES])
def test_the_examples_of_docstrings_are_right(name):
    module = importlib.import_module(f"hbvm.{name}" if name else "hbvm")
    result = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert result.failed == 0


def test_every_public_function_has_a_docstring_with_an_example():
    without = [
        name
        for name in hbvm.__all__
        if callable(getattr(hbvm, name)) and not isinstance(getattr(hbvm, name), type)
        and ">>>" not in (getattr(hbvm, name).__doc__ or "")
    ]
    assert set(without) <= {"Exact", "study", "kept"}  # a type; it writes files; run() tells of it
    assert all(getattr(hbvm, name).__doc__ for name in hbvm.__all__ if name != "Exact")


def test_what_is_large_is_imported_when_it_is_needed():
    code = "import sys, hbvm; print([m for m in ('numpy', 'mpmath', 'matplotlib', 'pandas', 'tqdm') if m in sys.modules])"
    said = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert said.strip() == "[]"


def test_what_is_public_says_that_it_is_of_hbvm():
    for name in hbvm.__all__:
        assert getattr(getattr(hbvm, name), "__module__", "hbvm").split(".")[0] in ("hbvm", "typing"), name
