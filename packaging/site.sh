#!/usr/bin/env bash
# Builds the documentation as a site. See --help.
set -euo pipefail

usage() {
    cat <<'END'
Usage: packaging/site.sh

Builds target/site of the README, docs/, the docstrings of the Python package, the
notebooks, and the pages of Rust's crates where cargo doc has made them in
target/doc. A link or an anchor that leads nowhere ends it. What it needs of
Python is installed into target/site-python, in the versions that
packaging/site/requirements.txt names.

Notebooks are run, and shown with what comes of it, where the package's library is
there (CONTRIBUTING.md says how it is put there) and NOTEBOOKS is not "as written".
END
}

case "${1:-}" in
    "") ;;
    -h | --help)
        usage
        exit
        ;;
    *)
        usage >&2
        exit 2
        ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=target/site-python/bin/python
pages=target/site-pages

[ -x "$python" ] || python3 -m venv target/site-python
"$python" -m pip install -q --disable-pip-version-check -r packaging/site/requirements.txt
"$python" packaging/site/prepare.py . "$pages"

convert=(--to markdown --output-dir "$pages/python/notebooks" --log-level WARN)
if [ -e python/homebody/_homebody.abi3.so ] && [ "${NOTEBOOKS:-}" != "as written" ]; then
    "$python" -m pip install -q --disable-pip-version-check -r python/tests/requirements.txt
    convert+=(--execute)
else
    echo "site: notebooks are shown as they are written, without what comes of them"
fi
PYTHONPATH="$PWD/python" "$python" -m nbconvert "${convert[@]}" python/notebooks/*.ipynb

NO_MKDOCS_2_WARNING=1 "$python" -m mkdocs build --strict --config-file packaging/site/mkdocs.yml
[ ! -d target/doc ] || cp -r target/doc target/site/rust
echo "site: $(find target/site -name '*.html' -not -path 'target/site/rust/*' | wc -l) pages in target/site; begin with target/site/index.html"
