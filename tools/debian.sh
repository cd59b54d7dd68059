# Mesa's drivers of another Debian release, without installing them. Scripts source this file in the project's folder.
#
# apt fetches the packages from where the machine gets its own. This needs no root. They are unpacked in `folder`. `gpc` is the
# command, which scripts build.

folder="${CARGO_TARGET_DIR:-target}/drivers"
mkdir -p "$folder"
folder="$(realpath "$folder")"
gpc="$(realpath "${CARGO_TARGET_DIR:-target}")/release/gpc"

release="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"

# Runs apt-get with lists, status and cache of its own in a folder. If the folder has a sources.list, this replaces the
# machine's sources.
private_apt() { # FOLDER COMMAND...
    local own="$1" options=()
    shift
    mkdir -p "$own/lists/partial" "$own/archives/partial"
    : >>"$own/status"
    options=(-q -o "Dir::State::Lists=$own/lists" -o "Dir::State::status=$own/status" -o "Dir::Cache=$own"
        -o "Dir::Cache::archives=$own/archives" -o APT::Sandbox::User= -o Debug::NoLocking=1)
    if [ -e "$own/sources.list" ]; then
        options+=(-o "Dir::Etc::SourceList=$own/sources.list" -o Dir::Etc::SourceParts=/dev/null
            -o Dir::Etc::Preferences=/dev/null -o Dir::Etc::PreferencesParts=/dev/null)
    fi
    apt-get "${options[@]}" "$@"
}

# Unpacks Mesa's Vulkan drivers of a release into $folder/RELEASE/root, with the loader and all libraries that they need.
# If it fails, prints why.
fetch_release() { # RELEASE
    local own="$folder/$1" site keys package
    [ -e "$own/unpacked" ] && return
    site="$(apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' |
        sed -nE "s/^([^ ]+) $release\$/\1/p" | head -n 1)"
    keys=/usr/share/keyrings/debian-archive-keyring.gpg
    if [ -z "$site" ] || [ ! -e "$keys" ]; then
        echo "the machine's apt gets no packages of Debian"
        return 1
    fi
    mkdir -p "$own/root"
    echo "deb [signed-by=$keys] $site $1 main" >"$own/sources.list"
    if ! { private_apt "$own" update && private_apt "$own" install -y --no-install-recommends --download-only \
        mesa-vulkan-drivers libvulkan1 vulkan-validationlayers; } >"$own/log" 2>&1; then
        echo "apt could not fetch it: $(tail -n 1 "$own/log")"
        return 1
    fi
    for package in "$own"/archives/*.deb; do
        dpkg-deb -x "$package" "$own/root" || return 1
    done
    : >"$own/unpacked"
}

# Writes a manifest for the Vulkan loader of a release's driver, libvulkan_NAME.so, and prints the manifest's path.
manifest_of_release() { # RELEASE NAME
    local manifest="$folder/$1/$2.json" library
    library="$(find "$folder/$1/root/usr/lib" -name "libvulkan_$2.so" | head -n 1)"
    printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' "$library" >"$manifest"
    echo "$manifest"
}

# Prints the words of a command, one a line, that runs a program with the C library of a release, for which its drivers were
# built.
runner_of_release() { # RELEASE
    local root="$folder/$1/root"
    find "$root" -name 'ld-linux-*.so.*' | head -n 1
    echo --library-path
    find "$root/usr/lib" -maxdepth 1 -name '*-linux-gnu*' | paste -sd :
}
