#!/usr/bin/env bash
# Runs a command that stores counterexamples in the folder $OUT, makes a page of each, and ends as the command did.
set -uo pipefail
mkdir -p "${OUT:?is to be the folder in which the command stores counterexamples}"
"$@"
code=$?
for run in "$OUT"/*.jsonl; do
    [ -e "$run" ] && "${TAUTLINE:-tautline}" replay "$run" --html "${run%.jsonl}.html" > "${run%.jsonl}.txt" 2>&1
done
exit "$code"
