#!/usr/bin/env bash
# The job array of studies/cluster on this computer, against one run. Exit code 77, with the reason, without Slurm.
# Usage: cluster_test.sh HBVM SOURCE_FOLDER
set -euo pipefail

hbvm=$1 source=$2
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
HBVM_PROGRAM=$hbvm "$source/studies/cluster/run" --local --shards 3 --out "$out" --claims simple_pendulum
"$hbvm" audit --claims simple_pendulum --shard 1/1 --out "$out/one" > /dev/null
cmp "$out/merged/findings.jsonl" "$out/one/findings.jsonl"
