"""Every notebook runs from its first cell to its last, and shows a figure: run_notebooks.py FOLDER."""
import pathlib
import re
import sys
import time

import nbclient
import nbformat


def cells_of(text):
    """The cells of the percent format."""
    for part in re.split(r"^# %%", text, flags=re.M)[1:]:
        kind, _, body = part.partition("\n")
        if "[markdown]" in kind:
            yield nbformat.v4.new_markdown_cell("\n".join(line.removeprefix("#").strip() for line in body.strip().split("\n")))
        else:
            yield nbformat.v4.new_code_cell(body.strip())


def outputs_of(notebook):
    return [output for cell in notebook.cells for output in cell.get("outputs", [])]


def problems_of(notebook):
    kinds = [kind for output in outputs_of(notebook) for kind in output.get("data", {})]
    if "image/png" not in kinds:
        yield "it shows no figure"
    for output in outputs_of(notebook):
        if output.get("name") == "stderr":
            yield "it warns: " + output["text"]


failed = False
files = sorted(pathlib.Path(sys.argv[1]).glob("*.py"))
for file in files:
    before = time.monotonic()
    notebook = nbformat.v4.new_notebook(cells=list(cells_of(file.read_text())))
    # In a terminal there is none of the figures that a notebook shows.
    notebook.cells.insert(0, nbformat.v4.new_code_cell("%matplotlib inline"))
    try:
        nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
        problems = list(problems_of(notebook))
    except nbclient.exceptions.CellExecutionError as error:
        problems = [str(error)]
    print(f"{time.monotonic() - before:6.1f} s {file.name}: {'; '.join(problems) or 'ok'}", flush=True)
    failed = failed or bool(problems)
sys.exit(failed or not files)
