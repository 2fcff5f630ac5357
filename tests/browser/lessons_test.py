"""The lessons in Chromium: questions, experiments and exercises of each; and the links and widths of all pages.

Usage: lessons_test.py SITE [FOLDER FOR SCREENSHOTS]
"""

import html.parser
import json
import os
import pathlib
import sys
import tomllib
import urllib.parse

from site_checks import check, fits, quiet, test, until

LESSONS = pathlib.Path(__file__).resolve().parents[2] / "studies" / "lessons"
# Of a page whose scripts run: fills the fields of a form by their names, and submits it.
FILL = """((selector, values) => {
  const form = document.querySelector(selector);
  for (const [name, value] of Object.entries(values))
    for (const field of form.querySelectorAll(`[name="${name}"]`)) {
      if (field.type === 'radio') field.checked = field.value === value;
      else field.value = value;
      field.dispatchEvent(new Event('input', {bubbles: true}));
      field.dispatchEvent(new Event('change', {bubbles: true}));
    }
  if (!form.checkValidity()) throw new Error(`${selector} cannot hold ${JSON.stringify(values)}`);
  form.requestSubmit();
})"""
SAID = "document.querySelector({form}).querySelector('{part}').textContent"


class Links(html.parser.HTMLParser):
    """The links and the anchors of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors, self.facts = [], set(), {"title": 0, "description": 0, "h1": 0}
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.links += [attributes[key] for key in ("href", "src") if attributes.get(key)]
        if "id" in attributes:
            self.anchors.add(attributes["id"])
        if tag in self.facts:
            self.facts[tag] += 1
        if attributes.get("name") == "description" and len(attributes["content"]) > 20:
            self.facts["description"] += 1


def links_lead_somewhere(site):
    """Every link of every page leads to a file that is there, and to a place in it; each page says what it is."""
    pages = {path: Links(path.read_text()) for path in site.rglob("*.html")}
    for path, page in pages.items():
        check(set(page.facts.values()) == {1}, f"{path.relative_to(site)} has {page.facts}")
        for link in page.links:
            if urllib.parse.urlsplit(link).scheme in ("https", "http", "data"):
                continue
            name, _, anchor = link.partition("#")
            target = path if not name else (path.parent / urllib.parse.unquote(name)).resolve()
            check(target.is_file(), f"{path.relative_to(site)}: the link {link} leads nowhere")
            if target in pages and target.name != "lab.html" and anchor:
                check(anchor in pages[target].anchors, f"{path.relative_to(site)}: {link} leads to no place")
    print(f"{len(pages)} pages, whose links lead somewhere")


def fill(page, form, values):
    """Fills a form, named by a selector, and submits it."""
    page.evaluate(f"{FILL}({json.dumps(form)}, {json.dumps(values)})")


def rested(page, form):
    """Waits until nothing runs in a form."""
    until(page, f"!document.querySelector({json.dumps(form)}).querySelector('.run').disabled", form)


def said(form, part):
    """What a part of a form says, as an expression."""
    return SAID.format(form=json.dumps(form), part=part)


def question(page, lesson):
    """The text waits for an answer, which a page that is opened again remembers."""
    hidden = "getComputedStyle(document.querySelector('article > .after')).display === 'none'"
    check(page.evaluate(hidden), "the text after the question waits for an answer")
    fill(page, ".question", lesson["question"]["solution"])
    check(not page.evaluate(hidden), "the text goes on after the answer")
    (answer,) = lesson["question"]["solution"].values()
    check(answer in page.evaluate(said(".question", ".given")), "the page says what was answered")


def experiments(page, lesson):
    """Each of them runs, with every value of every choice."""
    for experiment in lesson.get("experiment", []):
        form = f'[aria-label="Experiment {experiment["name"].replace("_", " ")}"]'
        choices = experiment.get("choices", {})
        for place in range(max(map(len, choices.values()), default=1)):
            # The first experiment runs by itself, and may do so still.
            rested(page, form)
            chosen = {name: values[min(place, len(values) - 1)] for name, values in choices.items()}
            fill(page, form, chosen)
            rested(page, form)
            status = page.evaluate(said(form, ".status"))
            check(status == "Done.", f"the experiment {experiment['name']} with {chosen}: {status}")
            shown = {"page": "iframe", "chart": ".chart .curve", "text": "pre"}[experiment["draw"]]
            check(page.evaluate(f"document.querySelector({json.dumps(form)}).querySelector('.result {shown}') !== null"),
                  f"the experiment {experiment['name']} shows no {shown}")


def exercises(page, lesson):
    """Each of them refuses a wrong answer, and accepts a right one."""
    for exercise in lesson["exercise"]:
        form = f'[data-name="{exercise["name"]}"]'
        for answer, verdict in (("wrong", "Not yet: "), ("solution", "Right.")):
            fill(page, form, exercise[answer])
            rested(page, form)
            says = page.evaluate(said(form, ".verdict"))
            check(says.startswith(verdict), f"the {answer} answer of {exercise['name']}: {says}")


def worksheet(page, what):
    """What is printed as a worksheet: the text as far as the question, and the exercises, but nothing to press."""
    page.evaluate("document.body.classList.add('worksheet')")
    page.call("Emulation.setEmulatedMedia", media="print")
    shown = page.evaluate("""[...document.querySelectorAll('.question, .says, .after > *')]
      .filter((part) => part.offsetHeight).map((part) => part.className)""")
    check(shown == ["question", "exercise", "exercise"], f"the worksheet of {what} has {shown}")
    check(page.evaluate("[...document.querySelectorAll('button, nav, iframe')].every((part) => !part.offsetHeight)"),
          f"the worksheet of {what} has buttons")
    page.call("Emulation.setEmulatedMedia", media="")
    page.evaluate("document.body.classList.remove('worksheet')")


def tests(site, page, folder, pictures):
    site = pathlib.Path(site).resolve()
    links_lead_somewhere(site)
    for path in sorted(LESSONS.glob("*/lesson.toml")):
        lesson, name = tomllib.loads(path.read_text()), path.parent.name
        address = site / "lessons" / f"{name}.html"
        page.open(address)
        question(page, lesson)
        experiments(page, lesson)
        exercises(page, lesson)
        fits(page, name, pictures)
        worksheet(page, name)
        quiet(page, name)
        page.open(address)
        check(page.evaluate("document.querySelector('main.answered') !== null"), "an answer is remembered")
        page.evaluate("sessionStorage.clear()")
        print(f"{name} runs")
    for path in sorted(site.rglob("*.html")):
        what = path.relative_to(site).as_posix()
        page.open(path)
        fits(page, what)
        quiet(page, what)


if __name__ == "__main__":
    sys.exit(test(tests))
