#!/usr/bin/env bash
# Installs the packages of tools/dist.sh in empty Debian 12 and 13 systems, and runs them there. Needs root, debootstrap, and
# access to Debian's packages.
#
#   tools/test-dist.sh [FOLDER [RELEASE...]]     by default out/dist, bookworm and trixie
set -euo pipefail
cd "$(dirname "$0")/.."

dist="$(realpath "${1:-out/dist}")"
shift || true
releases=("$@")
[ ${#releases[@]} -gt 0 ] || releases=(bookworm trixie)
[ "$(id -u)" -eq 0 ] || { echo "this needs root, for debootstrap and chroot" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "debootstrap is not installed" >&2; exit 1; }

# The site from which the machine's apt gets Debian's packages.
site="$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -n 1)"
[ -n "$site" ] || site=http://deb.debian.org/debian

work="$(mktemp -d)"
trap 'umount -l "$work"/*/proc 2>/dev/null || true; rm -rf "$work"' EXIT

for release in "${releases[@]}"; do
    echo "== $release"
    root="$work/$release"
    debootstrap --variant=minbase "$release" "$root" "$site" >"$work/$release.log" 2>&1 ||
        { tail "$work/$release.log" >&2; exit 1; }
    cp /etc/resolv.conf "$root/etc/"
    # Settings of the machine's apt, such as proxies.
    cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
    mount -t proc proc "$root/proc"
    cp "$dist"/*.deb "$dist"/*.tar.xz tests/hosts/linked.c "$root/tmp/"
    chroot "$root" bash -euo pipefail <<'INSIDE'
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
cd /tmp
apt-get -qq update
apt-get -qq install -y --no-install-recommends ./gpc-render_*.deb mesa-vulkan-drivers >/dev/null

render() { # COMMAND IMAGE
    "$1" render /usr/share/doc/gpc-render/fence.glb -o "$2" --size 320x180 --background '#a8c0d8' --quiet
    "$1" compare "$2" "$2" --max-rmse 0
}
echo "-- the package"
gpc --version
gpc devices
render gpc package.png
test -e /usr/share/man/man1/gpc-render.1.gz -o -e /usr/share/man/man1/gpc-render.1

echo "-- the archive"
apt-get -qq install -y --no-install-recommends xz-utils >/dev/null
tar -xJf gpc-[0-9]*.tar.xz
render ./gpc-[0-9]*/bin/gpc archive.png
cmp package.png archive.png

echo "-- the C library"
apt-get -qq install -y --no-install-recommends gcc libc6-dev pkg-config libvulkan-dev >/dev/null
tar -xJf libgpc-*.tar.xz
cd libgpc-*/
export PKG_CONFIG_PATH="$PWD/lib/pkgconfig" LD_LIBRARY_PATH="$PWD/lib"
link() { # OPTIONS...
    gcc /tmp/linked.c -o /tmp/linked "$@"
    /tmp/linked
}
link $(pkg-config --cflags --libs gpc)
link -static $(pkg-config --cflags --static --libs gpc)
test -e share/doc/gpc/embedding.md -a -e share/doc/gpc/THIRD-PARTY.txt
INSIDE
    umount "$root/proc"
    rm -rf "$root"
done
echo "all packages install and run on ${releases[*]}"
