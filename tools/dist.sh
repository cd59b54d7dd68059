#!/usr/bin/env bash
# Makes the files of a release, in out/dist:
#
#   gpc-VERSION-TRIPLE.tar.xz      the command with its window, stripped, manual pages, completions, licences, examples
#   gpc-render_VERSION-1_ARCH.deb  the same as a package (by cargo-deb)
#   libgpc-VERSION-TRIPLE.tar.xz   the C library: header, libraries, GLSL includes, files for pkg-config and CMake, manual, licences
#
# With FEATURES=cli, the command has no window.
#
# An archive unpacks into a folder with its name. The folders bin, lib, share and include in there belong below a prefix such as
# /usr/local.
set -euo pipefail
cd "$(dirname "$0")/.."

cargo deb --version >/dev/null 2>&1 || {
    echo "cargo-deb is not installed: cargo install --locked cargo-deb" >&2
    exit 1
}

version="$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)"
triple="$(rustc -vV | sed -n 's/^host: //p')"
built="${CARGO_TARGET_DIR:-target}/release"
dist=out/dist
rm -rf "$dist"
root="$dist/root"
doc="$root/share/doc/gpc-render"
install -d "$root/bin" "$root/share/man/man1" "$root/share/bash-completion/completions" \
    "$root/share/fish/vendor_completions.d" "$root/share/zsh/site-functions" "$doc"

features="${FEATURES:-view}"
cargo build --release --locked --features "$features" --bin gpc
cargo run --release --locked --features "$features" --example manual "$dist/manual"
install -m 755 "$built/gpc" "$root/bin/gpc"
strip "$root/bin/gpc"
install -m 644 "$dist"/manual/man1/*.1 "$root/share/man/man1/"
install -m 644 "$dist/manual/completions/gpc.bash" "$root/share/bash-completion/completions/gpc"
install -m 644 "$dist/manual/completions/gpc.fish" "$root/share/fish/vendor_completions.d/"
install -m 644 "$dist/manual/completions/_gpc" "$root/share/zsh/site-functions/"
rm -r "$dist/manual"

tools/licences.sh --features "$features" >"$doc/THIRD-PARTY.txt"
install -m 644 LICENSE-MIT LICENSE-APACHE README.md CHANGELOG.md CITATION.cff "$doc/"
# Scenes to try, and an example of a workflow with golden images.
install -m 644 assets/fence.glb assets/letters.glb examples/ci/golden-images.yml "$doc/"

archive() { # NAME FOLDER
    tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct)" \
        --transform "s,^\.,$1," -C "$2" -cJf "$dist/$1.tar.xz" .
}
archive "gpc-$version-$triple" "$root"
cargo deb --no-build --no-strip --locked --output "$dist/"

# The C library.
library="$dist/library"
make --no-print-directory install PREFIX="$PWD/$library"
# The prefix is relative to the file, since the archive may be unpacked anywhere.
sed -i 's,^prefix=.*,prefix=${pcfiledir}/../..,' "$library/lib/pkgconfig/gpc.pc"
strip --strip-debug "$library"/lib/libgpc.so."$version" "$library"/lib/libgpc.a
tools/licences.sh --no-default-features --features capi >"$library/share/doc/gpc/THIRD-PARTY.txt"
archive "libgpc-$version-$triple" "$library"
rm -r "$library"

(cd "$dist" && sha256sum -- *.tar.xz *.deb >SHA256SUMS)
ls -l "$dist"
