#!/bin/sh
# The second stage of packaging/Containerfile, built where no registry of images is reached: README.md beside this says how.
set -eu

homebody="$(realpath "${HOMEBODY:-target/release/homebody}")"
here="$PWD"
work="$(mktemp -d)"
trap 'buildah rm homebody-check base-check >/dev/null 2>&1 || true; rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot

debootstrap --variant=minbase bookworm "$work/rootfs" >"$work/debootstrap.log"
buildah from --name base-check scratch
buildah add -q base-check "$work/rootfs" /
buildah commit -q base-check docker.io/library/debian:bookworm-slim

# What the first stage leaves is there already.
mkdir -p "$work/context/source/target/release"
strip -o "$work/context/source/target/release/homebody" "$homebody"
cp -r "$here/scenarios" "$work/context/source/"
{
    printf 'FROM scratch AS build\nCOPY source /source\n'
    sed -n '/^FROM docker.io\/library\/debian/,$p' "$here/packaging/Containerfile"
} >"$work/Containerfile"
buildah bud --pull-never --network host --file "$work/Containerfile" --tag homebody "$work/context"

buildah from --pull-never --name homebody-check homebody
buildah run homebody-check -- /usr/bin/homebody doctor
buildah run homebody-check -- sh -ec '
    [ "$(id -u)" -eq 10001 ] && [ "$PWD" = /homes ]
    homebody run /usr/share/homebody/scenarios/tigerplace --for 7d --quiet
    homebody doctor runs/tigerplace-1'
