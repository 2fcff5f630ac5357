#!/usr/bin/env python3
"""The page that `hbvm report` makes of results, in headless Chromium: report_test.py PROGRAM [FOLDER FOR SCREENSHOTS]

It has the tables and figures of the folder, complains of nothing, asks for nothing, and pointing at a point of a figure
reads the number of the CSV file; what stands in the files acts on nothing. Ends with 77 where there is no Chromium.
"""

import csv
import os
import re
import subprocess
import sys

import browser
from browser import check

SCENE = ["double_pendulum", "--digits-range", "2:8", "--methods", "hbvm:3,3", "hbvm:4,2", "rattle", "--seconds", "0.01"]


def command(program, *words):
    return subprocess.run([program, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def has_what_is_there(chromium, folder):
    files = sorted(os.listdir(folder))
    drawings = [name for name in files if name.endswith(".svg")]
    tables = [name for name in files if name.endswith(".csv")]
    check(len(drawings) >= 6, f"hbvm cost drew {drawings} only")
    check(chromium.evaluate("""[...document.querySelectorAll('figure.drawing img')]
        .filter((picture) => picture.complete && picture.naturalWidth > 0).length""") == len(drawings),
          "not every drawing is a figure")
    # Besides a table of facts on top, and one of cost.json.
    check(chromium.evaluate("document.querySelectorAll('.table:not(.facts) table').length") == len(tables),
          "not every CSV file is a table")
    check("double_pendulum" in chromium.evaluate("document.title"), "the title does not say of what")
    facts = chromium.evaluate("document.querySelector('.facts').textContent")
    for word in ("hbvm cost double_pendulum", "--seconds 0.01", "machine", "version"):
        check(word in facts, f"{word} is not among {facts}")


def rows_are_those_of(chromium, path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    shown = chromium.evaluate(f"""[...document.getElementById({os.path.basename(path)!r}).querySelectorAll('tr')]
        .map((row) => [...row.cells].map((cell) => cell.textContent))""")
    check(shown == rows, f"{path} is shown as {shown[:3]}")


def pointing_reads_values(chromium, path):
    """Of points of steps.svg, each of which a row of steps.csv is of."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["precision"].startswith("mpfr")]
    at = chromium.evaluate("""(() => {
      const drawing = document.getElementById('step_time.svg').querySelector('.drawing');
      drawing.scrollIntoView({ block: 'center' });
      const figure = JSON.parse(drawing.querySelector('script').textContent), picture = drawing.querySelector('img');
      const panel = figure.panels[0], box = picture.getBoundingClientRect(), scale = box.width / figure.size[0];
      const [left, top, width, height] = panel.box;
      // What the picture shows, over it, to look into.
      const drawn = new DOMParser().parseFromString(decodeURIComponent(picture.src.split(/,(.*)/s)[1]), 'image/svg+xml');
      Object.assign(drawn.documentElement.style, { position: 'absolute', left: 0, top: 0, pointerEvents: 'none',
                                                   width: `${box.width}px`, height: `${box.height}px` });
      picture.after(drawn.documentElement);
      return panel.curves.find((curve) => curve.label === 'RATTLE').points.map(([x, y]) => [
        box.left + scale * (left + width * (x - panel.x.from) / (panel.x.to - panel.x.from)),
        box.top + scale * (top + height - height * (y - panel.y.from) / (panel.y.to - panel.y.from))]);
    })()""")
    check(len(at) == len(rows) > 3, f"{len(at)} points are of {len(rows)} rows")
    for row, (x, y) in zip(rows, at):
        chromium.mouse("mouseMoved", x + 1, y - 1)
        text = chromium.evaluate("value.hidden ? 'nothing' : value.textContent")
        check(text.startswith("RATTLE\n"), f"{text} is shown at a point of RATTLE")
        seconds = float(re.search(r"time of a step / s: (\S+)", text)[1])
        digits = float(re.search(r"working digits: (\S+)", text)[1])
        check(abs(seconds - float(row["seconds"])) <= 0.006 * seconds, f"{seconds} s instead of {row['seconds']}")
        check(abs(digits - float(row["precision"].split(":")[1])) < 0.006 * digits, f"{digits} of {row['precision']}")
        # A mark of the drawing itself is drawn there, so that the box is where the data say.
        near = chromium.evaluate(f"""[...document.getElementById('step_time.svg').querySelectorAll('svg use')].some((mark) => {{
          const box = mark.getBoundingClientRect();
          return Math.hypot(box.left + box.width / 2 - {x}, box.top + box.height / 2 - {y}) < 3;
        }})""")
        check(near, f"nothing is drawn at {x}, {y}")
        ring = chromium.evaluate("""(() => {
          const box = document.querySelector('.mark:not([hidden])').getBoundingClientRect();
          return [box.left + box.width / 2, box.top + box.height / 2];
        })()""")
        check(max(abs(ring[0] - x), abs(ring[1] - y)) < 1, f"the ring is at {ring}, not at {x}, {y}")
    chromium.evaluate("document.querySelector('.drawing svg').remove()")
    chromium.mouse("mouseMoved", 1, 1)
    check(chromium.evaluate("value.hidden"), "the value stays")


def fits(chromium, width):
    chromium.resize(width, 900)
    wide = chromium.evaluate("document.documentElement.scrollWidth")
    check(wide <= width, f"the page is {wide} pixels wide in a window of {width}")


def follows_the_scheme(chromium):
    back = []
    for scheme in ("light", "dark"):
        chromium.prefer(color_scheme=scheme)
        back.append(chromium.evaluate("getComputedStyle(document.body).backgroundColor"))
    check(back[0] == "rgb(255, 255, 255)" and back[1] != back[0], f"backgrounds are {back}")
    chromium.prefer(color_scheme="light")


def nothing_acts(chromium, program, folder):
    """Files with what would act in a page."""
    bad = os.path.join(folder, "bad")
    os.mkdir(bad)
    evil = "<script>window.acted = 1</script><img src=x onerror='window.acted = 2'>"
    for name, text in {"t.csv": f"a\n\"{evil}\"\n", "r.json": '{"command": "</script>' + evil.replace('"', "'") + '"}',
                       "README.md": f"# {evil}\n\n{evil} [x](javascript:window.acted=3) ![y](https://example.org/y.svg)\n",
                       "a.svg": "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='40' onload='window.acted=4'><script>window.acted=5</script>"
                                "<image href='https://example.org/a.png'/><a href='javascript:window.acted=6'><text>t</text></a>"
                                "<rect width='9' height='9' onclick='window.acted=7'/>"
                                "<metadata id=\"hbvm-figure\">{\"size\": [1, 1], \"panels\": [], \"x\": \"&lt;/script>"
                                "&lt;script>window.acted=8&lt;/script>\"}</metadata></svg>"}.items():
        with open(os.path.join(bad, name), "w", encoding="utf-8") as file:
            file.write(text)
    command(program, "report", bad)
    chromium.open(os.path.join(bad, "report.html"))
    check(chromium.evaluate("window.acted === undefined"), "something acted")
    check(chromium.evaluate("[...document.images].map((picture) => picture.src.slice(0, 19))") == ["data:image/svg+xml,"],
          "there is another picture than the drawing")
    check(chromium.evaluate("document.querySelectorAll('svg, script:not([type]), [onload], [onclick], [href^=j]').length") == 1,
          "something was left that may act")
    chromium.check_quiet("the page of bad files")


def report(program, page, folder, pictures):
    out = os.path.join(folder, "cost")
    command(program, "cost", *SCENE, "--out", out)
    command(program, "report", out)
    path = os.path.join(out, "report.html")
    check(os.path.getsize(path) < 3_000_000, f"{os.path.getsize(path)} bytes are too many")
    page.open(path)
    has_what_is_there(page, out)
    rows_are_those_of(page, os.path.join(out, "steps.csv"))
    for width in (1280, 400):
        fits(page, width)
        pointing_reads_values(page, os.path.join(out, "steps.csv"))
    follows_the_scheme(page)
    page.check_quiet("the page")
    if pictures:
        page.resize(1280, 2400)
        page.screenshot(os.path.join(pictures, "report.png"))
    nothing_acts(page, program, folder)


sys.exit(browser.test(report, width=1280, height=900))
