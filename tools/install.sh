#!/usr/bin/env bash
# Installs the C library that `make install` has built: header, libraries, GLSL includes, files for pkg-config and CMake, manual,
# an example, licences. Then it says where they are.
#
#   tools/install.sh BUILT VERSION SONAME PREFIX [DESTDIR]
#
# BUILT is the folder with libgpc.so and libgpc.a. All files go below PREFIX. If a package is being made, DESTDIR is the folder
# that stands for the root of the system.
set -euo pipefail

built="$1" version="$2" soname="$3" prefix="$4" destdir="${5:-}"
root="$destdir$prefix"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

install -d "$root/include" "$root/lib/pkgconfig" "$root/lib/cmake/gpc" "$root/share/gpc/shaders" "$root/share/doc/gpc"
install -m 644 include/gpc.h "$root/include/"
install -m 755 "$built/libgpc.so" "$root/lib/libgpc.so.$version"
ln -sf "libgpc.so.$version" "$root/lib/$soname"
ln -sf "$soname" "$root/lib/libgpc.so"
install -m 644 LICENSE-MIT LICENSE-APACHE "$root/share/doc/gpc/"
# Links of the manual lead to where its pages, the example and the includes are installed. Links to anything else become text.
pages='embedding|embedding-reference|fits|swapchains|CHANGELOG'
for page in docs/embedding.md docs/embedding-reference.md docs/fits.md docs/swapchains.md CHANGELOG.md; do
    sed -Ez -e 's#\]\(\.\./examples/forward#](../../gpc/examples/forward#g' \
        -e 's#\]\(\.\./shaders/(include|slang)/#](../../gpc/shaders/#g' \
        -e "s%\]\((https?:|#|($pages)\.md|pictures/|\.\./\.\./gpc/)%]\x01(\1%g" \
        -e 's#\[([^]]*)\]\([^)]*\)#\1#g' -e 's#\x01##g' "$page" >"$work/page.md"
    install -m 644 "$work/page.md" "$root/share/doc/gpc/${page##*/}"
done
install -d "$root/share/doc/gpc/pictures"
install -m 644 docs/pictures/besides-*.png "$root/share/doc/gpc/pictures/"

# The static library is a single object in which only the interface is visible, so that programs can be linked with another
# library written in Rust, too.
mapfile -t interface < <(nm --extern-only --defined-only "$built/libgpc.a" 2>/dev/null | sed -n 's/^.* T \(gpc_[a-z_]*\)$/-u\1/p' | sort)
ld -r --gc-sections --force-group-allocation "${interface[@]}" -o "$work/gpc.o" "$built/libgpc.a"
objcopy --wildcard --keep-global-symbol='gpc_*' --remove-section=.llvmbc --remove-section=.llvmcmd "$work/gpc.o"
rm -f "$root/lib/libgpc.a"
ar rcs "$root/lib/libgpc.a" "$work/gpc.o"
chmod 644 "$root/lib/libgpc.a"

# The files that an application's shaders include, and the files that these include.
for name in gpc_visibility gpc_texture gpc_position gpc_instance place place_in_tile barycentric finite; do
    install -m 644 "shaders/include/$name.glsl" "$root/share/gpc/shaders/"
done
install -m 644 shaders/slang/gpc_visibility.slang "$root/share/gpc/shaders/"

# The example that the manual speaks of, with its shaders.
for folder in . shaders shaders/spirv; do
    install -d "$root/share/gpc/examples/forward/$folder"
    find "examples/forward/$folder" -maxdepth 1 -type f -exec install -m 644 -t "$root/share/gpc/examples/forward/$folder" {} +
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
Libs.private: -lutil -lrt -lpthread -lm -ldl -lc
END

cat >"$root/lib/cmake/gpc/gpc-config.cmake" <<END
# gpc::gpc is the shared library, gpc::gpc_static the static one. gpc_SHADERS is the folder of the GLSL includes.
include(CMakeFindDependencyMacro)
find_dependency(Vulkan)
get_filename_component(_gpc_prefix "\${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(gpc_SHADERS "\${_gpc_prefix}/share/gpc/shaders")
if(NOT TARGET gpc::gpc)
    add_library(gpc::gpc SHARED IMPORTED)
    set_target_properties(gpc::gpc PROPERTIES
        IMPORTED_LOCATION "\${_gpc_prefix}/lib/libgpc.so.$version"
        IMPORTED_SONAME "$soname"
        INTERFACE_INCLUDE_DIRECTORIES "\${_gpc_prefix}/include;\${Vulkan_INCLUDE_DIRS}")
    add_library(gpc::gpc_static STATIC IMPORTED)
    set_target_properties(gpc::gpc_static PROPERTIES
        IMPORTED_LOCATION "\${_gpc_prefix}/lib/libgpc.a"
        INTERFACE_INCLUDE_DIRECTORIES "\${_gpc_prefix}/include;\${Vulkan_INCLUDE_DIRS}"
        INTERFACE_LINK_LIBRARIES "util;rt;pthread;m;dl")
endif()
END
# A program that asks for an earlier version with the same major version gets this one. While that is 0, the minor version has to
# be the same, too.
cat >"$root/lib/cmake/gpc/gpc-config-version.cmake" <<END
set(PACKAGE_VERSION $version)
if(PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION OR NOT PACKAGE_FIND_VERSION_MAJOR EQUAL ${version%%.*}
    OR (PACKAGE_FIND_VERSION_MAJOR EQUAL 0 AND PACKAGE_FIND_VERSION VERSION_LESS ${version%.*}))
    set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
    if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
        set(PACKAGE_VERSION_EXACT TRUE)
    endif()
endif()
END

echo "gpc $version is in $root: the header in include, the libraries in lib, the GLSL includes and an example in share/gpc,"
echo "the manual in share/doc/gpc (begin with embedding.md)"
# Where programs look without being told, ldconfig suffices.
case "$prefix" in
/usr | /usr/local) [ -n "$destdir" ] || echo "run ldconfig, so that programs find the library" ;;
*)
    [ -n "$destdir" ] || echo "to compile and to run programs with it:
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig LD_LIBRARY_PATH=$prefix/lib"
    ;;
esac
