#!/usr/bin/env bash
# Builds what is given away, and checks each by installing it into an empty environment. Nothing is published. See --help.
set -euo pipefail

usage() {
    cat <<'END'
Usage: packaging/release.sh [FOLDER]

Builds into FOLDER (target/packages without it):

  homebody                     the program, stripped, which needs the C library
  homebody-static              the same with all that it needs, for any Linux
  homebody-VERSION-*.whl       the wheel for Python, with the program and its page
  homebody-VERSION.tar.gz      the source, from which pip builds the same wheel
  homebody_VERSION_*.deb       a package for Debian and Ubuntu

Each is then installed where nothing else is, and asked for its version and for a
short run: the wheels in new environments, the package unpacked into a new folder.
So is what cargo install makes of the checkout. The static program needs musl-gcc
and rustup's target for musl; without them it is left out, and that is said.

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

echo "== the static program"
musl="$(uname -m)-unknown-linux-musl"
if command -v musl-gcc >/dev/null && rustup target list --installed 2>/dev/null | grep -qx "$musl"; then
    cargo build --release --features all --target "$musl"
    strip -o "$to/homebody-static" "target/$musl/release/homebody"
    if ldd "$to/homebody-static" 2>&1 | grep -q '=>'; then
        echo "release: homebody-static needs libraries" >&2
        exit 1
    fi
    lives "$to/homebody-static"
else
    echo "left out: it needs musl-gcc (musl-tools) and rustup target add $musl"
fi

echo "== cargo install"
cargo install -q --path crates/homebody --features all --locked --root "$scratch/cargo" --target-dir target
lives "$scratch/cargo/bin/homebody"

# Whether a wheel that is installed alone in a new environment lives.
wheel_lives() {
    local wheel="$1" empty
    empty="$(mktemp -d "$scratch/empty.XXXX")"
    python3 -m venv "$empty"
    "$empty/bin/pip" install -q --no-index "$wheel"
    (cd "$scratch" && "$empty/bin/python" -c 'import homebody as hb; print(hb.scenario("studio").run(days=1, seed=7).events)')
    lives "$empty/bin/homebody"
}

echo "== the wheel"
python3 -m venv "$scratch/builds"
"$scratch/builds/bin/pip" wheel -q --no-deps --wheel-dir "$to" ./python
wheel_lives "$to"/homebody-"$version"-*.whl

echo "== the source for Python"
source="$scratch/homebody-$version"
git archive --prefix="homebody-$version/" HEAD | tar -x -C "$scratch"
# pip wants the description at the root of what it unpacks.
sed -e 's#"\.\./crates/#"crates/#' -e 's#^python-source = "\."#python-source = "python"#' -e 's#^readme = "#readme = "python/#' \
    python/pyproject.toml >"$source/pyproject.toml"
printf 'Metadata-Version: 2.1\nName: homebody\nVersion: %s\n' "$version" >"$source/PKG-INFO"
tar -czf "$to/homebody-$version.tar.gz" -C "$scratch" "homebody-$version"
CARGO_TARGET_DIR="$PWD/target" "$scratch/builds/bin/pip" wheel -q --no-deps --wheel-dir "$scratch/from-source" "$to/homebody-$version.tar.gz"
wheel_lives "$scratch"/from-source/homebody-"$version"-*.whl

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
