"""The program in WebAssembly says what the program says, text for text: in node, and a part of it in Chromium.

Usage: engine_test.py PROGRAM ENGINE
ENGINE is the folder of engine.js and engine.wasm. Times differ, and are left out. So do sines, exponentials and the
like in double, which are those of the C library: scenes with such effects agree to round-off, and one of them is
compared so.
"""

import json
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
TABLEAU = """A = [["1/4", "1/4-sqrt(3)/6"], ["1/4+sqrt(3)/6", "1/4"]]
b = ["1/2", "1/2"]
c = ["1/2-sqrt(3)/6", "1/2+sqrt(3)/6"]
order = 4
"""
SAME = """
run modified_pendulum --method hbvm:4,2 --step 1/16 --until 20 --json
run double_pendulum --method hbvm:4,4 --step 1/32 --until 10 --json
run double_pendulum --method hbvm:16,12 --step 1/8 --until 5 --states --json
run heavy_top --method hbvm:4,3 --step 1/32 --until 5 --json
run double_pendulum --method rattle --step 1/64 --until 5 --json
run kepler --method rk4 --step 1/64 --until 5 --error
run kepler --method bulirsch_stoer:12 --step 1/4 --until 5 --json
run closed_chain --method hbvm:6,4 --step 1/32 --until 1 --json
run charged_double_pendulum --until 5 --json
run charged_tetrahedron --method radau:3 --step 1/16 --until 2 --json
run damped_double_pendulum --step 1/32 --until 2 --json
run gyroscope_on_gimbal --step 1/32 --until 2 --json
run bead_on_torus --step 1/32 --until 2 --json
run double_pendulum --method hbvm:6,6 --step 1/16 --until 5 --precision 50 --json
run heavy_top --method hbvm:6,4 --step 1/32 --until 2 --precision 34 --json
run heavy_top --method hbvm:6,4 --step 1/32 --until 1 --precision 100 --json
run modified_pendulum --method hbvm:12,12 --step 1/8 --until 5 --precision 200 --json
run swinging_pendulum --method gauss:5 --step 1/16 --until 2 --precision 45 --json
run chain --method hbvm:24,24 --step 1/8 --until 1/4 --precision 60 --json
nodes 20 --precision 100
reference simple_pendulum --until 3 --digits 40
reference double_pendulum --until 2 --digits 30 --json
convergence simple_pendulum --methods rk4 hbvm:4,2 --steps 1/8:1/128 --until 2 --json
compare double_pendulum --methods rk4 hbvm:4,2 --step 1/16 --until 4 --reference --json
audit --method {tableau}
methods
scenes --json
scene check heavy_top
"""
REFUSED = """
run kepler --until 1 --step 1/3000000000000
run nothing --until 1
run kepler --method hbvm:2,3 --until 1
"""
TO_ROUND_OFF = "run toda_lattice --step 1/16 --until 2 --json"
TIMES = re.compile(r"cpu_seconds|elapsed|processor time|seconds\"|\"version\"|cost:")


def lines(text):
    return [line for line in text.splitlines() if not TIMES.search(line)]


def numbers(value):
    if isinstance(value, dict):
        return [x for part in value.values() for x in numbers(part)]
    if isinstance(value, list):
        return [x for part in value for x in numbers(part)]
    return [float(value)]


def main():
    program, engine = map(os.path.abspath, sys.argv[1:])
    browser = ["node", os.path.join(ROOT, "src/browser/run_engine.js"), engine]
    failures, compared = [], 0
    with tempfile.TemporaryDirectory() as folder:
        tableau = os.path.join(folder, "gauss.toml")
        with open(tableau, "w") as out:
            out.write(TABLEAU)

        def both(words):
            return [subprocess.run(command + words, capture_output=True, text=True, cwd=folder)
                    for command in ([program], browser)]

        carried_out = SAME.strip().splitlines()
        for line in carried_out + REFUSED.strip().splitlines():
            words = line.format(tableau=tableau).split()
            native, here = both(words)
            compared += 1
            codes = (0, 0) if line in carried_out else (2, 2)
            if (native.returncode, here.returncode) != codes:
                failures.append(f"{line}: exits {native.returncode}, {here.returncode}: {native.stderr or here.stderr[-300:]}")
                continue
            # A browser counts to fewer steps, and says so.
            for name, other in (("output", (native.stdout, here.stdout)),
                                ("errors", (native.stderr.replace("10^12", "10^9"), here.stderr))):
                if name == "errors" and native.returncode == 0:
                    continue
                different = [(a, b) for a, b in zip(*map(lines, other)) if a != b]
                if different or len(lines(other[0])) != len(lines(other[1])):
                    failures.append(f"{line}: {name}: {different[:2]}")
        native, here = (json.loads(of.stdout) for of in both(TO_ROUND_OFF.split()))
        worst = max(abs(a - b) for key in ("q", "p") for a, b in zip(numbers(native[key]), numbers(here[key])))
        if not worst < 2**-40:
            failures.append(f"{TO_ROUND_OFF}: differs by {worst}")
    print(f"{compared} commands compared, {len(failures)} differ")
    for failure in failures:
        print("  " + failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
