#!/usr/bin/env bash
# Measures what antialiasing costs and how exact it is, on the scenes of assets/ and, where they are, on larger ones.
#
#   tools/bench.sh [FOLDER [OPTION...]]
#
# OPTIONs are those of `gpc bench`.
set -euo pipefail
cd "$(dirname "$0")/.."

folder="${1:-out/bench}"
shift || true

source tools/scenes.sh
scenes=(assets/*.glb)
for scene in "${quality_scenes[@]}"; do
    [[ "$scene" == assets/* ]] || scenes+=("$scene")
done

cargo run --release --quiet --bin gpc -- bench "${scenes[@]}" --out "$folder" "$@"
echo
echo "$folder holds report.html, results.csv and results.json"
