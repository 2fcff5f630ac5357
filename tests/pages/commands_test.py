"""Every command of every page, and of the examples that --help prints, runs as it is printed.

Usage: commands_test.py HBVM SOURCE_FOLDER [WORD]
Prints the time of each command; with WORD, only commands are run that hold it, or whose page does.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import time
import tomllib

sys.dont_write_bytecode = True  # nothing is left in the sources
from declared import FILES, CODES, ELSEWHERE, MENTIONS, SHORTER

program, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
word = sys.argv[3] if len(sys.argv) > 3 else ""
problems = []
done_before = set()  # commands of pages before

PROGRAMS = r"(?:build/release/)?hbvm|(?:studies|tests)/(?:\w+/)*(?:run|before|compare)|src/browser/build"
COMMAND = re.compile(rf"(?:{PROGRAMS})(?:\s|$)")
# What starts a block of commands: one of the programs, or a shell's word.
BLOCK = re.compile(rf"(?:(?:{PROGRAMS})(?:\s|$)|(?:cp|for|node|python3|g\+\+)\s)")
# "hbvm report FOLDER", "hbvm:K,S": a reader is to put something there.
FORM = re.compile(r"(?:^|[\s/:,'\"])[A-Z]+(?:$|[\s/:,.'\"])|\.\.\.")

# "hbvm audit" in a sentence is the name of a command.
NAME = re.compile(r"hbvm(?: [a-z]+){0,2}")


def whole_commands(lines):
    """Lines put together until the shell takes them."""
    command = ""
    for line in lines:
        command += ("\n" if command else "") + line
        if subprocess.run(["bash", "-n", "-c", command], stderr=subprocess.DEVNULL).returncode == 0:
            yield command
            command = ""
    if command:
        yield command


def without_comment(command):
    return "\n".join(re.sub(r"\s+# .*$", "", line) for line in command.split("\n"))


def commands_of(text):
    """The commands of a page in their order: those of indented blocks, and those that stand in its sentences."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M)
    for paragraph in re.split(r"\n\s*\n", text):
        lines = paragraph.strip("\n").split("\n")
        if all(line.startswith("    ") for line in lines):
            lines = textwrap.dedent("\n".join(lines)).split("\n")
            if BLOCK.match(lines[0]):
                yield from (without_comment(command) for command in whole_commands(lines))
            continue
        for span in re.findall(r"`([^`]+)`", paragraph):
            span = " ".join(span.split())
            if COMMAND.match(span) and not FORM.search(span) and not NAME.fullmatch(span):
                yield span


def examples_of_help():
    """Of each command, those that its help ends with."""
    def help_of(*path):
        return subprocess.run([program, *path, "--help"], capture_output=True, text=True, check=True).stdout

    paths = [()] + [(name,) for name in re.findall(r"^  ([a-z]+) ", help_of().split("Subcommands:")[-1], flags=re.M)]
    paths += [("scene", name) for name in re.findall(r"^  ([a-z]+) ", help_of("scene").split("Subcommands:")[-1], flags=re.M)]
    paths += [("lesson", name) for name in re.findall(r"^  ([a-z]+) ", help_of("lesson").split("Subcommands:")[-1], flags=re.M)]
    for path in paths:
        text = help_of(*path)
        if "Example: " not in text:
            problems.append(f"hbvm {' '.join(path)} --help has no example")
            continue
        for line in text.split("Example: ", 1)[1].strip().split("\n"):
            yield line.strip()


def lesson_of(page):
    """What lesson.toml beside a page says; nothing if there is none."""
    table = page.parent / "lesson.toml"
    return tomllib.loads(table.read_text()) if table.exists() else {}


def experiments_of(page):
    """The commands of a lesson's experiments, with the first of their choices."""
    for experiment in lesson_of(page).get("experiment", []):
        command = experiment["command"]
        for name, choices in experiment.get("choices", {}).items():
            command = command.replace(f"{{{name}}}", choices[0])
        yield command


def run(page, command, folder, environment):
    shown = f"{page}: {command}"
    once = command.replace("build/release/hbvm", "hbvm")
    if command in MENTIONS or word not in shown or once in done_before:
        return
    done_before.add(once)
    if command in ELSEWHERE:
        print(f"        - {shown}  ({ELSEWHERE[command]})")
        return
    used = SHORTER[command][0] if command in SHORTER else command
    before = time.monotonic()
    try:
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", used], cwd=folder, env=environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=280)
        code, output = done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        code, output = "none, as it took more than 280 s", ""
    print(f"{time.monotonic() - before:7.1f} s {shown}" + (f"  (as {used})" if used != command else ""), flush=True)
    expected = CODES.get(command, 0)
    if code != expected:
        problems.append(f"{shown}\n  exit code {code} and not {expected}: {output[-600:]}")


def run_page(page, commands, text=""):
    """In a folder like a checkout, where what one command writes the next may read."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copytree(source / "studies", folder / "studies", ignore=shutil.ignore_patterns("results"))
        (folder / "build/release").mkdir(parents=True)
        (folder / "build/release/hbvm").symlink_to(program)
        for file, text_of_lesson in lesson_of(source / page).get("files", {}).items():
            (folder / file).write_text(text_of_lesson)
        for file, origin in FILES.get(page, {}).items():
            if (source / origin).exists():
                shutil.copy(source / origin, folder / file)
                continue
            block = re.search(r"^```\w+\n(.*?)^```$", text[text.index(origin):], flags=re.S | re.M)
            (folder / file).write_text(block.group(1))
        # python3 is Debian's, which has the modules of Debian's packages.
        environment = dict(os.environ, PATH=f"{folder}/build/release:/usr/bin:{os.environ['PATH']}")
        for command in commands:
            run(page, command, folder, environment)


found = []
pages = [source / "README.md", source / "src/README.md", source / "src/browser/README.md",
         *(page for pattern in ("*.md", "*/*.md", "lessons/*/*.md") for page in sorted((source / "studies").glob(pattern)))]
for page in pages:
    text = page.read_text()
    commands = [*commands_of(text), *experiments_of(page)]
    found += commands
    run_page(str(page.relative_to(source)), commands, text)
examples = list(examples_of_help())
found += examples
run_page("--help", examples)

# What is declared stands on a page.
for declared in [*MENTIONS, *ELSEWHERE, *SHORTER, *CODES]:
    if declared not in found:
        problems.append(f"declared, and on no page: {declared}")
print(f"{len(found)} commands")
for problem in problems:
    print("FAILED", problem)
sys.exit(1 if problems else 0)
