#!/usr/bin/env python3
"""Makes the site of static files: the engine, the lab, the front page.

Usage: make_site.py ENGINE OUTPUT
ENGINE is the folder with engine.js and engine.wasm, OUTPUT the folder of the site. Nothing is fetched.
Example: make_site.py build/web build/site
"""

import base64
import gzip
import json
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# Those that a list offers; others can be typed.
METHODS = ["hbvm:auto,3", "hbvm:4,2", "hbvm:6,3", "hbvm:3,3", "gauss:3", "radau:2", "rk4", "verlet", "euler",
           "symplectic_euler", "midpoint", "dopri5", "rattle"]


def engine_data(folder: pathlib.Path) -> str:
    """The engine's script and its module, packed, as one script: a page opened as a file may read no other kind."""
    module = gzip.compress((folder / "engine.wasm").read_bytes(), compresslevel=9, mtime=0)
    return ("const hbvmEngine = {script: " + json.dumps((folder / "engine.js").read_text()) + ",\n"
            "module: '" + base64.b64encode(module).decode() + "'};\n")


def scenes() -> str:
    texts = {path.stem: path.read_text() for folder in ("scenes", "test_set")
             for path in sorted((ROOT / "studies" / folder).glob("*.toml"))}
    return ("const hbvmScenes = " + json.dumps(texts, ensure_ascii=False) + ";\n"
            "const hbvmMethods = " + json.dumps(METHODS) + ";\n")


def main() -> int:
    if len(sys.argv) != 3 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if sys.argv[1:2] in (["-h"], ["--help"]) else 2
    engine, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    output.mkdir(parents=True, exist_ok=True)
    for path in sorted((HERE / "site").iterdir()):
        shutil.copy(path, output / path.name)
    (output / "engine_data.js").write_text(engine_data(engine))
    (output / "scenes.js").write_text(scenes())
    return 0


if __name__ == "__main__":
    sys.exit(main())
