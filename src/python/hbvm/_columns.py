"""Tables of numbers by the names of their columns."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterator

from . import _hbvm

if TYPE_CHECKING:
    import pandas

    from ._arrays import Numbers


class Columns:
    """Columns of exact numbers: `columns["a.x"]` is an array that knows all digits.

    >>> import hbvm
    >>> kept = hbvm.run("kepler", step="1/8", until="1/4", precision=30).trajectory
    >>> kept.columns[:3], len(kept)
    (['t', 'planet.x', 'planet.y'], 3)
    >>> kept["t"].text
    ['0', '0.125', '0.25']
    """

    def __init__(self, raw: Any) -> None:
        self._raw = raw

    @property
    def columns(self) -> list[str]:
        """Names."""
        return self._raw.columns

    def __getitem__(self, name: str) -> Numbers:
        from ._arrays import Numbers

        raw = self._raw
        return Numbers(lambda: raw.text(name), values=raw.values(name))

    def __len__(self) -> int:
        return len(self._raw)

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def to_pandas(self, dtype: type = float) -> pandas.DataFrame:
        """A DataFrame: of float64, or with `dtype=object` of mpmath's numbers with all digits."""
        import pandas

        from ._number import mpf_of

        if dtype is float:
            return pandas.DataFrame({name: self._raw.values(name) for name in self.columns})
        if dtype is not object:
            raise TypeError("dtype is float or object")
        exact = {name: [mpf_of(text) for text in self._raw.text(name)] for name in self.columns}
        return pandas.DataFrame(exact, dtype=object)

    def to_csv(self, file: str | os.PathLike[str] | None = None) -> str | None:
        """Writes all digits into a file, or returns them as text."""
        import csv
        import io

        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(zip(*(self._raw.text(name) for name in self.columns)))
        if file is None:
            return out.getvalue()
        with open(file, "w", encoding="utf-8", newline="") as stream:
            stream.write(out.getvalue())
        return None

    def __repr__(self) -> str:
        most = 5
        rows = [self._raw.text(name) for name in self.columns]
        cells = [list(row) for row in zip(*rows)]
        left_out = len(cells) - 2 * most
        if left_out > 0:
            cells = cells[:most] + cells[-most:]
        heading = f"{len(self)} rows" + (f", the middle {left_out} left out" if left_out > 0 else "")
        short = [[_short(cell) for cell in row] for row in cells]
        return _hbvm.table_text(heading, self.columns, short, "text").rstrip("\n")


def _short(text: str) -> str:
    try:
        return text if len(text) < 12 else f"{float(text):.8g}"
    except ValueError:
        return text


def read_csv(file: str | os.PathLike[str]) -> Columns:
    """Reads numbers with all their digits from a CSV file, as `hbvm run --out` writes it. Lines that begin with # are
    left out.

    >>> import hbvm, os, tempfile
    >>> run = hbvm.run("kepler", step="1/8", until="1/4", precision=30)
    >>> name = os.path.join(tempfile.mkdtemp(), "run.csv")
    >>> run.to_csv(name)
    >>> hbvm.read_csv(name)["planet.x"].text == run["planet.x"].text
    True
    """
    import csv

    from ._errors import InputError

    with open(file, encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.reader(stream) if row and not row[0].startswith("#")]
    if not rows:
        raise InputError(f"{os.fspath(file)} has no line")
    columns = rows.pop(0)
    for number, row in enumerate(rows, start=1):
        if len(row) != len(columns):
            raise InputError(
                f"{os.fspath(file)}: row {number} has {len(row)} cells, and there are {len(columns)} columns"
            )
    return Columns(_hbvm.Trajectory(columns, rows))


Columns.__module__ = "hbvm"
