"""The page of the atlas: coefficients of the literature, as the program judges them, in a table that can be sorted."""

import json
import re
import subprocess
import tomllib
from pathlib import Path

from site_page import SitePage, escaped

ADDRESS = "atlas/index.html"
COLUMNS = ["method", "family", "stages", "order", "embedded", "digits", "error constant", "properties", "year", "source"]
# Facts that have a column of their own, or say that something is not so.
LEFT_OUT = ("not ", "error constant", "explicit", "implicit")


def read_atlas(folder: Path, engine: list[str]) -> list[dict]:
    """What the program says of every file; `engine` are the words that begin a command."""
    said = subprocess.run([*engine, "audit", str(folder), "--json"], check=True, capture_output=True, text=True)
    return json.loads(said.stdout)


def atlas_page(folder: Path, found: list[dict]) -> SitePage:
    """The page; the files stand beside it."""
    rows = "\n".join(_row(folder, one) for one in found)
    head = "".join(f'<th scope="col" aria-sort="none"><button type="button">{name}</button></th>' for name in COLUMNS)
    return SitePage(
        ADDRESS, f"Atlas of {len(found)} integration methods",
        "Coefficients of Runge-Kutta, Nystrom, splitting, composition, Rosenbrock and multistep methods of the "
        "literature, each held against its order conditions, with errata.",
        f'<div class="scroll"><table class="sortable"><thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody>'
        "</table></div>",
        heading="Atlas of methods",
        lead="<p>Coefficients of the literature. Every row is what the program finds: the orders whose conditions are met, "
             "the digits to which they are, and what else the numbers show. A click on a heading sorts. "
             '<a href="../handbook/atlas/index.html">What was found wrong in print</a></p>',
        kind="text prose reference", scripts=("table_sort.js",))


def file_address(folder: Path, file: Path) -> str:
    """Where a file of the atlas stands in the site."""
    return f"atlas/{file.relative_to(folder)}"


def _row(folder: Path, found: dict) -> str:
    file = Path(found["file"])
    text = file.read_text()
    table = tomllib.loads(text)
    source = " ".join(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))
    source = source.partition("erratum:")[0].strip()
    year = re.search(r"\b(18|19|20)\d\d\b", source)
    order, *others = found["orders"]
    embedded = next((str(other["order"]) for other in others if other["name"] == "embedded order"), "")
    constant = next((fact.split()[-1] for fact in found["facts"] if fact.startswith("error constant")), "")
    facts = "; ".join(fact for fact in found["facts"] if not fact.startswith(LEFT_OUT))
    digits = f"{order['digits']:.1f}" if found["digits"] else "exact"
    stages = len(table.get("b", table.get("gamma", table.get("alpha", []))))
    cells = [f'<a href="{file.relative_to(folder)}" download>{escaped(found["name"])}</a>', escaped(found["family"]),
             str(stages), str(order["order"]), embedded, digits, constant, escaped(facts), year.group() if year else "",
             f"<details><summary>source</summary>{escaped(source)}</details>"]
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
