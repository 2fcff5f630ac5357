#!/usr/bin/env bash
# What hbvm writes, read by a tool as studies/files.md says. Exit code 77, with the reason, without that tool.
# Usage: files_test.sh numpy|pandas|octave|gnuplot|schema HBVM SOURCE_FOLDER
set -euo pipefail

reader=$1 hbvm=$2 source=$3
here=$source/tests/files
python=/usr/bin/python3 # Debian's, whose modules are Debian's packages

skip() {
  echo "skipped: $1"
  exit 77
}
case $reader in
octave) command -v octave-cli >/dev/null || skip "no octave-cli: apt install octave" ;;
gnuplot) command -v gnuplot >/dev/null || skip "no gnuplot: apt install gnuplot-nox" ;;
numpy | pandas | schema)
  module=${reader/schema/jsonschema}
  [ -x $python ] || skip "no $python: apt install python3"
  $python -c "import $module" 2>/dev/null || skip "no module $module: apt install python3-$module"
  ;;
esac

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
if [ "$reader" = schema ]; then
  $python "$here/schema_test.py" "$hbvm" "$source/studies/run.schema.json"
  exit
fi

for precision in double mpfr:50; do
  "$hbvm" run double_pendulum --method hbvm:3,2 --step 1/16 --until 1 --precision $precision --json \
    --out "${precision%:*}.csv" > "${precision%:*}.json" 2>/dev/null
done
case $reader in
numpy | pandas) $python "$here/${reader}_test.py" ;;
octave) octave-cli --no-init-file --quiet "$here/octave_test.m" ;;
gnuplot)
  # The table that gnuplot would draw, with the digits of double, against the columns by their place.
  LC_ALL=C gnuplot "$here/gnuplot_test.gp"
  for columns in 1,3 2,10; do
    awk -F, -v columns=$columns 'BEGIN { split(columns, c, ",") }
      NR > 1 { printf "%.17g %.17g\n", $c[1], $c[2] }' double.csv > "expected_$columns"
    grep -v '^ *\(#.*\)\?$' "table_$columns" | awk '{ print $1, $2 }' | diff - "expected_$columns"
  done
  grep -c . expected_1,3 | grep -qx 17
  ;;
esac
