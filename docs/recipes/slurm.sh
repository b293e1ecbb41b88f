#!/usr/bin/env bash
#SBATCH --job-name=tautline
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output=shard-%a.log
# One shard of a plan for each task of a Slurm array. The plan lies on a file system that all nodes see. A task that is
# killed and queued again goes on from where it was.
#
#     tautline hunt --robots 5 --max-walls 4 --plan plan.json --shards 64
#     sbatch --wait --array=1-64 docs/recipes/slurm.sh hunt plan.json
#     tautline merge plan.json
set -euo pipefail
export RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1}
exec "${TAUTLINE:-tautline}" "$1" --plan "$2" --shard "$SLURM_ARRAY_TASK_ID"
