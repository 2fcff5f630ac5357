#!/usr/bin/env bash
# The Python module by pytest, or the notebooks: python_test.sh package|notebooks PYTHON MODULE_FOLDER SOURCE.
set -euo pipefail
part="$1" python="$2" source="$4"
export PYTHONPATH="$3" PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg PYDEVD_DISABLE_FILE_VALIDATION=1
needed="pytest numpy mpmath matplotlib"
[ "$part" = package ] || needed="numpy mpmath matplotlib nbclient nbformat ipykernel"
for module in $needed; do
  "$python" -c "import $module" 2>/dev/null || { echo "skipped: $python has no module $module"; exit 77; }
done
case "$part" in
  package) exec "$python" -m pytest -q -p no:cacheprovider "$source/tests/python" ;;
  notebooks) exec "$python" "$source/tests/python/run_notebooks.py" "$source/studies/notebooks" ;;
esac
