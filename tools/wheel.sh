#!/bin/sh
# Builds the Python package, a wheel with the module and the command, into out/wheel.
#
#   tools/wheel.sh [test]
#
# With `test`, the wheel is installed into an empty environment and tested there.
set -eu
cd "$(dirname "$0")/.."
out=$PWD/out/wheel
data=$out/gpc_render.data

rm -rf "$data" "$out"/*.whl
mkdir -p "$data/scripts"
# With both packages at once, their dependencies are compiled once.
cargo build --release -p gpc-render -p gpc-python
strip -o "$data/scripts/gpc" "${CARGO_TARGET_DIR:-target}/release/gpc"
[ -x "$out/build/bin/maturin" ] || { python3 -m venv "$out/build" && "$out/build/bin/pip" install --quiet 'maturin>=1.8,<2'; }
"$out/build/bin/maturin" build --release --manifest-path python/Cargo.toml --out "$out"
[ "${1:-}" = test ] || exit 0

rm -rf "$out/test"
python3 -m venv "$out/test"
wheel=$(ls "$out"/*.whl)
"$out/test/bin/pip" install --quiet "$wheel[test]"
cd python
"$out/test/bin/mypy" --cache-dir "$out/mypy" tests examples
"$out/test/bin/python" -m mypy.stubtest gpc --concise
"$out/test/bin/pytest" -q -o cache_dir="$out/pytest"
