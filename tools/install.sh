#!/usr/bin/env bash
# Installs the C library that `make install` has built: header, libraries, GLSL includes, pkg-config file.
#
#   tools/install.sh BUILT VERSION SONAME PREFIX [DESTDIR]
#
# BUILT is the folder with libgpc.so and libgpc.a. All go below PREFIX; where a package is being made, DESTDIR is the folder
# that stands for the root of the system.
set -euo pipefail

built="$1" version="$2" soname="$3" prefix="$4" destdir="${5:-}"
root="$destdir$prefix"

install -d "$root/include" "$root/lib/pkgconfig" "$root/share/gpc/shaders"
install -m 644 include/gpc.h "$root/include/"
install -m 644 "$built/libgpc.a" "$root/lib/"
install -m 755 "$built/libgpc.so" "$root/lib/libgpc.so.$version"
ln -sf "libgpc.so.$version" "$root/lib/$soname"
ln -sf "$soname" "$root/lib/libgpc.so"
# What an application's shaders include, and what that includes.
for name in gpc_visibility gpc_texture gpc_position place place_in_tile barycentric finite; do
    install -m 644 "shaders/include/$name.glsl" "$root/share/gpc/shaders/"
done
cat >"$root/lib/pkgconfig/gpc.pc" <<END
prefix=$prefix
includedir=\${prefix}/include
libdir=\${prefix}/lib
shaders=\${prefix}/share/gpc/shaders

Name: gpc
Description: Antialiases only where an image aliases, in a Vulkan application's own frames
Version: $version
Cflags: -I\${includedir}
Libs: -L\${libdir} -lgpc
Libs.private: -lgcc_s -lutil -lrt -lpthread -lm -ldl -lc
END
