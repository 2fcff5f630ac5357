#!/usr/bin/env bash
# Every C++ file is as clang-format writes it: format_test.sh SOURCE. Another version writes some lines differently.
set -euo pipefail
cd "$1"
command -v clang-format-14 >/dev/null || { echo "skipped: there is no clang-format-14"; exit 77; }
find include src tests studies -name '*.[ch]pp' -print0 | xargs -0 -n 50 clang-format-14 --dry-run -Werror --ferror-limit=1 ||
  { echo "clang-format-14 -i FILES mends it"; exit 1; }
