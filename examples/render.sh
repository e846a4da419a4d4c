#!/usr/bin/env bash
# Posts a scene to a running `patchlight serve` and keeps the picture:
#   examples/render.sh [SCENE.json [PICTURE.png|.exr|RESULT.json]]
# PATCHLIGHT_URL says where it runs, PATCHLIGHT_TOKEN what it wants to be shown.
set -euo pipefail
scene=${1:-$(dirname -- "${BASH_SOURCE[0]}")/cornell_box.json}
output=${2:-$(basename "$scene" .json).png}
case $output in
    *.exr) accept=image/x-exr ;;
    *.json) accept=application/json ;;
    *) accept=image/png ;;
esac
token=()
[[ -z ${PATCHLIGHT_TOKEN:-} ]] || token=(-H "Authorization: Bearer $PATCHLIGHT_TOKEN")

answer=$(mktemp)
trap 'rm -f "$answer"' EXIT
status=$(curl -sS -o "$answer" -w '%{http_code}' "${token[@]}" -H "Accept: $accept" \
    -H 'Content-Type: application/json' --data-binary "@$scene" \
    "${PATCHLIGHT_URL:-http://127.0.0.1:8080}/v1/render")
if [[ $status != 200 ]]; then
    cat "$answer" >&2
    exit 1
fi
cp "$answer" "$output"
echo "$output"
