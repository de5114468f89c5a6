#!/bin/sh
# Ten thousand homes, held into a broker and into PostgreSQL on this machine, and what the fleet says of itself: README.md beside this says how.
set -eu

homes="${HOMES:-10000}"
minutes="${MINUTES:-10}"
homebody="$(realpath "${HOMEBODY:-target/release/homebody}")"
scenario="$(realpath "${SCENARIO:-scenarios/tigerplace}")"
what="${1:-all}"
work="$(mktemp -d)"
chmod 755 "$work"
cd "$work"

postgres="$(ls -d /usr/lib/postgresql/*/bin 2>/dev/null | tail -n 1)"
PATH="$PATH:/usr/sbin:$postgres"
# No server of PostgreSQL runs as root.
as=""
if [ "$(id -u)" -eq 0 ]; then as="setpriv --reuid nobody --regid nogroup --clear-groups"; fi
broker=""
end() {
    [ -z "$broker" ] || kill "$broker" 2>/dev/null || true
    [ ! -d data ] || $as pg_ctl -D "$work/data" -m immediate stop >/dev/null 2>&1 || true
    cd /
    rm -rf "$work"
}
trap end EXIT INT TERM

# The fleet has one core, and its servers have the others, where there are any.
pinned=""
others=""
if command -v taskset >/dev/null && [ "$(nproc)" -gt 1 ]; then
    pinned="taskset -c 0"
    others="taskset -c 1-$(($(nproc) - 1))"
fi

fleet() {
    name="$1"
    shift
    printf '\n== %s: %s homes, %s min, %s cores\n' "$name" "$homes" "$minutes" "$(nproc)"
    $pinned "$homebody" fleet "$scenario" --homes "$homes" --for "${minutes}min" --report-every 60s --json "$@" >report.json
    printf '%s ' "$name"
    grep -E '^  "(messages|messages_per_s|late_median_ms|late_99_ms|late_most_ms|memory_mb|processors|storms|retries)"' report.json |
        tr -d '\n ' | tr ',' ' '
    printf '\n'
    cat report.json
}

if [ "$what" = all ] || [ "$what" = broker ]; then
    printf 'listener 18830 127.0.0.1\nallow_anonymous true\nset_tcp_nodelay true\npersistence false\nmax_queued_messages 0\n' >mosquitto.conf
    $others mosquitto -c mosquitto.conf >mosquitto.log 2>&1 &
    broker=$!
    sleep 1
    fleet calm --out 'mqtt://127.0.0.1:18830/calm?discovery=off'
    fleet storms --outages 'every 5min for 30s' --out 'mqtt://127.0.0.1:18830/storms?discovery=off'
fi

if [ "$what" = all ] || [ "$what" = postgresql ]; then
    mkdir data
    [ -z "$as" ] || chown nobody:nogroup data
    $as initdb -D "$work/data" -U ann -A trust -E UTF8 --locale C >initdb.log
    $others $as pg_ctl -D "$work/data" -o "-p 18831 -c listen_addresses=127.0.0.1 -c unix_socket_directories=" -l "$work/data/log" -w start >/dev/null
    createdb -h 127.0.0.1 -p 18831 -U ann homes
    fleet postgresql --out postgresql://ann@127.0.0.1:18831/homes
fi
