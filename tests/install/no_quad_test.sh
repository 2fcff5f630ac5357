#!/usr/bin/env bash
# A program that was built without the precision quad: no_quad_test.sh HBVM. All else works; quad is refused.
set -euo pipefail
hbvm="$(realpath "$1")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "$*" >&2; exit 1; }

! ldd "$hbvm" | grep quadmath || fail "libquadmath is linked"
for command in "run kepler --method hbvm:4,2 --step 1/16 --until 1" "nodes 5" "study $PWD" "scene check kepler"; do
  status=0
  "$hbvm" $command --precision quad >out 2>err || status=$?
  [ "$status" = 2 ] && grep -q "quad.*not in this build.*mpfr:34" err || fail "hbvm $command: exit code $status, $(cat out err)"
done
for precision in double mpfr:34 mpfr:50; do
  "$hbvm" run double_pendulum --method hbvm:4,2 --step 1/16 --until 1 --precision "$precision" --error
done
# These choose precisions by themselves.
"$hbvm" run double_pendulum --method hbvm:4,2 --step 1/16 --until 1 --shadow
"$hbvm" cost double_pendulum --until 1 --digits 20 --methods hbvm:6,6
"$hbvm" audit --quick >audit || fail "audit --quick: $(tail -n 20 audit)"
"$hbvm" stability --quick >stability || fail "stability --quick: $(tail -n 20 stability)"
