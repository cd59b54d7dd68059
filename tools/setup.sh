#!/usr/bin/env bash
# Installs the packages that the named parts of the build need, if they are missing.
#
#   tools/setup.sh build|vulkan|lavapipe|validation|shaders|c|window|display|pictures|python ...
#
# If nothing is missing, the script changes nothing and needs no root. Packages are installed with apt, as root or through sudo
# without a password. If that is not possible, the script prints what to install and fails.
set -euo pipefail

missing=()  # what is missing, in words
packages=() # the Debian and Ubuntu packages that hold it

lacks() { # WORDS PACKAGE...
    missing+=("$1")
    shift
    packages+=("$@")
}

has() { command -v "$1" >/dev/null 2>&1; }

# Succeeds if the Vulkan loader finds a driver's manifest whose name matches the pattern.
has_driver() {
    local named="${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}"
    if [ -n "$named" ]; then
        [[ "$named" == $1 ]]
        return
    fi
    local folders="${XDG_DATA_HOME:-${HOME:-}/.local/share}:${XDG_DATA_DIRS:-/usr/local/share:/usr/share}:/etc:/usr/local/etc"
    local folder
    while IFS= read -r -d : folder; do
        compgen -G "$folder/vulkan/icd.d/$1" >/dev/null && return
    done <<<"$folders:"
    return 1
}

has_library() {
    local folder
    for folder in /lib /usr/lib /usr/local/lib /lib64 /usr/lib64 /lib/*-linux-gnu* /usr/lib/*-linux-gnu*; do
        [ -e "$folder/$1" ] && return
    done
    local searched
    IFS=: read -ra searched <<<"${LD_LIBRARY_PATH:-}"
    for folder in "${searched[@]}"; do
        [ -e "$folder/$1" ] && return
    done
    return 1
}

has_layer() {
    compgen -G "/usr/share/vulkan/explicit_layer.d/$1" >/dev/null \
        || compgen -G "/etc/vulkan/explicit_layer.d/$1" >/dev/null \
        || compgen -G "${VK_LAYER_PATH:-/nowhere}/$1" >/dev/null
}

needs_build() {
    has c++ || has g++ || has clang++ || lacks "a C++ compiler" g++
}

needs_loader() {
    has_library libvulkan.so.1 || lacks "the Vulkan loader (libvulkan.so.1)" libvulkan1
}

needs_vulkan() {
    needs_loader
    has_driver '*.json' || lacks "a Vulkan 1.3 driver (Mesa's lavapipe needs no GPU)" mesa-vulkan-drivers
}

needs_lavapipe() {
    needs_loader
    has_driver '*lvp_icd*.json' || lacks "Mesa's software Vulkan driver (lavapipe)" mesa-vulkan-drivers
}

needs_validation() {
    has_layer 'VkLayer_khronos_validation.json' \
        || lacks "the Vulkan validation layer (VK_LAYER_KHRONOS_validation)" vulkan-validationlayers
}

# For building programs in C and C++ that use the library.
needs_c() {
    needs_build
    has pkg-config || lacks "pkg-config" pkg-config
    has cmake || lacks "cmake" cmake
    [ -e /usr/include/vulkan/vulkan_core.h ] || lacks "Vulkan's headers" libvulkan-dev
}

needs_shaders() {
    needs_build
    has cmake || lacks "cmake" cmake
    has python3 || lacks "Python 3" python3
    has git || lacks "git" git
}

# Libraries that are loaded when a window opens. Desktops with Wayland have its libraries anyway.
needs_window() {
    local name package
    while read -r name package; do
        has_library "$name" || lacks "$name" "$package"
    done <<END
libX11.so.6 libx11-6
libX11-xcb.so.1 libx11-xcb1
libXcursor.so.1 libxcursor1
libXi.so.6 libxi6
libxkbcommon-x11.so.0 libxkbcommon-x11-0
END
}

# For tests of the window: a virtual X11 display and simulated input; virtual Wayland monitors and screenshots of them.
needs_display() {
    has Xvfb || lacks "Xvfb" xvfb
    has xdotool || lacks "xdotool" xdotool
    has sway || lacks "sway" sway
    has grim || lacks "grim" grim
}

# For enlarging pictures.
needs_pictures() {
    has ffmpeg || lacks "ffmpeg" ffmpeg
}

# For the Python package and its tests.
needs_python() {
    has python3 && python3 -c 'import ensurepip, venv' 2>/dev/null || lacks "Python 3 with venv" python3-venv
}

if ! has cargo; then
    echo "Rust is not installed, or cargo is not in PATH: see https://rustup.rs" >&2
    exit 1
fi

for part in "$@"; do
    case "$part" in
        build | vulkan | lavapipe | validation | shaders | c | window | display | pictures | python) "needs_$part" ;;
        *)
            echo "tools/setup.sh: no part \"$part\"; there are build, vulkan, lavapipe, validation, shaders, c, window, display, pictures and python" >&2
            exit 2
            ;;
    esac
done

[ ${#missing[@]} -eq 0 ] && exit 0
mapfile -t packages < <(printf '%s\n' "${packages[@]}" | sort -u)

root=()
if has apt-get && [ "$(id -u)" -eq 0 ]; then
    :
elif has apt-get && has sudo && sudo -n true 2>/dev/null; then
    root=(sudo -n)
else
    {
        echo "Missing, and not installable from here (that takes apt-get, as root or through sudo without a password):"
        printf '  - %s\n' "${missing[@]}" | awk '!seen[$0]++'
        echo "On Debian or Ubuntu this installs it:"
        echo "  sudo apt-get install ${packages[*]}"
        echo "Elsewhere, install what carries these in your system's package manager. Then run the command again."
    } >&2
    exit 1
fi

echo "Installing ${packages[*]}"
apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0)
"${apt[@]}" update
"${apt[@]}" install -y --no-install-recommends "${packages[@]}"
