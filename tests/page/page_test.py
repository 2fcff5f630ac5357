#!/usr/bin/env python3
"""The pages that `hbvm run --plot FILE.html` writes, in headless Chromium: page_test.py PROGRAM [FOLDER FOR SCREENSHOTS]

They draw without a complaint and without the network, the scene moves, and what they show are the numbers of the run's CSV
file. Ends with 77, by which CTest knows a test that was skipped, where there is no Chromium.
"""

import csv
import math
import os
import subprocess
import sys
import tempfile
import time

import browser

RUNS = {
    "double_pendulum": ["--method", "hbvm:3,3", "--step", "1/16", "--until", "10"],
    "tethered_satellites": ["--method", "hbvm:5,3", "--step", "0.1", "--until", "40"],
    "double_physical_pendulum": ["--method", "hbvm:3,3", "--step", "1/32", "--until", "8"],
    "gyroscope_on_gimbal": ["--method", "hbvm:3,3", "--step", "1/32", "--until", "8"],
    "kepler": ["--method", "hbvm:4,2", "--step", "1/16", "--until", "10", "--reverse"],
    "chain": ["--method", "hbvm:1,1", "--step", "1/256", "--until", "20"],
    "quartic_oscillator": ["--method", "hbvm:4,2", "--step", "1", "--until", "1"],
}


class Failure(Exception):
    pass


def check(holds, what):
    if not holds:
        raise Failure(what)


def read_csv(path):
    """Rows of numbers, t first and then q; lines that are no numbers are names."""
    rows = []
    with open(path, newline="") as file:
        for row in csv.reader(file):
            try:
                rows.append([float(x) for x in row])
            except ValueError:
                continue
    return rows


def run(program, scene, folder):
    page, table = os.path.join(folder, scene + ".html"), os.path.join(folder, scene + ".csv")
    subprocess.run([program, "run", scene, *RUNS[scene], "--plot", page, "--out", table], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    check(os.path.getsize(page) < 1_000_000, f"{os.path.getsize(page)} bytes are too many")
    return page, read_csv(table)


def positions_are_those_of(chromium, rows):
    """Of every place that is a body, which one block of coordinates moves; and of all places at two times."""
    count = chromium.evaluate("player.motion.count")
    every = chromium.evaluate("player.motion.every")
    places = chromium.evaluate("player.motion.places")
    dimension = chromium.evaluate("player.motion.dimension")
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
    until = time.monotonic() + 20
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


def cursor_values_are_those_of(chromium, rows):
    """Of the hidden constraints, the last column of the CSV file, of a run of which every state is shown."""
    if chromium.evaluate("player.motion.every") != 1:
        return
    entries = "player.charts[player.charts.length - 1].entries"
    if chromium.evaluate(entries + ".length") != 3:
        return
    for index in (1, chromium.evaluate("player.last") // 2):
        chromium.evaluate(f"player.choose({index})")
        shown = chromium.evaluate(entries + "[2].value.textContent")
        expected = rows[index][-1]
        check(expected == 0 and shown == "0" or math.isclose(number(shown), expected, rel_tol=6e-3),
              f"the hidden constraint is shown as {shown} instead of {expected}")


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


def pages(program, chromium, folder, pictures):
    for scene in RUNS:
        path, rows = run(program, scene, folder)
        chromium.open(path)
        check(not chromium.complaints, f"{scene}: {chromium.complaints}")
        check(all(url.startswith(("file:", "data:", "about:")) for url in chromium.requests),
              f"{scene} asks for {chromium.requests}")
        check(not chromium.evaluate("player.playing"), f"{scene} plays though motion is not wanted")
        for part in (lambda: positions_are_those_of(chromium, rows), lambda: it_moves(chromium),
                     lambda: cursor_values_are_those_of(chromium, rows), lambda: curves_go_to_a_time(chromium)):
            try:
                part()
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


def main():
    program = sys.argv[1]
    chromium = browser.find()
    if not chromium:
        print("skipped: there is no Chromium (Debian's package chromium)")
        return 77
    pictures = sys.argv[2] if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as folder, browser.Browser(chromium) as page:
        page.prefer(reduced_motion="reduce")
        try:
            pages(program, page, folder, pictures)
        except Failure as failure:
            print(f"failed: {failure}")
            return 1
    return 0


sys.exit(main())
