# Mesa's drivers of another Debian release, without installing them. Sourced by scripts that set `folder`, where packages are unpacked.
#
# apt fetches them from where the machine gets its own packages. That takes no rights.

release="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"

# apt with lists, status and cache of its own. The first argument is a folder with a sources.list, or nothing for the
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

# Unpacks Mesa's Vulkan drivers of a release, with all that they need from the loader down, into $folder/RELEASE/root.
# Prints why where it can't.
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

# Writes a loader's manifest of a driver of a release, libvulkan_NAME.so, and prints its path.
manifest_of_release() { # RELEASE NAME
    local manifest="$folder/$1/$2.json" library
    library="$(find "$folder/$1/root/usr/lib" -name "libvulkan_$2.so" | head -n 1)"
    printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' "$library" >"$manifest"
    echo "$manifest"
}

# The command that runs a program with the C library of a release, for which its drivers were built.
runner_of_release() { # RELEASE
    local root="$folder/$1/root"
    find "$root" -name 'ld-linux-*.so.*' | head -n 1
    echo --library-path
    find "$root/usr/lib" -maxdepth 1 -name '*-linux-gnu*' | paste -sd :
}
