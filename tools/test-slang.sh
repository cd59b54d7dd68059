#!/usr/bin/env bash
# Compiles gpc_visibility.slang with the Slang compiler of the Python package slangpy, compares its descriptor set and version with
# those of gpc_visibility.glsl, and has a program of the C library shade a triangle with it.
#
#   tools/test-slang.sh
#
# The package (92 MB) is installed into out/slang. The program checks the barycentric coordinates of each sample itself.
set -euo pipefail
cd "$(dirname "$0")/.."

out="$PWD/out/slang"
mkdir -p "$out"
[ -d "$out/python/bin" ] || python3 -m venv "$out/python"
"$out/python/bin/python" -c 'import importlib.util as u; exit(not u.find_spec("slangpy"))' \
    || "$out/python/bin/pip" install --quiet --no-deps slangpy==0.43.1

"$out/python/bin/python" tools/slang/compile.py tools/slang/samples.slang shaders/slang "$out/samples.spv" \
    tests/hosts/shaders/spirv/samples.spv
"$out/python/bin/python" tools/slang/compile.py tools/slang/draws.slang shaders/slang "$out/draws.spv" \
    examples/forward/shaders/spirv/samples.spv

make --silent install PREFIX="$out/root"
export PKG_CONFIG_PATH="$out/root/lib/pkgconfig" LD_LIBRARY_PATH="$out/root/lib"
# shellcheck disable=SC2046
cc -std=c99 tests/hosts/frozen/program.c -o "$out/program" $(pkg-config --cflags --libs gpc) -lvulkan
"$out/program" tests/hosts/shaders/spirv/samples.spv >"$out/glsl.txt"
"$out/program" "$out/samples.spv" | diff "$out/glsl.txt" - || { echo "the shader in Slang gives another picture" >&2; exit 1; }
echo "the shaders in GLSL and in Slang give: $(cat "$out/glsl.txt")"
