"""The site in Chromium: the lab runs methods on a scene, moves its start, draws, and keeps its state in the address.
It asks the network for nothing.

Usage: lab_test.py SITE [FOLDER FOR SCREENSHOTS]
"""

import json
import os
import pathlib
import sys
import time
import urllib.parse

from site_checks import check, fits, quiet, test, until


def address(**state):
    return "#" + urllib.parse.quote(json.dumps(state))


DONE = "document.getElementById('status').textContent === 'Done.'"
TITLE = "document.getElementById('page').contentDocument.title"
CELLS = "[...document.querySelectorAll('#table td')].map(cell => cell.textContent)"


TEXT = "document.getElementById('text').value"
FLAW = "document.getElementById('flaw').textContent"
SETTLED = "settled.then(() => true)"
# The files that the page offers, instead of being saved.
OFFERED = """(() => {
  const make = URL.createObjectURL;
  window.offered = [];
  URL.createObjectURL = (blob) => {
    offered.push(blob);
    return make.call(URL, blob);
  };
  HTMLAnchorElement.prototype.click = () => {};
})()"""


def set_slider(page, path, value):
    """Moves a slider, as a hand does."""
    page.evaluate(f"""(() => {{
      const slider = document.querySelector('#sliders [data-path="{path}"]');
      slider.value = {value};
      slider.dispatchEvent(new Event('input'));
      slider.dispatchEvent(new Event('change', {{bubbles: true}}));
    }})()""")


def run_again(page, what):
    """Presses Run, and waits for what comes of it."""
    page.evaluate("""(() => {
      document.getElementById('status').textContent = '';
      document.getElementById('run').click();
    })()""")
    until(page, DONE, what)


def start(page):
    """Positions of the bodies at the start, as the lab has them from the program."""
    page.evaluate(SETTLED)
    return page.evaluate("start.masses.map((place) => start.position(place, 0).slice(0, 2))")


def rods_hold(page):
    """The rods of a double pendulum have their lengths, 1 and 1.3."""
    (ax, ay), (bx, by) = start(page)
    off = max(abs(ax**2 + ay**2 - 1), abs((ax - bx)**2 + (ay - by)**2 - 1.69))
    check(off < 1e-13, f"the rods of {start(page)} are off by {off}")


def middle(page, selector):
    """Where the middle of an element is in the window."""
    return page.evaluate(f"""(() => {{
      const {{x, y, width, height}} = document.querySelector('{selector}').getBoundingClientRect();
      return [x + width / 2, y + height / 2];
    }})()""")


def swipe(page, start, end):
    """A finger that goes from one point to another."""
    page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": start[0], "y": start[1]}])
    for part in (1 / 2, 1):
        x, y = (a + part * (b - a) for a, b in zip(start, end))
        page.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": x, "y": y}])
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])


def sketch(page, lab):
    """Bodies are moved by mouse, by keys and by sliders, and rods keep their lengths."""
    page.open(lab, address(scene="double_pendulum", methods=["hbvm:4,2"], step="1/16", until="1"))
    until(page, DONE, "a run beside the sketch")
    (ax, ay), _ = start(page)
    text = page.evaluate(TEXT)
    x, y = middle(page, ".sketch .body .reach")
    page.drag((x, y), (x - 40, y + 10))
    rods_hold(page)
    check(start(page)[0][0] < ax - 0.1, f"a body is dragged from {ax} to {start(page)[0][0]}")
    dragged = page.evaluate(TEXT)
    check(dragged != text and "# What it teaches" in dragged, f"a drag changes the text: {dragged}")
    page.evaluate("document.querySelector('.sketch .body').focus()")
    (_, before), _ = start(page)
    page.press("ArrowUp")
    page.press("ArrowUp", shift=True)
    rods_hold(page)
    check(start(page)[0][1] > before, "an arrow key moves a body")
    check(page.evaluate("document.activeElement.getAttribute('aria-label')").startswith("a at "), "a body keeps the focus")
    run_again(page, "a start that was moved")
    page.call("Emulation.setTouchEmulationEnabled", enabled=True)
    (ax, _), _ = start(page)
    x, y = middle(page, ".sketch .body .reach")
    swipe(page, (x, y), (x + 40, y + 20))
    page.call("Emulation.setTouchEmulationEnabled", enabled=False)
    check(start(page)[0][0] > ax + 0.1, f"a finger drags a body from {ax} to {start(page)[0][0]}")
    rods_hold(page)

    # What a slider sets stays; where that cannot be, the text stays.
    set_slider(page, "a.x", 0.4)
    check(start(page)[0][0] == 0.4, f"a slider sets a.x: {start(page)}")
    rods_hold(page)
    text = page.evaluate(TEXT)
    set_slider(page, "a.y", page.evaluate("document.querySelector('#sliders [data-path=\"a.y\"]').min"))
    page.evaluate(SETTLED)
    check("no consistent position" in page.evaluate(FLAW) and page.evaluate(TEXT) == text, page.evaluate(FLAW))

    # A start that was written and does not fit
    page.evaluate("""(() => {
      const text = document.getElementById('text');
      text.value = text.value.replace(/position = \\[0\\.4, /, 'position = [0.5, ');
      text.dispatchEvent(new Event('change', {bubbles: true}));
    })()""")
    page.evaluate(SETTLED)
    check("not consistent" in page.evaluate(FLAW), f"a start that does not fit is told: {page.evaluate(FLAW)}")
    page.evaluate("document.getElementById('project').click()")
    rods_hold(page)
    check(page.evaluate(FLAW) == "" and page.evaluate("document.getElementById('project').hidden"), "a start is moved to fit")
    quiet(page, "the sketch")
    page.open(lab, address(scene="heavy_top", methods=["hbvm:4,2"], step="1/16", until="1"))
    until(page, DONE, "a rigid body")
    page.evaluate(SETTLED)
    check(page.evaluate("document.getElementById('sketch').hidden"), "there is no sketch of a rigid body")


def figures(page, lab):
    """The phase portrait, digits against time of all runs so far, and what can be saved."""
    page.open(lab, address(scene="double_pendulum", methods=["rk4", "hbvm:6,3"], step="1/16", until="2", reference=True,
                           portrait="b.y"))
    until(page, DONE, "two methods")
    check(page.evaluate("document.getElementById('portrait').value") == "b.y", "an address has the phase portrait")
    lines = page.evaluate("[...document.querySelectorAll('#portrait-box polyline')]"
                          ".map(line => line.getAttribute('points'))")
    check([len(line.split()) for line in lines] == [33, 33] and "NaN" not in str(lines), f"the phase portrait has {lines}")
    points = "document.querySelectorAll('#work-precision circle').length"
    check(page.evaluate(points) == 2, "digits against time of two runs")
    page.evaluate("document.getElementById('step').value = '1/32'")
    run_again(page, "a smaller step")
    check(page.evaluate(points) == 4, f"digits against time of four runs: {page.evaluate(points)}")
    said = page.evaluate("document.querySelector('#work-precision svg').getAttribute('aria-label')")
    check("rk4, step 1/16, double: " in said and "hbvm:6,3, step 1/32, double: " in said, said)

    page.evaluate(OFFERED)
    page.evaluate("document.getElementById('save-picture').click()")
    check(page.evaluate("offered[0].type") == "image/svg+xml", "the charts are an SVG file")
    drawn = page.evaluate("""offered[0].text().then((text) => {
      const file = new DOMParser().parseFromString(text, 'image/svg+xml');
      return [file.documentElement.tagName, file.querySelectorAll('polyline[stroke^="rgb"]').length > 8];
    })""")
    check(drawn == ["svg", True], f"the SVG file has {drawn}")
    page.evaluate("""(() => {
      const inner = document.getElementById('page').contentDocument, speed = inner.getElementById('speed');
      speed.value = '8';
      speed.dispatchEvent(new Event('change'));
      document.getElementById('status').textContent = '';
      document.getElementById('save-film').click();
    })()""")
    until(page, DONE, "a video")
    film = page.evaluate("""new Promise((done) => {
      const blob = offered.find(({type}) => type.startsWith('video/')), video = document.createElement('video');
      video.onloadeddata = () => done([blob.type, video.videoWidth, video.videoHeight]);
      video.onerror = () => done([blob.type, video.error.message]);
      video.src = URL.createObjectURL(blob);
    })""")
    check(film[0] == "video/webm" and film[1:] > [100, 100], f"the video is {film}")
    page.evaluate("document.getElementById('until').value = '1'")
    run_again(page, "another final time")
    check(page.evaluate(points) == 2, "another final time begins anew")
    quiet(page, "the lab's charts")


def chain(rods):
    """A plane chain of rods that is let go from a straight line."""
    bodies = "".join(f'  {{ name = "{i}", mass = 1, position = ["{3 * i}/5", "-{4 * i}/5"], velocity = [0, 0] }},\n'
                     for i in range(1, rods + 1))
    links = "".join(f'  {{ kind = "rod", between = ["{i}", "{i + 1}"], length = 1 }},\n' for i in range(rods))
    return (f'title = "Chain of {rods} rods"\ndimension = 2\npoint = [{{ name = "0", position = [0, 0] }}]\n'
            f'body = [\n{bodies}]\nconstraint = [\n{links}]\n'
            'effect = [{ kind = "uniform_gravity", acceleration = [0, -1] }]\n')


def measured(page, site):
    """Prints how soon pages show their greatest part, and how often a moving chain is drawn; asserts neither."""
    lesson = min(pathlib.Path(site, "lessons").glob("[0-9]*.html")).name
    for name in ("index.html", "lab.html", f"lessons/{lesson}"):
        page.open(os.path.join(site, name))
        paint = page.evaluate("""Promise.race([
          new Promise((done) => new PerformanceObserver((list) => done(list.getEntries().at(-1).startTime))
            .observe({type: 'largest-contentful-paint', buffered: true})),
          new Promise((done) => setTimeout(done, 5000, NaN))])""")
        print(f"{name}: largest contentful paint after {paint} ms")
    page.open(os.path.join(site, "lab.html"),
              address(scene="chain", text=chain(20), methods=["hbvm:4,2"], step="1/32", until="10"))
    until(page, DONE, "a chain of twenty rods")
    until(page, TITLE + ".includes('20 rods')", "the chain's page")
    frames, states = page.evaluate("""new Promise((done) => {
      const inner = document.getElementById('page').contentWindow, find = (id) => inner.document.getElementById(id);
      find('repeat').checked = true;
      if (find('play').textContent === 'play') find('play').click();
      const begin = performance.now(), seen = new Set();
      let frames = 0;
      const count = () => {
        ++frames;
        seen.add(find('slider').value);
        const passed = (performance.now() - begin) / 1000;
        if (passed < 3) inner.requestAnimationFrame(count);
        else done([frames / passed, seen.size / passed]);
      };
      inner.requestAnimationFrame(count);
    })""")
    print(f"20 rods moving: {frames:.0f} frames a second, {states:.0f} states a second")


def tests(site, page, folder, pictures):
    lab = os.path.join(site, "lab.html")

    def picture(name):
        if pictures:
            time.sleep(1)
            page.screenshot(os.path.join(pictures, name + ".png"))

    # Two methods from an address, with the digits of each.
    page.open(lab, address(scene="double_pendulum", methods=["rk4", "hbvm:6,3"], step="1/16", until="4", reference=True))
    until(page, DONE, "two methods")
    cells = page.evaluate(CELLS)
    check(cells[0] == "rk4" and cells[6] == "hbvm:6,3", cells)
    check(float(cells[1]) > 1e-8 > 1e-13 > float(cells[7]), f"errors of H: {cells}")
    check(float(cells[10]) > float(cells[4]) + 2, f"right digits: {cells}")
    quiet(page, "the lab with two methods")
    until(page, TITLE + ".includes('Double pendulum')", "the inner page")
    fits(page, "lab", pictures)

    # A slider changes a mass, and the address restores it.
    page.evaluate("""(() => {
      const slider = document.querySelector('#sliders input');
      slider.value = 1;
      slider.dispatchEvent(new Event('input'));
      slider.dispatchEvent(new Event('change', {bubbles: true}));
    })()""")
    kept = page.evaluate("location.hash")
    command = page.evaluate("document.getElementById('command').textContent")
    check("--set a.mass=4" in command, command)
    page.open(lab, kept)
    until(page, DONE, "the state of an address")
    check(page.evaluate("document.querySelector('#sliders output').textContent") == "4", "a slider is restored")
    check(page.evaluate("document.getElementById('command').textContent") == command, "a command is restored")

    # An edited scene; one with a flaw is refused with its line.
    page.evaluate("""(() => {
      const text = document.getElementById('text');
      text.value = text.value.replace('mass = 2', 'mass = 2 kg');
      text.dispatchEvent(new Event('change', {bubbles: true}));
      document.getElementById('run').click();
    })()""")
    until(page, "/scene.toml:\\d+:/.test(document.getElementById('flaw').textContent) &&"
                " !document.getElementById('run').disabled", "a flaw is told")
    page.evaluate("""(() => {
      const text = document.getElementById('text');
      text.value = text.value.replace('mass = 2 kg', 'mass = 3').replace(/title = ".*"/, 'title = "Mine"');
      text.dispatchEvent(new Event('change', {bubbles: true}));
      document.getElementById('run').click();
    })()""")
    until(page, DONE, "an edited scene")
    until(page, TITLE + ".includes('Mine')", "the edited scene is shown")

    # One method alone, in fifty digits; then one that is stopped.
    page.open(lab, address(scene="simple_pendulum", methods=["hbvm:12,6"], step="1/8", until="2", precision="50",
                           reference=True))
    until(page, DONE, "one method in 50 digits")
    check(float(page.evaluate(CELLS)[1]) < 1e-45, f"H in 50 digits: {page.evaluate(CELLS)}")
    check(10 < float(page.evaluate(CELLS)[4]) < 50, f"right digits of one method: {page.evaluate(CELLS)}")
    page.evaluate("""(() => {
      document.getElementById('precision').value = '200';
      document.getElementById('until').value = '10000';
      document.getElementById('run').click();
    })()""")
    until(page, "document.getElementById('bar').value > 0 && document.getElementById('bar').max === 1 &&"
                " / of /.test(document.getElementById('status').textContent)", "progress is shown")
    page.evaluate("document.getElementById('stop').click()")
    until(page, "!document.getElementById('run').disabled", "a run is stopped", 5)

    code = page.evaluate("""(() => {
      const early = new Engine(), ended = early.run(['--version']);
      early.stop();
      return ended.then(({code}) => code);
    })()""")
    check(code == 130, f"a command that is stopped before it begins: {code}")

    # Any command.
    page.evaluate("""(() => {
      document.getElementById('words').value = 'hbvm nodes 2 --precision 30';
      document.getElementById('execute').click();
    })()""")
    until(page, "document.getElementById('output').textContent.includes('0.21132486540518711774542560974')",
          "the nodes of Gauss and Legendre")
    quiet(page, "the lab")

    sketch(page, lab)
    figures(page, lab)
    measured(page, site)

    # The front page computes its table; dark, too.
    page.prefer(color_scheme="dark")
    page.open(os.path.join(site, "index.html"))
    until(page, "document.querySelectorAll('#digits td').length === 16 &&"
                " !document.getElementById('digits').textContent.includes('…')", "the front page's table")
    digits = page.evaluate("[...document.querySelectorAll('#digits tbody tr')].map(row => Number(row.cells[3].textContent))")
    check(digits == sorted(digits) and digits[-1] > 40, f"right digits on the front page: {digits}")
    picture("front_dark")
    quiet(page, "the front page")


if __name__ == "__main__":
    sys.exit(test(tests))
