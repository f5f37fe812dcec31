#!/usr/bin/env bash
# A sequence as a Slurm array: every task takes its chunk of the frames.
#
#   sbatch --array=1-4 examples/farm/slurm_array.sh look.toml 'in/shot.####.exr' 'out/shot.####.exr' 1-24
#
# Tasks are numbered from 1; how many there are is the --array's own count. A task that was cancelled,
# pre-empted or requeued goes on where it ended: --existing update keeps the frames that are done with
# this look and these inputs, and makes the others.
#SBATCH --job-name=kagefude
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=TERM@5
set -euo pipefail
if [ $# -lt 3 ]; then
  echo "usage: sbatch --array=1-N $0 LOOK INPUT OUTPUT [FRAMES [OPTIONS...]]" >&2
  exit 2
fi
look=$1 input=$2 output=$3
shift 3
frames=()
if [ $# -gt 0 ]; then
  frames=(--frames "$1")
  shift
fi
exec "${KAGEFUDE:-kagefude}" comp "$look" "$input" -o "$output" "${frames[@]}" \
  --chunk "${SLURM_ARRAY_TASK_ID:-1}/${SLURM_ARRAY_TASK_COUNT:-1}" --existing update \
  --skip-bad-frames --threads "${SLURM_CPUS_PER_TASK:-0}" --progress plain "$@"
