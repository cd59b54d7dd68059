#!/usr/bin/env bash
# Prints the licences of all crates that are compiled into a build of this package, and the texts that these crates come with.
#
#   tools/licences.sh [OPTION...]     options of `cargo tree`, such as --features view
#
# Texts that several crates share are printed once.
set -euo pipefail
cd "$(dirname "$0")/.."

sources="${CARGO_HOME:-$HOME/.cargo}/registry/src"
texts="$(mktemp -d)"
trap 'rm -r "$texts"' EXIT

echo "Crates that are compiled into $(sed -n 's/^name = "\(.*\)"/\1/p' Cargo.toml | head -n 1), with their licences. The texts follow below."
echo
# Lines of name, version and licence. Macros and build scripts are left out, since they are no part of the program.
mapfile -t crates < <(cargo tree --locked --edges normal,no-proc-macro --prefix none --format '{p}	{l}' --no-dedupe "$@" |
    sed -nE 's/^([^ ]+) v([^ \t]+)( \(proc-macro\))?\t(.*)$/\1\t\2\t\4/p' | sort -u)
for crate in "${crates[@]}"; do
    IFS=$'\t' read -r name version licence <<<"$crate"
    printf '%-32s %-14s %s\n' "$name" "$version" "$licence"
    folder="$(ls -d "$sources"/*/"$name-$version" | head -n 1)"
    found=
    while IFS= read -r file; do
        found=yes
        digest="$(tr -s '[:space:]' ' ' <"$file" | sha256sum | cut -d ' ' -f 1)"
        [ -e "$texts/$digest" ] || cp "$file" "$texts/$digest"
        echo "$name $version" >>"$texts/$digest.crates"
    done < <(find "$folder" -maxdepth 2 -type f \( -iname 'licen[cs]e*' -o -iname 'copying*' -o -iname 'notice*' -o -iname 'unlicense*' \) \
        ! -name '*.rs' | sort)
    [ -n "$found" ] || echo "$name $version: $licence" >>"$texts/without"
done
if [ -e "$texts/without" ]; then
    printf '\nThese crates come without a text. https://crates.io/crates/NAME has their authors and sources:\n\n'
    cat "$texts/without"
fi
for users in "$texts"/*.crates; do
    printf '\n%s\n\n%s\n\n' "$(printf '=%.0s' {1..100})" "$(sort -u "$users" | paste -sd , | sed 's/,/, /g')"
    cat "${users%.crates}"
done
