"""hbvm: energy-conserving integration of constrained mechanics at any precision.

>>> import hbvm
>>> run = hbvm.run("double_pendulum", "hbvm:4,2", step="1/16", until=2, precision="mpfr:50")
>>> run.t.shape, abs(run.energy_error).max() < 1e-9
((33,), True)
>>> len(run["a.x"].text[-1]) > 50
True

Numbers go in as int, str, Fraction, Decimal, mpf or float, and come out as float64 that know all their digits.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._against import Against
from ._audit import Audit, audit
from ._coefficients import Coefficients, coefficients
from ._columns import Columns, read_csv
from ._cost import Plan, cost
from ._errors import Error, InputError, IntegrationError, Interrupted
from ._facts import Nodes, methods, nodes, precision_of
from ._hbvm import version as __version__
from ._lesson import check_lesson, lessons
from ._number import Exact, FloatWarning, Number
from ._order import Order, Rung, verify_order
from ._page import Page
from ._record import Listing, Record
from ._reference import Reference, check_proof, reference
from ._run import Run, kept, run
from ._scene import Scene, SceneFacts, scene, scenes
from ._section import Periodic, Section, periodic, section
from ._solver import Judgement, judge
from ._study import Comparison, Convergence, Study, compare, convergence, study
from ._tangent import Tangent, reference_events, tangent

if TYPE_CHECKING:
    from ._arrays import Numbers

__all__ = [
    "Against", "Audit", "Coefficients", "Columns", "Comparison", "Convergence", "Error", "Exact", "FloatWarning", "InputError",
    "IntegrationError", "Interrupted", "Judgement", "Listing", "Nodes", "Number", "Numbers", "Order", "Page", "Periodic", "Plan", "Record", "Reference",
    "Run", "Rung", "Scene", "SceneFacts", "Section", "Study", "Tangent", "audit", "check_lesson", "check_proof", "coefficients", "compare", "convergence", "cost", "judge", "kept",
    "lessons", "methods", "nodes", "periodic", "precision_of", "read_csv", "reference", "reference_events", "run", "scene", "scenes", "section", "study", "tangent", "verify_order",
]


def __getattr__(name: str) -> Any:
    """What needs numpy waits until it is asked for."""
    if name == "Numbers":
        from ._arrays import Numbers

        return Numbers
    raise AttributeError(f"module 'hbvm' has no {name}")
