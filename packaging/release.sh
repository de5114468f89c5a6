#!/usr/bin/env bash
# Builds what is given away, and checks each by installing it into an empty environment. Nothing is published. See --help.
set -euo pipefail

usage() {
    cat <<'END'
Usage: packaging/release.sh [FOLDER]

Builds into FOLDER (target/packages without it): the wheel for Python, the program,
stripped, as a file of its own, and a package for Debian and Ubuntu. Each is then
installed where nothing else is, and asked for its version and for a short run: the
wheel in a new environment, the package unpacked into a new folder.

The checkout must have no changes that are not committed, unless ANYWAY=1.
END
}

case "${1:-}" in
    -h | --help)
        usage
        exit
        ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ -n "${ANYWAY:-}" ] || [ -z "$(git status --porcelain)" ] || {
    echo "release: there are changes that are not committed" >&2
    exit 1
}
to="$(realpath -m "${1:-target/packages}")"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$to"
version="$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)"

# Whether a program that has just been installed lives.
lives() {
    local program="$1" scenario="$PWD/scenarios/studio"
    "$program" --version
    (cd "$scratch" && rm -rf runs && "$program" run "$scenario" --for 1d --quiet && test -s runs/studio-1/log.txt)
}

echo "== the program"
cargo build --release --features all
strip -o "$to/homebody" target/release/homebody
ls -l "$to/homebody"
lives "$to/homebody"

echo "== the wheel"
python3 -m venv "$scratch/builds"
"$scratch/builds/bin/pip" wheel -q --no-deps --wheel-dir "$to" ./python
python3 -m venv "$scratch/empty"
"$scratch/empty/bin/pip" install -q --no-index "$to"/homebody-"$version"-*.whl
(cd "$scratch" && empty/bin/python -c 'import homebody as hb; print(hb.scenario("studio").run(days=1, seed=7).events)')
lives "$scratch/empty/bin/homebody"

if command -v dpkg-deb >/dev/null; then
    echo "== the package of Debian"
    package="$scratch/homebody_$version"
    mkdir -p "$package/DEBIAN" "$package/usr/bin" "$package/usr/share/doc/homebody"
    cp "$to/homebody" "$package/usr/bin/"
    cp LICENSE-MIT LICENSE-APACHE CHANGELOG.md "$package/usr/share/doc/homebody/"
    # What the program was linked with.
    libc="$(ldd --version | head -n 1 | grep -oE '[0-9]+\.[0-9]+$')"
    cat >"$package/DEBIAN/control" <<END
Package: homebody
Version: $version
Architecture: $(dpkg --print-architecture)
Maintainer: The Homebody authors <homebody@localhost>
Depends: libc6 (>= $libc), libgcc-s1
Section: science
Priority: optional
Description: simulates homes wired with sensors and the people who live in them
 For eldercare: logs as real homes write them, with the truth apart.
END
    dpkg-deb --root-owner-group --build "$package" "$to" >/dev/null
    dpkg-deb --extract "$to"/homebody_"$version"_*.deb "$scratch/installed"
    lives "$scratch/installed/usr/bin/homebody"
fi
ls -l "$to"
