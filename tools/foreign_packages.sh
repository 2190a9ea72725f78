# Sourced by scripts that need Debian packages of another architecture, unpacked and not installed. They come from where
# this machine has its own; apt's own lists stay as they are, and no root is needed. The lists are kept in build/apt.

# foreign_open ARCHITECTURE: before the others. One script at a time does this for an architecture.
foreign_open() {
    foreign_state=$PWD/build/apt/$1
    mkdir -p "$foreign_state"
    exec 9>"$foreign_state/lock"
    flock 9
    rm -rf "$foreign_state/packages"
    mkdir -p "$foreign_state"/lists/partial "$foreign_state"/cache/archives/partial "$foreign_state"/packages
    touch "$foreign_state/status"
    foreign_sources >"$foreign_state/sources.list"
    foreign_settings=(
        -o APT::Architecture="$1" -o APT::Architectures="$1" -o APT::Sandbox::User= -o Acquire::Languages=none
        -o Acquire::Retries=3 -o Dir::State="$foreign_state" -o Dir::State::status="$foreign_state/status"
        -o Dir::Cache="$foreign_state/cache" -o Dir::Etc::sourcelist="$foreign_state/sources.list"
        -o Dir::Etc::sourceparts=-
    )
}

# This machine's own Debian sources, and the backports from the same place.
foreign_sources() {
    local release keyring=/usr/share/keyrings/debian-archive-keyring.gpg options=''
    release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    [[ ! -r $keyring ]] || options="[signed-by=$keyring] "
    apt-get indextargets --format '$(CREATED_BY) $(REPO_URI) $(RELEASE) $(COMPONENT)' | sort -u |
        awk -v release="$release" -v options="$options" '
            $1 != "Packages" { next }
            $3 == release || $3 == release "-updates" || $3 == release "-security" { print "deb " options $2, $3, $4 }
            $3 == release && $4 == "main" { print "deb " options $2, release "-backports", $4 }'
}

# A mirror that is being changed has lists that do not fit; the others will do.
foreign_update() {
    (cd "$foreign_state" && apt-get -q "${foreign_settings[@]}" update) >"$foreign_state/log" 2>&1 || true
}

# foreign_try PACKAGE...
foreign_try() {
    (cd "$foreign_state/packages" && apt-get -q "${foreign_settings[@]}" download "$@") >>"$foreign_state/log" 2>&1
}

# foreign_download PACKAGE[/RELEASE]...: into $foreign_state/packages. The lists are read anew if they are too old for it.
foreign_download() {
    : >"$foreign_state/log"
    foreign_try "$@" || { foreign_update; foreign_try "$@"; } || {
        tail -n 10 "$foreign_state/log" >&2
        return 1
    }
}

# foreign_source PACKAGE: its source with Debian's patches, in $foreign_state/packages/PACKAGE-VERSION. From then on there are
# sources only.
foreign_source() {
    local release
    release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    sed -i 's/^deb /deb-src /' "$foreign_state/sources.list"
    : >"$foreign_state/log"
    foreign_try_source "$1/$release" || { foreign_update; foreign_try_source "$1/$release"; } || {
        tail -n 10 "$foreign_state/log" >&2
        return 1
    }
}

foreign_try_source() {
    (cd "$foreign_state/packages" && apt-get -q "${foreign_settings[@]}" source "$1") >>"$foreign_state/log" 2>&1
}

# foreign_dependency PACKAGE: the first package that it depends on.
foreign_dependency() {
    apt-cache "${foreign_settings[@]}" depends --important "$1" 2>>"$foreign_state/log" |
        awk '$1 == "Depends:" { print $2; exit }'
}

# foreign_unpack PACKAGE FOLDER: of those that were downloaded.
foreign_unpack() {
    dpkg -x "$foreign_state"/packages/"$1"_*_*.deb "$2" && foreign_record "$foreign_state"/packages/"$1"_*_*.deb "$2"
}

# foreign_record FILE.deb FOLDER: writes down in FOLDER's dpkg database which package the unpacked files are of.
foreign_record() {
    local name database=$2/var/lib/dpkg
    mkdir -p "$database/info"
    name=$(dpkg-deb -f "$1" Package)
    [[ $(dpkg-deb -f "$1" Multi-Arch) != same ]] || name=$name:$(dpkg-deb -f "$1" Architecture)
    dpkg --fsys-tarfile "$1" | tar -t | sed -e 's,^\.,,' -e 's,/$,,' -e 's,^$,/.,' >"$database/info/$name.list"
    { dpkg-deb -f "$1" | sed '/^Package:/a Status: install ok installed'; echo; } >>"$database/status"
}

# foreign_record_source NAME FOLDER FILE...: the same of what was compiled of the unpacked source package in the current folder.
foreign_record_source() {
    local database=$2/var/lib/dpkg
    mkdir -p "$database/info" "$2/usr/share/doc/$1"
    cp debian/copyright "$2/usr/share/doc/$1/copyright"
    printf '%s\n' "${@:3}" >"$database/info/$1.list"
    printf '%s\n' "Package: $1" 'Status: install ok installed' 'Architecture: source' \
        "Maintainer: $(sed -n 's/^Maintainer: *//p' debian/control)" "Version: $(dpkg-parsechangelog -S Version)" '' >>"$database/status"
}
