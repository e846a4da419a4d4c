#!/usr/bin/env bash
# Installs the Debian packages that are missing (as root or with sudo), builds Patchlight, lights
# the Cornell box, and says where the picture and the result are.
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/../.ci/setup.sh"

build_release patchlight

say "solving examples/cornell_box.json"
patchlight=$build/release/server/patchlight
scene=$root/examples/cornell_box.json
picture=$build/cornell_box.png
result=$build/cornell_box.json
"$patchlight" solve "$scene" --image "$picture" --stats "$result" </dev/null
"$patchlight" solve "$scene" </dev/null # without outputs it prints a summary

say "done"
echo "picture: $picture"
echo "result:  $result"
