#!/usr/bin/env python3
"""The pages that `hbvm run --plot FILE.html` writes, in headless Chromium: page_test.py PROGRAM [FOLDER FOR SCREENSHOTS]

They draw without a complaint and without the network, the scene moves, and what they show are the numbers of the run's CSV
file. Ends with 77, by which CTest knows a test that was skipped, where there is no Chromium.
"""

import csv
import json
import math
import os
import subprocess
import sys
import time
import tomllib
from fractions import Fraction

import browser
from browser import Failure, check

RUNS = {
    "double_pendulum": ["--method", "hbvm:3,3", "--step", "1/16", "--until", "10"],
    "tethered_satellites": ["--method", "hbvm:5,3", "--step", "0.1", "--until", "40"],
    "double_physical_pendulum": ["--method", "hbvm:3,3", "--step", "1/32", "--until", "8"],
    "gyroscope_on_gimbal": ["--method", "hbvm:3,3", "--step", "1/32", "--until", "8"],
    "kepler": ["--method", "hbvm:4,2", "--step", "1/16", "--until", "10", "--reverse"],
    "chain": ["--method", "hbvm:1,1", "--step", "1/256", "--until", "20"],
    "quartic_oscillator": ["--method", "hbvm:4,2", "--step", "1", "--until", "1"],
}


def read_csv(path):
    """Names of the columns, t first and then q, and rows of numbers."""
    with open(path, newline="") as file:
        names, *rows = csv.reader(file)
    return names, [[float(x) for x in row] for row in rows]


def run(program, scene, folder):
    page, table = os.path.join(folder, scene + ".html"), os.path.join(folder, scene + ".csv")
    subprocess.run([program, "run", scene, *RUNS[scene], "--plot", page, "--out", table], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    check(os.path.getsize(page) < 1_000_000, f"{os.path.getsize(page)} bytes are too many")
    return page, *read_csv(table)


def positions_are_those_of(chromium, rows):
    """Of every place that is a body, which one block of coordinates moves; and of all places at two times."""
    count, every, places, dimension = (
        chromium.evaluate(f"player.motion.{name}") for name in ("count", "every", "places", "dimension"))
    compared = 0
    for index in {0, 1, count // 2, count - 1}:
        row = rows[-1] if index == count - 1 else rows[index * every]
        check(chromium.evaluate(f"player.motion.t({index})") == row[0], f"state {index} is of another time")
        shown = chromium.evaluate(f"player.motion.places.map((_, i) => player.motion.position(i, {index}))")
        for place, at in zip(places, shown):
            for j in range(dimension):
                expected = float(place["shift"][j]) if place["shift"] else 0.0
                for offset, weight in place["blocks"]:
                    expected += float(weight) * row[1 + offset + j]
                check(at[j] == expected, f"{place['name']} is at {at[j]}, not {expected}, at t = {row[0]}")
                compared += 1
    check(compared > 0, "nothing was compared")


def it_moves(chromium):
    """What is drawn differs from time to time, and playing makes time pass."""
    picture = "document.querySelector('#stage canvas').toDataURL()"
    chromium.evaluate("player.choose(0)")
    first = chromium.evaluate(picture)
    chromium.evaluate("player.choose(player.last)")
    check(chromium.evaluate(picture) != first, "the scene is drawn alike at start and end")
    if chromium.evaluate("player.last") < 20:
        return
    chromium.evaluate("player.choose(0)")
    chromium.press(" ")
    until = time.monotonic() + browser.PATIENCE
    while chromium.evaluate("player.index") == 0:
        check(time.monotonic() < until, "playing moves nothing")
        time.sleep(0.05)
    chromium.press(" ")
    check(not chromium.evaluate("player.playing"), "space does not pause")
    index = chromium.evaluate("player.index")
    chromium.press("ArrowRight")
    check(chromium.evaluate("player.index") == index + 1, "the right arrow does not go on by one")
    chromium.press("Home")
    check(chromium.evaluate("document.getElementById('slider').value") == "0", "the slider does not follow")


def number(text):
    """−1.25·10⁻⁷ as Numbers of the page prints it."""
    for n, raised in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹"):
        text = text.replace(raised, str(n))
    return float(text.replace("⁻", "-").replace("−", "-").replace("·10", "e"))


def cursor_values_are_those_of(chromium, names, rows):
    """Errors and multipliers of a run of which every state is shown, in as many digits as there are."""
    if chromium.evaluate("player.motion.every") != 1:
        return
    columns = {"|H − H₀|": names.index("delta_H"), "|g|": names.index("g"), "hidden": names.index("hidden")}
    for index in (0, 1, chromium.evaluate("player.last") // 2, chromium.evaluate("player.last")):
        chromium.evaluate(f"player.choose({index})")
        shown = chromium.evaluate("""player.charts.flatMap((chart) => chart.chart.curves.map((curve, i) =>
            [curve.name, curve.number ?? 0, chart.entries[i].value.textContent]))""")
        for name, constraint, text in shown:
            column = names.index(f"lambda{constraint}") if constraint else columns[name]
            expected = rows[index][column] if constraint else abs(rows[index][column])
            digits = 5e-5 if constraint else 5e-3
            check((text == "0") == (expected == 0) and math.isclose(number(text), expected, rel_tol=1.01 * digits),
                  f"{name} is shown as {text} instead of {expected} at t = {rows[index][0]}")


def bodies_are_drawn_where_they_are(chromium):
    """Each at its place on the canvas, in its colour, unless another is before it: at two times."""
    for index in (0, chromium.evaluate("player.last")):
        chromium.evaluate(f"player.choose({index})")
        drawn = chromium.evaluate("""(() => {
          const { stage, motion, theme } = player, ratio = stage.canvas.width / stage.width;
          const copy = () => document.createElement('canvas').getContext('2d', { willReadFrequently: true });
          const probe = copy(), picture = copy();
          [picture.canvas.width, picture.canvas.height] = [stage.canvas.width, stage.canvas.height];
          picture.drawImage(stage.canvas, 0, 0);
          const at = motion.masses.map((place) => stage.drawnAt(place));
          const alone = (i) => at.every(([x, y], j) => i === j || Math.hypot(x - at[i][0], y - at[i][1]) > 2 * stage.letter);
          return motion.masses.flatMap((place, i) => {
            if (!alone(i) || Number(motion.places[place].charge) !== 0) return [];
            probe.fillStyle = theme.colour(i);
            probe.fillRect(0, 0, 1, 1);
            const [x, y] = at[i].map((coordinate) => Math.round(coordinate * ratio));
            const seen = [...picture.getImageData(x, y, 1, 1).data], wanted = [...probe.getImageData(0, 0, 1, 1).data];
            return [[motion.places[place].name, x, y, stage.canvas.width, stage.canvas.height, seen, wanted]];
          });
        })()""")
        for name, x, y, width, height, seen, wanted in drawn:
            check(0 < x < width and 0 < y < height, f"{name} is at {x}, {y}, outside of the picture")
            check(all(abs(a - b) < 8 for a, b in zip(seen, wanted)), f"at {name}'s place is {seen}, not {wanted}")


def views_show_two_axes(chromium):
    """Seen along an axis, what is drawn moves as the two other coordinates do, right and up."""
    planar = chromium.evaluate("player.stage.planar")
    for side, across, up in [("oblique", 0, 1)] if planar else [("x", 1, 2), ("y", 0, 2), ("z", 0, 1)]:
        drawn, at, scale = chromium.evaluate(f"""(() => {{
          const {{ stage, motion }} = player, place = motion.masses[motion.masses.length - 1], states = [0, player.last];
          stage.resetView('{side}');
          return [states.map((i) => stage.drawnAt(place, i)), states.map((i) => motion.position(place, i)), stage.scale];
        }})()""")
        moved, drawn_move = [b - a for a, b in zip(*at)], [b - a for a, b in zip(*drawn)]
        expected = [scale * moved[across], -scale * moved[up]]
        check(scale > 0 and all(abs(a - b) < 1e-6 for a, b in zip(drawn_move, expected)),
              f"seen along {side} the last body moves by {drawn_move[:2]} pixels, not {expected}")
    chromium.evaluate("player.stage.resetView()")


def it_can_be_turned(chromium):
    """By dragging: a scene in space shows another side, a planar one is shifted; a double click brings it back."""
    box = chromium.evaluate("""(() => {
      const at = player.stage.canvas.getBoundingClientRect();
      return [at.left + at.width / 2, at.top + at.height / 2];
    })()""")
    where = "[player.stage.azimuth, player.stage.elevation, ...player.stage.shift]"
    before = chromium.evaluate(where)
    chromium.drag(box, [box[0] + 60, box[1] + 30])
    after = chromium.evaluate(where)
    changed = [a != b for a, b in zip(after, before)]
    if chromium.evaluate("player.stage.planar"):
        check(changed[:2] == [False, False] and after[2:] == [60, 30], f"dragging changes {before} to {after}")
    else:
        check(changed == [True, True, False, False], f"dragging changes {before} to {after}")
    chromium.evaluate("player.stage.canvas.dispatchEvent(new MouseEvent('dblclick'))")
    check(chromium.evaluate(where) == before, "a double click does not bring the view back")


def names_are_not_cut(chromium):
    """Beside long values, and numbers of constraints, which are short, beside the longest that there are."""
    chromium.evaluate("player.choose(Math.round(player.last / 2))")
    cut = chromium.evaluate("""player.charts.flatMap((chart) => chart.entries.flatMap(({ value }, i) => {
      const name = value.previousSibling, shown = value.textContent;
      value.textContent = name.textContent.startsWith('λ') ? '−8.8888·10⁻¹²³' : '−8.8888·10⁻¹²';
      const missing = name.scrollWidth > name.clientWidth + 1;
      value.textContent = shown;
      return missing ? [name.textContent] : [];
    }))""")
    check(not cut, f"the names {cut} are cut")


def curves_go_to_a_time(chromium):
    if chromium.evaluate("player.last") < 20:
        return
    box = chromium.evaluate("""(() => {
      const chart = player.charts[0], area = chart.graph.getArea(), at = chart.canvas.getBoundingClientRect();
      return [at.left + area.x + area.w / 2, at.top + area.y + area.h / 2];
    })()""")
    chromium.evaluate("player.choose(0)")
    chromium.drag(box, box)
    middle = chromium.evaluate("player.index / player.last")
    check(0.4 < middle < 0.6, f"a click in the middle of a curve goes to {middle} of the run")


def curves_are_drawn_in_order(chromium):
    """Of time, also backwards, as dygraphs wants them; with gaps where an error has no logarithm."""
    wrong = chromium.evaluate("""player.charts.flatMap(({ chart, graph, motion }) => motion.rows.flatMap((row, i) => {
      const at = motion.direction < 0 ? motion.count - 1 - i : i;
      const right = graph.getValue(at, 0) === row[0] && (at === 0 || graph.getValue(at - 1, 0) < row[0]) &&
        chart.curves.every(({ column }, k) => graph.getValue(at, k + 1) === (Number.isFinite(row[column]) ? row[column] : null));
      return right ? [] : [i];
    }))""")
    check(not wrong, f"states {wrong[:5]} are not drawn as they are")


def paths_are_round(chromium):
    """Between two states too, Kepler's planet is on its ellipse, r = 3/4 - x/2."""
    farthest = chromium.evaluate("""(() => {
      const { stage } = player, [path] = stage.paths, zero = stage.project(stage.middle.map((x) => -x));
      return Math.max(...path.slice(1).map(([x, y, , ...bend], i) => {
        const middle = [x, y].map((to, j) => (path[i][j] + 3 * bend[j] + 3 * bend[2 + j] + to) / 8 - zero[j]);
        return Math.abs(Math.hypot(...middle) + middle[0] / 2 - 0.75 * stage.scale) / stage.scale;
      }));
    })()""")
    check(farthest is not None and farthest < 1e-4, f"the path is {farthest} beside the orbit")


def pages(program, chromium, folder, pictures):
    for scene in RUNS:
        path, names, rows = run(program, scene, folder)
        chromium.open(path)
        chromium.check_quiet(scene)
        check(not chromium.evaluate("player.playing"), f"{scene} plays though motion is not wanted")
        try:
            positions_are_those_of(chromium, rows)
            it_moves(chromium)
            cursor_values_are_those_of(chromium, names, rows)
            for part in (curves_go_to_a_time, curves_are_drawn_in_order, bodies_are_drawn_where_they_are,
                         it_can_be_turned, views_show_two_axes, names_are_not_cut, labels_are_apart):
                part(chromium)
            if scene == "kepler":
                paths_are_round(chromium)
        except Failure as failure:
            raise Failure(f"{scene}: {failure}") from None
        check(not chromium.complaints, f"{scene}: {chromium.complaints}")
        if pictures:
            chromium.evaluate("player.choose(Math.round(player.last * 0.6))")
            for width, height in ((1366, 768), (1920, 1080)):
                chromium.resize(width, height)
                time.sleep(0.5)
                chromium.screenshot(os.path.join(pictures, f"{scene}_{width}.png"))
            chromium.resize(1366, 768)
        print(f"{scene}: {os.path.getsize(path)} bytes, {chromium.evaluate('player.motion.count')} states")


def labels_are_apart(chromium):
    """On one another stand no two names, at any of some times; the names of few bodies are all there."""
    for share in (0, 0.3, 0.6, 1):
        chromium.evaluate(f"player.choose(Math.round({share} * player.last))")
        labels = chromium.evaluate("player.stage.labels")
        for i, (name, left, top, right, bottom) in enumerate(labels):
            for other, l, t, r, b in labels[:i]:
                check(right <= l or r <= left or bottom <= t or b <= top, f"{name} stands on {other}")
        bodies = chromium.evaluate("player.motion.masses.length")
        if bodies <= 3:
            shown = ", ".join(label[0] for label in labels)
            for name in chromium.evaluate("player.motion.masses.map((i) => player.motion.places[i].name)"):
                check(name in shown, f"the name {name} is not among {shown}")


def no_body_is_missing(chromium):
    """Each body of the scene's file is drawn, and each rigid one is a solid or a bar: the picture differs without it."""
    scene = tomllib.loads(chromium.evaluate("document.getElementById('scene').textContent"))
    names = [body["name"] for body in scene.get("body", [])]
    rigid = [body["name"] for body in scene.get("rigid_body", [])]
    shown = chromium.evaluate("player.motion.masses.map((i) => player.motion.places[i].name)")
    check(sorted(shown) == sorted(names + rigid), f"{shown} are shown instead of {names + rigid}")
    chromium.evaluate("player.choose(0)")
    for name in rigid:
        same = chromium.evaluate(f"""(() => {{
          const {{ stage, motion }} = player, {{ bodies, links }} = motion, picture = () => stage.canvas.toDataURL();
          const place = motion.places.findIndex((one) => one.name === {json.dumps(name)}), before = picture();
          motion.bodies = bodies.filter((body) => body.place !== place);
          motion.links = links.filter(([a, , as]) => as !== 'body' || motion.places[a].of !== place);
          stage.draw();
          const after = picture();
          [motion.bodies, motion.links] = [bodies, links];
          stage.draw();
          return before === after || picture() !== before;
        }})()""")
        check(not same, f"the rigid body {name} is not drawn")
    held = [c for c in scene.get("constraint", []) if c["kind"] in ("plane", "quadric") or (c["kind"] == "formula" and "on" in c)]
    lines = chromium.evaluate("player.motion.meshes.length + player.motion.curves.length")
    check((lines > 0) == any(c.get("on", c.get("body")) in names for c in held), f"{lines} lines are shown of what bodies are held on")


# Steps of scenes that move faster than the others.
FAST = {"andrews_squeezer": "1/8192", "heavy_top_150": "1/1024", "slider_crank": "1/2048"}
# The marks of the pins cover bars that are six pixels long.
CROWDED = {"four_bars_40"}


def all_scenes(program, chromium, folder, pictures):
    answer = subprocess.run([program, "scenes", "--json"], check=True, capture_output=True, text=True)
    for scene in [one["name"] for one in json.loads(answer.stdout)["scenes"]]:
        path = os.path.join(folder, scene + "_short.html")
        step = Fraction(FAST.get(scene, "1/64"))
        subprocess.run([program, "run", scene, "--step", str(step), "--until", str(16 * step), "--plot", path], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        chromium.open(path)
        try:
            for part in (no_body_is_missing, bodies_are_drawn_where_they_are, labels_are_apart):
                if part is not no_body_is_missing or scene not in CROWDED:
                    part(chromium)
        except Failure as failure:
            raise Failure(f"{scene}: {failure}") from None
        chromium.check_quiet(scene)
        if pictures:
            chromium.screenshot(os.path.join(pictures, f"{scene}_short.png"))


def with_data(path, change):
    """A copy of a page whose data `change` has made others."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    tag = '<script type="application/json" id="run">'
    begin = text.index(tag) + len(tag)
    end = text.index("</script>", begin)
    data = json.loads(text[begin:end])
    change(data)
    changed = path.replace(".html", "_changed.html")
    with open(changed, "w", encoding="utf-8") as file:
        file.write(text[:begin] + json.dumps(data).replace("<", "\\u003c") + text[end:])
    return changed


def no_bodies(data):
    dimension = data["sketch"]["dimension"]
    data["sketch"] = {"dimension": dimension, "places": [], "links": [], "bodies": [], "solids": [], "meshes": [], "curves": []}


def no_numbers(data):
    for i, row in enumerate(data["samples"]):
        row[1:] = [["NaN", "Infinity", "-Infinity"][(i + j) % 3] for j in range(len(row) - 1)]


def some_numbers(data):
    for row in data["samples"][::2]:
        row[1:] = ["NaN"] * (len(row) - 1)


def one_state(data):
    data["samples"] = data["samples"][:1]


def many_multipliers(data):
    curves = data["charts"][0]["curves"]
    curves += [dict(curves[0], number=i, name="a rod with a name that is long") for i in range(3, 60)]


def odd_data(program, chromium, folder):
    """What no number can be drawn of, and scenes with nothing in them, are drawn without a complaint."""
    for scene in ("double_pendulum", "tethered_satellites"):
        path, _, _ = run(program, scene, folder)
        for change in (no_bodies, no_numbers, some_numbers, one_state, many_multipliers):
            chromium.open(with_data(path, change))
            what = f"{scene}, {change.__name__}"
            check(chromium.evaluate("typeof player") == "object", f"{what}: {chromium.complaints}")
            for action in ("player.play(true)", "player.choose(1)", "player.choose(player.last)",
                           "player.stage.centreOn('mean')", "player.stage.nearer(2)", "player.stage.resetView('z')",
                           "document.querySelectorAll('details').forEach((part) => (part.open = true))"):
                chromium.evaluate(action)
                check(chromium.evaluate("0 < player.stage.scale && player.stage.scale < 1e9"), f"{what}: no scale")
            check(not chromium.complaints, f"{what}: {chromium.complaints}")
            if change is no_numbers:
                shown = chromium.evaluate("player.charts[0].entries[0].value.textContent")
                check(shown == "–", f"{what}: a number is shown that is none: {shown}")
            if change is many_multipliers:
                height = chromium.evaluate("player.charts[0].plot.clientHeight")
                check(height > 60, f"{what}: the names leave {height} pixels to the curves")


def many_charts(data):
    many_multipliers(data)
    data["charts"][:0] = 20 * data["charts"][-1:]


def charts_have_room(program, chromium, folder):
    """However many there are: nothing stands on anything else, all names are there, and the controls are in sight."""
    path, _, _ = run(program, "double_pendulum", folder)
    changed = with_data(path, many_charts)
    for width, height in ((360, 740), (1280, 720), (1400, 900), (1920, 1080)):
        chromium.resize(width, height)
        chromium.open(changed)
        wrong = chromium.evaluate("""(() => {
          const wrong = [], letter = player.stage.letter, all = (within, what) => [...within.querySelectorAll(what)];
          const numbers = (plot, axis) => all(plot, '.dygraph-axis-label-' + axis).filter((label) => label.textContent);
          const expect = (holds, what) => holds || wrong.push(what);
          const box = (element) => {
            const range = document.createRange();
            range.selectNodeContents(element);
            return range.getBoundingClientRect();
          };
          const height = (element) => (box(element).top + box(element).bottom) / 2;
          const controls = (when) => {
            for (const id of ['play', 'slider', 'speed']) {
              const element = document.getElementById(id), at = element.getBoundingClientRect();
              const seen = document.elementFromPoint((at.left + at.right) / 2, (at.top + at.bottom) / 2);
              expect(seen === element, `${id} is not in sight ${when}`);
            }
          };
          controls('at first');
          player.charts.forEach(({ chart, values, entries, graph, plot, canvas, roundOff }, i) => {
            const own = plot.parentElement, bottom = own.getBoundingClientRect().bottom, next = own.nextElementSibling;
            expect(plot.clientHeight >= 6.9 * letter, `chart ${i} is ${plot.clientHeight} high`);
            expect(all(own, '*').every((part) => part.getBoundingClientRect().bottom < bottom + 1), `chart ${i} is too small`);
            expect(!next || next.getBoundingClientRect().top >= bottom, `chart ${i} stands on the next`);
            expect(values.scrollHeight <= values.clientHeight + 1 && entries.length === chart.curves.length, `names ${i}`);
            const x = numbers(plot, 'x').map(box).sort((a, b) => a.left - b.left);
            const y = numbers(plot, 'y').map(height).sort((a, b) => a - b);
            expect(x.length > 1 && y.length > 1, `chart ${i} has ${x.length} and ${y.length} numbers`);
            expect(x.every(({ left }, k) => k === 0 || left > x[k - 1].right), `times of chart ${i}`);
            expect([...y, (x[0].top + x[0].bottom) / 2].every((at, k) => k === 0 || at - y[k - 1] > 0.7 * letter),
                   `numbers of chart ${i} are at ${y}`);
            const area = graph.getArea(), end = canvas.getBoundingClientRect().left + area.x + area.w;
            expect(roundOff.hidden === (chart.round_off === undefined), `round-off of chart ${i}`);
            expect(roundOff.hidden || box(roundOff).left >= end - 1, `curves ${i} go over the name of round-off`);
          });
          document.getElementById('charts').scrollTop = 1e6;
          document.getElementById('account').scrollIntoView({ block: 'end' });
          controls('at the last chart');
          const end = player.charts.at(-1).plot.getBoundingClientRect().bottom;
          const top = document.getElementById('controls').getBoundingClientRect().top;
          expect(end <= top + 1, 'the last chart is out of reach');
          expect(document.documentElement.scrollWidth <= innerWidth, 'the page is too wide');
          return wrong;
        })()""")
        check(not wrong, f"at {width} x {height}: {wrong[:5]}")
    chromium.resize(1366, 768)


def tests(program, page, folder, pictures):
    page.prefer(reduced_motion="reduce")
    pages(program, page, folder, pictures)
    all_scenes(program, page, folder, pictures)
    odd_data(program, page, folder)
    charts_have_room(program, page, folder)


sys.exit(browser.test(tests))
