#!/usr/bin/env bash
# Measures the cost and the accuracy of antialiasing, on the scenes in assets/ and on those larger scenes that are present.
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
echo "$folder holds report.html, results.json and a CSV of each study"
