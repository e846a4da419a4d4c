#!/usr/bin/env bash
# Charts speed against accuracy of every method, on this machine, for the scenes that are named, or
# for three of the examples: about two minutes each, more if PATCHLIGHT_CHART_SECONDS says so.
# Nothing else should run meanwhile. A chart lies in examples/charts/SCENE/chart.html.
#   examples/charts.sh [SCENE...]
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/../.ci/setup.sh"

scenes=("$@")
[[ $# -gt 0 ]] || scenes=("$root"/examples/{cornell_box,grey_room,courtyard}.json)

build_release patchlight

mkdir -p "$root/examples/charts"
for scene in "${scenes[@]}"; do
    name=$(basename -- "$scene")
    name=${name%.*}
    say "charting $scene"
    "$build/release/server/patchlight" chart "$scene" --output "$root/examples/charts/$name" \
        --time-limit "${PATCHLIGHT_CHART_SECONDS:-120}" </dev/null
done
