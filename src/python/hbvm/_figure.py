"""The program's figures, drawn by matplotlib."""
from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_POWERS = {"decimal": "10^{{{:g}}}", "binary": "2^{{{:g}}}", "falling": "10^{{-{:g}}}"}
_LINES = {
    "solid": {"linestyle": "-"},
    "bar": {"linestyle": "-", "linewidth": 3},
    "faint": {"linestyle": "-", "alpha": 0.35},
    "dashed": {"linestyle": "--"},
    "front": {"linestyle": "-", "linewidth": 1.5},
    "axis": {"linestyle": "-."},
    "mesh": {"linestyle": "-", "alpha": 0.2, "linewidth": 0.6},
}
_MARKS = {
    "body": {"marker": "o", "markersize": 8},
    "start": {"marker": "o", "fillstyle": "none", "markersize": 6},
    "fixed": {"marker": "s", "color": "black", "markersize": 5},
    "positive": {"marker": "P", "markersize": 7},
    "negative": {"marker": "_", "markersize": 9},
    "centre": {"marker": "x", "color": "black"},
    "joint": {"marker": "o", "fillstyle": "none", "markersize": 4},
}
_GREY = "#666666"
_MARKERS = "osD^vP*Xp"


def _words(text: str) -> str:
    """What is lowered and raised in gnuplot's words, in matplotlib's."""
    text = re.sub(r"\\(.)", lambda match: {"_": "\ue000", "^": "\ue001"}.get(match[1], match[1]), text)
    text = text.replace("$", r"\$")
    text = re.sub(r"([A-Za-z|]*)([_^])(\{[^}]*\}|\S)", r"$\\mathrm{\1}\2{\3}$", text)
    return text.replace("\ue000", "_").replace("\ue001", "^")


def _axis(axes: Axes, which: str, axis: dict[str, Any]) -> None:
    getattr(axes, f"set_{which}label")(_words(axis["label"]))
    ticks = axes.xaxis if which == "x" else axes.yaxis
    if axis["names"]:
        ticks.set_ticks(range(len(axis["names"])), [_words(name) for name in axis["names"]], fontsize=7)
    elif axis["scale"] in _POWERS:
        from matplotlib.ticker import FuncFormatter, MaxNLocator

        form = _POWERS[axis["scale"]]
        ticks.set_major_locator(MaxNLocator(6, integer=True))
        ticks.set_major_formatter(FuncFormatter(lambda value, _: "$" + form.format(value) + "$"))


def _points(points: list[Any]) -> tuple[list[float], list[float]]:
    return [point[0] for point in points], [point[1] for point in points]


def _panel(axes: Axes, panel: dict[str, Any], colours: list[str]) -> None:
    def colour_of(item: dict[str, Any]) -> str:
        return colours[item["colour"] % len(colours)] if item["colour"] is not None else _GREY

    axes.set_title(_words(panel["title"]), fontsize=10)
    for line in panel["lines"]:
        look = {"linewidth": 1.0, **_LINES[line["look"]]}
        axes.plot(*_points(line["points"]), color=colour_of(line), **look)
    for number, curve in enumerate(panel["curves"]):
        marker = _MARKERS[number % len(_MARKERS)] if curve["marked"] else None
        colour = colours[number % len(colours)]
        if curve["dots"]:
            axes.plot(*_points(curve["points"]), color=colour, marker=".", markersize=2, linestyle="none")
            continue
        axes.plot(*_points(curve["points"]), color=colour, marker=marker, markersize=4, linewidth=1.2,
                  label=_words(curve["label"]) or None)
    for mark in panel["marks"]:
        look = {"color": colour_of(mark), **_MARKS[mark["look"]]}
        axes.plot(*mark["at"], linestyle="none", **look)
        if mark["label"]:
            axes.annotate(_words(mark["label"]), mark["at"], textcoords="offset points", xytext=(5, 4), fontsize=8)
    for label in panel["labels"]:
        axes.annotate(_words(label["text"]), label["at"], fontsize=8)
    for bar in panel["bars"]:
        axes.bar(bar["x"], bar["to"] - bar["from_"], bottom=bar["from_"], width=0.7, color=colour_of(bar))
    if panel["equal_axes"]:
        axes.set_aspect("equal", adjustable="datalim")
    _axis(axes, "x", panel["x"])
    _axis(axes, "y", panel["y"])
    if panel["round_off"] is not None:
        bottom = min(axes.get_ylim()[0], panel["round_off"] - 0.5)
        axes.axhspan(bottom, panel["round_off"], color="black", alpha=0.08, linewidth=0)
        axes.set_ylim(bottom=bottom)
    if sum(bool(curve["label"]) for curve in panel["curves"]) > 1:
        axes.legend(fontsize=7, loc="best")


def drawn(figure: dict[str, Any]) -> Figure:
    """All panels, two in a row."""
    import matplotlib
    import matplotlib.pyplot as plt

    panels = figure["panels"]
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    made, grid = plt.subplots(rows, columns, figsize=(5.2 * columns, 3.6 * rows + 0.6), squeeze=False)
    for axes, panel in zip(grid.flat, panels):
        _panel(axes, panel, figure["colours"])
    for axes in list(grid.flat)[len(panels):]:
        axes.remove()
    made.suptitle(_words(figure["caption"]), fontsize=11)
    made.tight_layout()
    if "inline" in matplotlib.get_backend().lower():
        plt.close(made)  # a notebook shows what a cell returns, and need not show it twice
    return made
