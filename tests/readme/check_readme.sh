#!/usr/bin/env bash
# Runs every `patchlight ...`, `curl ...` and `examples/block_city.sh ...` line of README's shell blocks,
# and solves the scene it shows. Charts are given 4 s instead of two minutes. `patchlight serve` runs until the end, on a port that is free.
# Usage: check_readme.sh README.md PATCHLIGHT
set -euo pipefail
readme=$(realpath "$1")
program=$(realpath "$2")
work=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill "$server"; rm -rf "$work"' EXIT
ln -s "$(dirname "$readme")/examples" "$work/examples"
cd "$work"
patchlight() { "$program" "$@"; }
curl() { command curl --fail --silent --show-error "$@"; }

serve() {
    "$program" "$@" --port 0 2>serve.log &
    server=$!
    for _ in $(seq 100); do
        address=$(sed -n 's/.*listening on http:\/\///p' serve.log)
        [ -z "$address" ] || return 0
        sleep 0.1
    done
    cat serve.log >&2
    return 1
}

run=0
while IFS= read -r line; do
    echo "+ $line"
    case $line in
        "patchlight serve"*) line=${line#patchlight} && eval "serve ${line%&}" </dev/null ;;
        "patchlight chart"*) # seconds enough to measure anything: sanitizers take many
            for limit in 4 60 240; do
                eval "$line --time-limit $limit" </dev/null >/dev/null && break
                [[ $limit != 240 ]]
            done ;;
        curl*) rm -f cornell.png && eval "${line//127.0.0.1:8080/$address}" </dev/null ;;
        *) eval "$line" </dev/null >/dev/null ;;
    esac
    run=$((run + 1))
done < <(awk '/^```sh/ {in_block = 1; next} /^```/ {in_block = 0} in_block' "$readme" |
    sed -n 's/^ *\(build\/release\/server\/\)\{0,1\}\(patchlight .*\|curl .*\|examples\/block_city.sh .*\)$/\2/p' | sed 's/ *#.*$//')
head -c 4 cornell.png | grep -q PNG

awk '/^```json/ {in_block = 1; next} /^```/ {in_block = 0} in_block' "$readme" >scene.json
patchlight solve scene.json --stats - >result.json
grep -q '"status": "converged"' result.json
[ "$run" -ge 5 ] || { echo "only $run commands were found in README" >&2; exit 1; }
