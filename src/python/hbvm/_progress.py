"""How far work is."""
from __future__ import annotations

from typing import Any, Callable, Union

#: Called as f(done, of) some times a second; or True for a bar of tqdm, or None.
Progress = Union[Callable[[float, float], Any], bool, None]


class Bar:
    """A bar of tqdm, for as long as the work goes on."""

    def __init__(self, progress: Progress, what: str) -> None:
        self._bar: Any = None
        self.callback: Any = progress if callable(progress) else None
        if progress is True:
            from tqdm.auto import tqdm

            self._bar = tqdm(total=1.0, desc=what, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}<{remaining}")
            self.callback = self._update

    def _update(self, done: float, of: float) -> None:
        self._bar.n = done / of if of else 0
        self._bar.refresh()

    def __enter__(self) -> Any:
        return self.callback

    def __exit__(self, *failure: object) -> None:
        if self._bar is not None:
            self._bar.close()
