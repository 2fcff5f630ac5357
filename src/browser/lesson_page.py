"""The page of a lesson, and the list of all; site/lesson.js makes the forms work."""

import json

from lesson import Lesson
from markdown_text import html_of
from site_page import SitePage, escaped, relative

SCRIPTS = ("numbers.js", "engine.js", "runs.js", "command.js", "lab_state.js", "chart.js", "lesson.js",
           "engine_data.js")
# What tells of a command that runs: site/command.js.
PROGRESS = ('<progress class="bar live" max="1" aria-label="Progress" hidden></progress>'
            '<p class="status" role="status" aria-live="polite"></p>')


def lesson_page(lesson: Lesson, before: Lesson | None, after: Lesson | None) -> SitePage:
    """A lesson, which leads to those before and after it."""
    name = f"lesson {int(lesson.number)}"
    data = {"name": lesson.name, "files": json.dumps(lesson.files)}
    attributes = " ".join(f'data-{key}="{escaped(value)}"' for key, value in data.items())
    # The division that the question opens ends with the page.
    main = f'<article id="lesson" {attributes}>\n{_text(lesson)}\n{_ways(lesson, before, after)}</div>\n</article>'
    return SitePage(lesson.address, f"{lesson.title}: {name} of hbvm", lesson.summary, main, heading=lesson.title,
                    lead=_lead(lesson, name.capitalize()), kind="text prose", scripts=SCRIPTS)


def list_page(lessons: list[Lesson]) -> SitePage:
    """All lessons, one an entry."""
    path = "lessons/index.html"
    entries = "\n".join(f'<li><a href="{relative(lesson.address, path)}">{escaped(lesson.title)}</a> '
                        f'<span class="quiet">{lesson.minutes} minutes</span><br>{escaped(lesson.summary)}</li>'
                        for lesson in lessons)
    return SitePage(
        path, "Lessons on the integration of mechanics",
        "Lessons on order, energy, symmetry, chaos and round-off, with experiments and exercises that the page runs and "
        "judges.", f'<ol class="lessons">\n{entries}\n</ol>', heading="Lessons",
        lead="<p>Each begins with a question. Its experiments run in the page, and the program judges what you find. "
             "First-year calculus and mechanics are enough.</p>")


def _lead(lesson: Lesson, name: str) -> str:
    files = ", ".join(f'<a href="{relative(lesson.file_address(file), lesson.address)}" download>{escaped(file)}</a>'
                      for file in lesson.files)
    reads = f"Its commands read {files}. " if files else ""
    return (f'<p class="quiet">{name}, {lesson.minutes} minutes in class. {reads}'
            '<button type="button" id="worksheet" class="live">Print the worksheet</button></p>')


def _text(lesson: Lesson) -> str:
    """The text with its forms; what follows the question waits in a division for the answer."""
    numbers = {name: number for number, name in enumerate(lesson.exercises, 1)}
    forms = {"text": html_of,
             "question": lambda _: _question(lesson.question) + '\n<div class="after">',
             "experiment": lambda name: _experiment(lesson.experiments[name]),
             "exercise": lambda name: _exercise(lesson.exercises[name], numbers[name])}
    return "\n".join(forms[kind](content) for kind, content in lesson.parts())


def _ways(lesson: Lesson, before: Lesson | None, after: Lesson | None) -> str:
    ways = "".join(f'<a rel="{rel}" href="{relative(other.address, lesson.address)}">{word}: {escaped(other.title)}</a>'
                   for rel, word, other in (("prev", "Before", before), ("next", "Next", after)) if other)
    return f'<nav class="ways" aria-label="Lessons">{ways}</nav>'


def _question(question: dict) -> str:
    (name, blank), = question["blanks"].items()
    if "choices" in blank:
        fields = "".join(f'<label><input type="radio" name="{name}" value="{escaped(choice)}" required> '
                         f"{escaped(choice)}</label>\n" for choice in blank["choices"])
    else:
        fields = f'<label>{escaped(blank["asks"])} <input name="{name}" required></label>'
    return f"""<form class="question" aria-label="Question">
{html_of(question["asks"])}
<fieldset><legend>{escaped(blank["asks"])}</legend>
{fields}</fieldset>
<button class="live">Answer</button>
<div class="says after" tabindex="-1"><p class="given live"></p>{html_of(question["says"])}</div>
</form>"""


def _select(name: str, label: str, choices: list[str], first: str = "") -> str:
    options = "".join(f"<option>{escaped(choice)}</option>" for choice in choices)
    return f'<label>{escaped(label)} <select name="{name}" required>{first}{options}</select></label>'


def _experiment(experiment: dict) -> str:
    choices = experiment.get("choices", {})
    data = {key: experiment[key] for key in ("command", "draw")}
    command = experiment["command"]
    for name, values in choices.items():
        command = command.replace(f"{{{name}}}", values[0])
    fields = " ".join(_select(name, name.replace("_", " "), values) for name, values in choices.items())
    return f"""<form class="experiment" aria-label="Experiment {experiment["name"].replace("_", " ")}"
 data-experiment="{escaped(json.dumps(data))}">
<div class="asks">{html_of(experiment["asks"])}</div>
<p class="live">{fields} <button class="run">Run</button> <button type="button" class="stop" disabled>Stop</button></p>
{PROGRESS}
<div class="result"></div>
<pre tabindex="0"><code class="command">{escaped(command)}</code></pre>
<p class="live"><button type="button" class="copy">Copy</button> <a class="to-lab" hidden>Open in the lab</a></p>
</form>"""


def _exercise(exercise: dict, number: int) -> str:
    fields = []
    for name, blank in exercise["blanks"].items():
        if "choices" in blank:
            fields.append(_select(name, blank["asks"], blank["choices"], '<option value="">choose</option>')
                          + f'<span class="on-paper">{escaped(" / ".join(blank["choices"]))}</span>')
        else:
            like = f' placeholder="such as {escaped(blank["like"])}"' if "like" in blank else ''
            fields.append(f'<label>{escaped(blank["asks"])} <input name="{name}"{like} autocomplete="off" '
                          'autocapitalize="off" spellcheck="false" required></label>')
    return f"""<form class="exercise" data-name="{exercise["name"]}" aria-labelledby="{exercise["name"]}">
<h3 id="{exercise["name"]}">Exercise {number}</h3>
{html_of(exercise["asks"])}
<p class="fields">{" ".join(fields)}</p>
<p class="live"><button class="run">Check</button> <button type="button" class="stop" disabled>Stop</button></p>
{PROGRESS}
<p class="verdict" role="status" aria-live="polite"></p>
<div class="lines" aria-hidden="true"><hr><hr><hr></div>
</form>"""
