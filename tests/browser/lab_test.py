"""The site in Chromium: the lab runs methods on a scene, keeps its state in the address, and asks the network for nothing.

Usage: lab_test.py SITE [FOLDER FOR SCREENSHOTS]
"""

import json
import os
import sys
import time
import urllib.parse

from site_checks import check, fits, quiet, test, until


def address(**state):
    return "#" + urllib.parse.quote(json.dumps(state))


DONE = "document.getElementById('status').textContent === 'Done.'"
TITLE = "document.getElementById('page').contentDocument.title"
CELLS = "[...document.querySelectorAll('#table td')].map(cell => cell.textContent)"


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
    until(page, "/scene.toml:\\d+:/.test(document.getElementById('flaw').textContent)", "a flaw is told")
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
