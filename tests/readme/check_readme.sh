#!/usr/bin/env bash
# Runs every `patchlight ...` line of README's shell blocks, and solves the scene it shows.
# Usage: check_readme.sh README.md PATCHLIGHT
set -euo pipefail
readme=$(realpath "$1")
program=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$(dirname "$readme")/examples" "$work/examples"
cd "$work"
patchlight() { "$program" "$@"; }

run=0
while IFS= read -r line; do
    echo "+ $line"
    eval "$line" </dev/null >/dev/null
    run=$((run + 1))
done < <(awk '/^```sh/ {in_block = 1; next} /^```/ {in_block = 0} in_block' "$readme" |
    sed -n 's/^ *\(build\/release\/server\/\)\{0,1\}\(patchlight .*\)$/\2/p' | sed 's/ *#.*$//')

awk '/^```json/ {in_block = 1; next} /^```/ {in_block = 0} in_block' "$readme" >scene.json
patchlight solve scene.json --stats - >result.json
grep -q '"status": "converged"' result.json
[ "$run" -ge 5 ] || { echo "only $run commands were found in README" >&2; exit 1; }
