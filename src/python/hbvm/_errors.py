"""What can go wrong, with the program's words."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._columns import Columns


class Error(Exception):
    """Root of all errors of hbvm. The text says what is wrong, where, and what to do."""

    #: The mesh points until then, of a run that could not go on.
    trajectory: Columns | None = None


class InputError(Error, ValueError):
    """What was asked for is wrong: a scene, a number, a method, a step.

    >>> import hbvm
    >>> hbvm.scene("keplar")
    Traceback (most recent call last):
        ...
    hbvm.InputError: unknown scene 'keplar': no readable file and no built-in scene; did you mean 'kepler'?
    """


class IntegrationError(Error):
    """The input is right, but the computation could not go on. What a run has is in `trajectory`."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended the work. What a run has is in `trajectory`, and in a notebook in `hbvm.kept()`."""

    trajectory: Columns | None = None


for _public in (Error, InputError, IntegrationError, Interrupted):
    _public.__module__ = "hbvm"
