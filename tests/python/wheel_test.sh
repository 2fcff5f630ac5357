#!/usr/bin/env bash
# What the page says: pip installs the module into a new environment, and it runs there: wheel_test.sh PYTHON SOURCE BUILD.
set -euo pipefail
"$1" -c 'import venv, ensurepip, numpy, mpmath' 2>/dev/null || { echo "skipped: $1 lacks venv, numpy or mpmath"; exit 77; }
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
unset PYTHONPATH
"$1" -m venv --system-site-packages "$folder/env"
"$folder/env/bin/pip" install --no-index --quiet --config-settings build="$3" "$2/src/python"
cd "$folder"
env/bin/python - <<'PYTHON'
import hbvm, importlib.metadata
assert hbvm.__file__.startswith(__import__("sys").prefix), hbvm.__file__
assert hbvm.__version__.split("+")[0] == importlib.metadata.version("hbvm")
assert len(hbvm.run("kepler", step="1/8", until=1, precision=50).q["planet.x"].text) > 50
PYTHON
env/bin/pip uninstall --yes --quiet hbvm
! env/bin/python -c 'import hbvm' 2>/dev/null || { echo "something of it is left"; exit 1; }
