#!/usr/bin/env bash
# All shards of a plan by GNU parallel. A shard that fails is tried again, and goes on from where it was. What follows the
# number of shards is for parallel: --sshlogin and --workdir for other machines, which share this folder and this program.
#
#     tautline hunt --robots 5 --max-walls 4 --plan plan.json --shards 64
#     docs/recipes/parallel.sh hunt plan.json 64
#     docs/recipes/parallel.sh hunt plan.json 64 --sshlogin one,two --workdir .
set -euo pipefail
command=$1 plan=$2 shards=$3
tautline=${TAUTLINE:-tautline}

# One thread for each shard: parallel runs as many shards as there are cores.
export RAYON_NUM_THREADS=1
seq "$shards" | parallel --will-cite --quote --retries 3 --env RAYON_NUM_THREADS "${@:4}" "$tautline" "$command" --plan "$plan" --shard {}
"$tautline" merge "$plan"
