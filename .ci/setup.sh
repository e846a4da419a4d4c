# Sourced by examples/run.sh, tests/run.sh and .ci/run: what they share, from a fresh Debian to a
# build in build/release. Needs bash; nothing is done until a function is called.

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
build=${PATCHLIGHT_BUILD_DIR:-$root/build}

packages=(g++ cmake ninja-build pkg-config libembree-dev libtbb-dev libeigen3-dev libopenimageio-dev
    libcpp-httplib-dev nlohmann-json3-dev libspdlog-dev libcli11-dev libssl-dev libgtest-dev
    curl gnuplot-nox)

say() { printf '\n== %s\n' "$*"; }

fail() {
    printf '%s: %s\n' "$0" "$*" >&2
    exit 1
}

# Installs those of the named packages that are missing, and asks nothing if none is.
install_packages() {
    command -v dpkg-query >/dev/null ||
        fail "this is no Debian; install what these packages hold, then use cmake: $*"
    local missing=() package
    for package in "$@"; do
        [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
            missing+=("$package")
    done
    [[ ${#missing[@]} -gt 0 ]] || return 0
    say "installing ${missing[*]}"
    local become=()
    if [[ $(id -u) != 0 ]]; then
        command -v sudo >/dev/null ||
            fail "neither root nor sudo; let root run: apt-get install -y --no-install-recommends ${missing[*]}"
        become=(sudo)
    fi
    "${become[@]}" apt-get -o DPkg::Lock::Timeout=300 update -q </dev/null ||
        echo "the package lists could not all be renewed; trying with those there are" >&2
    "${become[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get -o DPkg::Lock::Timeout=300 install -q -y --no-install-recommends \
        "${missing[@]}" </dev/null ||
        fail "apt-get could not install ${missing[*]}"
}

# As many compilers at a time as there are processors and memory for, at 1.5 GB each.
parallel_jobs() {
    local processors available
    processors=$(nproc)
    available=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo)
    ((available < processors)) && processors=$available
    echo $((processors > 0 ? processors : 1))
}

# configure DIRECTORY OPTION...: in build/, with Ninja. Warnings are errors with the compiler of
# Debian 12; a newer one may know more of them, which is no reason to fail on somebody's machine.
configure() {
    local directory=$build/$1 werror=OFF
    shift
    [[ $(g++ -dumpversion) == 12 ]] && werror=ON
    cmake -S "$root" -B "$directory" -G Ninja "-DPATCHLIGHT_WERROR=${PATCHLIGHT_WERROR:-$werror}" \
        "$@" >"$directory.log" 2>&1 </dev/null || {
        cat "$directory.log" >&2
        fail "cmake could not configure $directory"
    }
}

# compile DIRECTORY [TARGET...]
compile() {
    local directory=$build/$1
    shift
    cmake --build "$directory" -j "$(parallel_jobs)" ${1:+--target "$@"} </dev/null ||
        fail "the build in $directory failed"
}

# build_release [TARGET...]: set-up and Release build, the same for examples and tests, so that
# what one has compiled the other need not.
build_release() {
    install_packages "${packages[@]}"
    mkdir -p "$build"
    say "building in $build/release"
    configure release -DCMAKE_BUILD_TYPE=Release
    compile release "$@"
}
