#!/bin/sh
# Runs a command with a Node.js and an npm that can build and test the page: the system's, or, where they are too old, those that
# the system's npm installs into the build folder.
set -eu

# From npm's packages of both. Exactly these versions, so that all who need them get the same.
version=24.21.0
npm_version=11.19.1

# As "engines" in package.json, which is what the page's packages have in common.
suffices='const [major, minor] = process.versions.node.split(".").map(Number);
process.exit(major >= 24 || (major === 22 && minor >= 13) || (major === 20 && minor >= 19) ? 0 : 1)'

[ $# -gt 0 ] || {
    echo "Usage: sh with-node.sh COMMAND [ARGUMENT...]" >&2
    exit 2
}

die() {
    echo "with-node: $*" >&2
    exit 1
}

install_node() {
    found="$(node -p 'process.version')"
    machine="$(node -p 'process.platform + "-" + process.arch')"
    case "$machine" in
        linux-x64 | linux-arm64) ;;
        *) die "please install Node.js 24 or later: $found is too old for the page" ;;
    esac
    echo "with-node: Node.js $found is too old for the page; npm installs $version into $kept" >&2
    mkdir -p "$(dirname "$kept")"
    # It gets its name once it is whole. Whoever comes second leaves the first one's as it is.
    part="$(mktemp -d "$kept.XXXXXX")"
    trap 'rm -rf "$part"' EXIT
    npm install --prefix "$part" --no-audit --no-fund --loglevel=error "node-$machine@$version" "npm@$npm_version" >&2 ||
        die "npm cannot install Node.js $version, and $found is too old for the page"
    mv -T "$part" "$kept" 2>/dev/null || [ -d "$kept" ] || die "$kept cannot be written"
    rm -rf "$part"
}

{ command -v node && command -v npm; } >/dev/null || die "please install npm, which comes with Node.js"
if ! node -e "$suffices"; then
    case "${CARGO_TARGET_DIR:-}" in
        /*) kept="$CARGO_TARGET_DIR/node-$version" ;;
        *) kept="$(cd "$(dirname "$0")/.." && pwd)/target/node-$version" ;;
    esac
    [ -d "$kept" ] || install_node
    export PATH="$kept/node_modules/.bin:$PATH"
    node -e "$suffices" || die "Node.js $version in $kept does not run on this machine"
fi
exec "$@"
