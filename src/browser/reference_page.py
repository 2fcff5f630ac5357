"""The pages of the stored reference solutions, one for each scene, under an address that stays."""

import hashlib
import json
import shlex
import subprocess
import tomllib
import urllib.parse
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from site_page import SitePage, escaped

LIST = "reference/index.html"
# A page shows so many numbers of a file; the rest is in the file.
SHOWN = 200
# The rows of a file, and what the program calls them.
ROWS = {"q": "positions", "p": "momenta, tangential to the constraints", "lambda": "multipliers of the constraints"}


@dataclass(frozen=True)
class StoredReference:
    """A file of the store."""

    file: Path

    @cached_property
    def table(self) -> dict:
        return tomllib.loads(self.file.read_text())

    @property
    def times(self) -> list[str]:
        return [state["t"] for state in self.table["time"]]

    @property
    def digits(self) -> int:
        return self.table["digits"]

    @property
    def proved(self) -> bool:
        return "proved" in self.table

    @property
    def agreed(self) -> int:
        """Digits in which the routes agree at all times."""
        return min(state["agreed"] for state in self.table["time"])

    @property
    def sha256(self) -> str:
        return hashlib.sha256(self.file.read_bytes()).hexdigest()

    def command(self, scene: Path) -> str:
        """What makes it; scenes of studies/scenes are known by their name."""
        name = scene.stem if scene.parent.name == "scenes" else f"studies/{scene.parent.name}/{scene.name}"
        when = ["--until", self.times[0]] if len(self.times) == 1 else ["--at", ",".join(self.times)]
        words = ["hbvm", "reference", name, *when, "--digits", str(self.digits), *(["--prove"] if self.proved else [])]
        return shlex.join([*words, "--out", self.file.name])

    def when(self) -> str:
        """Its times in words."""
        if len(self.times) < 4:
            return "t = " + ", ".join(self.times)
        return f"t = {self.times[0]}, {self.times[1]} … {self.times[-1]}"


@dataclass(frozen=True)
class ReferenceScene:
    """A scene, what the program says of it, and its stored references."""

    file: Path
    title: str
    source: str
    coordinates: list[str]
    constraints: list[str]
    references: list[StoredReference]

    @property
    def name(self) -> str:
        return self.file.stem

    @property
    def address(self) -> str:
        return f"reference/{self.name}/index.html"


def read_scene(file: Path, references: list[StoredReference], engine: list[str]) -> ReferenceScene:
    """A scene as `hbvm scene check` knows it; `engine` are the words that begin a command."""
    said = subprocess.run([*engine, "scene", "check", str(file), "--json"], check=True, capture_output=True, text=True)
    facts = json.loads(said.stdout)
    return ReferenceScene(file, facts["title"], facts["source"], facts["coordinates"], facts["constraints"], references)


def read_store(store: Path) -> dict[str, list[StoredReference]]:
    """All stored references, by the names of their scenes."""
    scenes: dict[str, list[StoredReference]] = {}
    for file in sorted(store.glob("*.toml")):
        reference = StoredReference(file)
        scenes.setdefault(reference.table["scene"], []).append(reference)
    return scenes


def reference_page(scene: ReferenceScene) -> SitePage:
    """The page of a scene; the files stand beside it."""
    most = max(reference.digits for reference in scene.references)
    last = scene.references[-1]
    run = {"scene": scene.name, "methods": ["hbvm:auto,3"], "step": "", "until": last.times[-1], "reference": True}
    lab = urllib.parse.quote(json.dumps(run))
    lead = (f'<p>{escaped(scene.title)} <span class="quiet">({escaped(scene.source)})</span>. '
            f'<a href="../../lab.html#{lab}">Run it in the lab</a></p>')
    return SitePage(scene.address, f"{scene.title}: reference solution to {most} digits",
                    f"{scene.title}: positions, momenta, multipliers and energy at {last.when()}, to {most} digits "
                    "found by two independent routes, with the file, its hash and the command that makes it.",
                    "\n".join(_section(scene, reference) for reference in scene.references),
                    heading=scene.name.replace("_", " "), lead=lead, kind="text prose reference")


def list_page(scenes: list[ReferenceScene]) -> SitePage:
    """All references, one a row."""
    rows = "\n".join(f'<tr><td><a href="{scene.name}/index.html#{reference.file.stem}">{escaped(scene.name)}</a></td>'
                     f"<td>{escaped(scene.title)}</td><td>{reference.when()}</td><td>{reference.digits}</td>"
                     f"<td>{'proved' if reference.proved else 'two routes'}</td></tr>"
                     for scene in scenes for reference in scene.references)
    head = "".join(f'<th scope="col">{name}</th>' for name in ("scene", "what it is", "times", "digits", "known by"))
    return SitePage(
        LIST, "Reference solutions of constrained mechanics",
        "End states of pendula, linkages, tops and satellites to 50 and 100 digits, each found by two routes that share "
        "only the scene, many of them proved.",
        f'<table class="wide"><thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody></table>', heading="References",
        lead="<p>End states with digits that can be trusted, to hold a program's results against. "
             'How they are found stands in the <a href="../handbook/reference/index.html">handbook</a>.</p>',
        kind="text prose reference")


def _section(scene: ReferenceScene, reference: StoredReference) -> str:
    file, table = reference.file.name, reference.table
    trust = (f"The digits are proved: bounds of all rounding hold them. The routes agree in {reference.agreed}."
             if reference.proved else f"The routes agree in {reference.agreed} digits.")
    routes = "".join(f"<li>{escaped(route['name'].replace('_', ' '))}: {escaped(route['settings'])}</li>"
                     for route in table["route"])
    return f"""<section id="{reference.file.stem}">
<h2>{reference.when()}, {reference.digits} digits</h2>
<p>{reference.digits} digits follow the leading one of each vector's greatest component. {trust}
The motion magnifies an error of its start by 10<sup>{escaped(table["digits_lost"])}</sup> until the end.</p>
{_states(scene, reference)}
<h3>The file</h3>
<p><a href="{file}" download>{file}</a>, of {table["date"]}. SHA-256:</p>
<pre><code>{reference.sha256}</code></pre>
<p>This command makes it:</p>
<pre><code>{escaped(reference.command(scene.file))}</code></pre>
<p>It reads in Python as:</p>
<pre><code>import tomllib
from decimal import Decimal
state = tomllib.load(open("{file}", "rb"))["time"][-1]
q = [Decimal(text) for text in state["q"]]</code></pre>
<details><summary>Routes</summary><ul>{routes}</ul></details>
</section>"""


def _states(scene: ReferenceScene, reference: StoredReference) -> str:
    """The last state, cut where it is long."""
    state = reference.table["time"][-1]
    momenta = [f"{body}.p{axis}" for body, _, axis in (name.rpartition(".") for name in scene.coordinates)]
    names = {"q": scene.coordinates, "p": momenta, "lambda": scene.constraints}
    rows = [("H", "energy", state["H"])]
    rows += [("", name, number) for name, number in zip(reference.table.get("observed", []), state.get("observed", []))]
    for row in ROWS:
        known = names[row] if len(names[row]) == len(state[row]) else [""] * len(state[row])
        rows += [(f"{row}<sub>{i}</sub>", name, number) for i, (name, number) in enumerate(zip(known, state[row]), 1)]
    meaning = "; ".join(f"{row}: {what}" for row, what in ROWS.items())
    cut = f"<p>The file has all {len(rows)} numbers.</p>" if len(rows) > SHOWN else ""
    times = len(reference.times)
    others = f"<p>The file has the states at {times} times. This is the last.</p>" if times > 1 else ""
    body = "\n".join(f"<tr><td>{symbol}</td><td>{escaped(name)}</td><td><code>{number}</code></td></tr>"
                     for symbol, name, number in rows[:SHOWN])
    caption = f'<caption class="quiet">At t = {state["t"]}. {meaning}</caption>'
    return f'{others}<table class="digits">{caption}<tbody>\n{body}\n</tbody></table>{cut}'
