"""What the test of the pages' commands has to know of them, by the command as it is printed."""

# What a sentence says of an option, and no command.
MENTIONS = {
    "hbvm run --json",
    "hbvm run --error",
    "hbvm run --out",
    "hbvm run --start",
    "hbvm run --horizon",
    "hbvm audit --full",
    "hbvm audit --command",
    "hbvm reference --event",
}

# What other tests run, or what takes a machine for itself: why it is not run here.
BUILDS = "builds the program, as whoever runs the tests has done"
ELSEWHERE = {
    "studies/run": BUILDS + "; its studies are run below, one by one",
    "studies/run --build": BUILDS,
    "studies/run --docs": "the test docs.pages",
    "studies/run --site": "tests/run --web does this: half an hour",
    "tests/run --web": "compiles the program for the browser: half an hour",
    "src/browser/build": "tests/run --web does this: half an hour",
    "node src/browser/run_engine.js build/web run kepler --until 10": "tests/run --web compares many such runs",
    "hbvm lesson check 6 answers.toml": "a reader's answers; the tests cli.LessonCommand have such files",
    "tests/run": "runs this test",
    "tests/run --coverage": "builds all with counters: ten minutes",
    "tests/run -R solver": "builds the program, and runs a part of these tests",
    "tests/run --full": "builds all in other ways: hours",
    "tests/run --dev solver --gtest_filter='StoppingRule.*'": "builds the library in another way: minutes",
    "tests/run --turn": "builds all in other ways: half an hour",
    "tests/mutants/run": "builds the program for each of its changes: an hour",
    "tests/baseline/run build/release/hbvm > before.txt": "compares two programs: minutes",
    "tests/baseline/run build/release/hbvm --against before.txt": "compares two programs: minutes",
    "xdg-open motion.html": "opens a browser",
    "python3 -m venv --system-site-packages env": "the test python.wheel",
    "env/bin/pip install src/python": "the test python.wheel",
    "env/bin/python studies/notebooks/first_steps.py": "the test python.notebooks",
    "studies/speed/run": "builds; measures for minutes what no other work may disturb",
    "studies/speed/before": "builds an older commit",
    "studies/reference/run": "makes all references of the store: many minutes",
    "studies/reference/run --verify": "computes all references of the store: many minutes",
    "studies/reference/run --prove": "proves all references of the store: many minutes",
    "studies/reference/run --costs": "measures for many minutes",
    "studies/proof/run": "builds the program, and measures for a minute",
    "studies/stability/run": "all hard cases: an hour",
    "studies/what_accuracy_costs/run": "measures for half an hour",
    "studies/what_accuracy_costs/compare": "compares two measurements of half an hour",
    "studies/cluster/run --shards 7 --full": "the test cluster.example does this with fewer claims",
    "hbvm audit --full --merge shard_*/findings.jsonl --out merged": "the test cluster.example",
    "studies/any_smooth_constraint/run": "all claims about five scenes: many minutes",
    "build/release/hbvm stability": "the test stability.quick runs these cases",
    "build/release/hbvm audit --quick": "a test of the command runs it",
    "hbvm audit --quick": "likewise",
    "python3 -c 'import json, jsonschema; jsonschema.validate(json.load(open(\"end.json\")), "
    "json.load(open(\"studies/run.schema.json\")))'": "the test files.schema, where there is the module",
}

# What takes long, why, and what shows in less time that it is right.
GRID = "a grid of hundreds of runs: minutes"
SHORTER = {
    "build/release/hbvm cost double_pendulum --digits-range 2:30 --out cost && build/release/hbvm report cost": (
        "hbvm cost double_pendulum --digits-range 2:4 --seconds 0.01 --precisions double --methods hbvm:4,4 rattle "
        "--out cost && build/release/hbvm report cost",
        GRID,
    ),
    "hbvm cost double_pendulum --digits-range 2:30 --out cost": (
        "hbvm cost double_pendulum --digits-range 2:4 --seconds 0.01 --precisions double --methods hbvm:4,4",
        GRID,
    ),
    "hbvm cost double_pendulum --digits-range 2:30 --out cost && hbvm report cost": (
        "hbvm cost double_pendulum --digits-range 2:4 --seconds 0.01 --precisions double --methods hbvm:4,4 "
        "--out cost && hbvm report cost",
        GRID,
    ),
    "hbvm cost tethered_satellites --until 2 --digits-range 2:100 --seconds 0.4 --precisions double quad mpfr:35 "
    "mpfr:57 mpfr:107 --out cost": (
        "hbvm cost tethered_satellites --until 1 --digits-range 2:4 --seconds 0.01 --precisions double quad mpfr:35 "
        "--methods hbvm:4,4 --out cost",
        GRID,
    ),
    "hbvm cost tethered_satellites": (
        "hbvm cost tethered_satellites --until 1 --digits-range 2:4 --seconds 0.01 --precisions double --methods "
        "hbvm:4,4",
        GRID,
    ),
    "hbvm cost simple_pendulum --until 10 --digits-range 5:500 --seconds 5 --methods taylor hbvm:16,16 hbvm:32,32 "
    "hbvm:64,64 hbvm:128,128 hbvm:192,192 --precisions double mpfr:55 mpfr:120 mpfr:250 mpfr:510": (
        "hbvm cost simple_pendulum --until 1 --digits-range 5:50 --seconds 0.05 --methods taylor hbvm:16,16 "
        "--precisions double mpfr:55",
        "a grid to 500 digits: a quarter of an hour",
    ),
    "hbvm audit --full --out results": ("hbvm audit --full --out results --shard 1/400", "all claims: many minutes"),
    "hbvm stability --full --out results": (
        "hbvm stability --full --out results --shard 1/100",
        "all hard cases: an hour",
    ),
    "hbvm audit --claims superconvergence --quick": (
        "hbvm audit --claims superconvergence --quick --shard 1/5 --out shard",
        "a quarter of a minute of two cores; a test of the command runs all quick claims",
    ),
}

# Exit codes that the page says, if they are not 0.
CODES = {
    "hbvm audit --quick --method studies/orders_beyond_round_off/gauss_with_a_wrong_digit.toml": 1,
    "build/release/hbvm audit --method studies/orders_beyond_round_off/gauss_with_a_wrong_digit.toml": 1,
    "hbvm audit --method studies/orders_beyond_round_off/gauss_with_a_wrong_digit.toml": 1,
    "hbvm audit --claims studies/orders_beyond_round_off/claims.toml": 1,
    "hbvm audit studies/orders_beyond_round_off/gauss_with_a_wrong_digit.toml": 1,
    "hbvm audit --method misprint.toml": 1,
    "hbvm audit --method gauss_7.toml": 1,
    "hbvm audit --method gauss_25.toml": 1,
    "hbvm run simple_pendulum --method rk4+baumgarte:40,40 --step 1/16 --until 40": 3,
}

# What a reader of a page has: a file that it shows, in the block of text that follows these words, or a copy of one.
FILES = {
    "--help": {"mine.toml": "studies/scenes/double_pendulum.toml"},
    "studies/reference/README.md": {"mine.csv": "e.g. `mine.csv`"},
    "studies/README.md": {"rk4.toml": "e.g. `rk4.toml`"},
}
