#!/usr/bin/env bash
# All shards of a plan by HyperQueue. The plan lies on a file system that all workers see.
#
#     tautline hunt --robots 5 --max-walls 4 --plan plan.json --shards 64
#     docs/recipes/hyperqueue.sh hunt plan.json 64
set -euo pipefail
command=$1 plan=$2 shards=$3
tautline=${TAUTLINE:-tautline}
export RAYON_NUM_THREADS=1
hq submit --wait --array "1-$shards" --cpus 1 --crash-limit 5 --env RAYON_NUM_THREADS=1 \
    -- bash -c 'exec "$0" "$@" --shard "$HQ_TASK_ID"' "$tautline" "$command" --plan "$plan"
"$tautline" merge "$plan"
