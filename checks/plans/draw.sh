#!/bin/sh
# Draws plans with Sweet Home 3D: those of homes/, those that it has as examples, or those of a folder.
#
# Usage: checks/plans/draw.sh TO homes|examples|FOLDER
#   TO  a new folder: TO/NAME.sh3d of each plan, as it is saved, and TO/NAME.LEVEL.png of each of its levels
set -eu

here=$(dirname "$0")
to=${1:?TO}
from=${2:?homes, examples or FOLDER}
mkdir "$to"

in_java() {
    xvfb-run --auto-servernum java -Djava.library.path=/usr/lib/jni --add-exports java.desktop/sun.awt=ALL-UNNAMED \
        --class-path "/usr/share/sweethome3d/sweethome3d.jar:/usr/share/java/*" "$@"
}

plans=$from
if [ "$from" = homes ] || [ "$from" = examples ]; then
    plans=$(mktemp -d)
    trap 'rm -r "$plans"' EXIT
    [ "$from" = homes ] && descriptions="$here/homes" || descriptions=--examples
    in_java "$here/Make.java" "$descriptions" "$plans"
fi
in_java "$here/Draw.java" "$plans" "$to"
