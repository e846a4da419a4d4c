#!/bin/sh
# Prints a scene: a city of square blocks on a square of ground, every facet a quad of its own, as
# urban-climate models need view factors of. Heights follow a fixed pattern.
#   examples/block_city.sh [BLOCKS_ALONG_AN_EDGE] > city.json
# 30, the default, gives about 22000 facets; 10 gives 2500.
set -eu
blocks=${1:-30}
case $blocks in
    *[!0-9]* | '' | 0*) echo "$0: BLOCKS_ALONG_AN_EDGE must be a whole number from 1 on, not '$blocks'" >&2; exit 2 ;;
esac
awk -v n="$blocks" '
function vertex(x, y, z) { printf "%s[%g,%g,%g]", (count++ ? "," : ""), x, y, z }
# A quad from a corner and two edges, u x v out of its front, cut into nu x nv facets.
function quad(x, y, z, ux, uy, uz, vx, vy, vz, nu, nv,   i, j, first) {
    first = count
    for (j = 0; j <= nv; j++) for (i = 0; i <= nu; i++)
        vertex(x + ux*i/nu + vx*j/nv, y + uy*i/nu + vy*j/nv, z + uz*i/nu + vz*j/nv)
    for (j = 0; j < nv; j++) for (i = 0; i < nu; i++) {
        q = first + j*(nu+1) + i
        faces = faces (faces == "" ? "" : ",") "[" q "," q+1 "," q+nu+2 "," q+nu+1 "]"
    }
}
function begin(name) { printf "%s\n  {\"name\": \"%s\", \"material\": \"facade\", \"mesh\": {\"vertices\": [", (objects++ ? "," : ""), name; count = 0; faces = "" }
function end() { printf "],\n   \"faces\": [%s]}}", faces }
BEGIN {
    print "{\"version\": 1,\n \"materials\": {\"facade\": {\"reflectance\": 0.3, \"exitance\": 1}},"
    printf " \"objects\": ["
    pitch = 20; side = 12; gap = pitch - side
    begin("ground")
    for (b = 0; b < n; b++) {
        quad(0, b*pitch, 0, n*pitch, 0, 0, 0, gap, 0, 2*n, 1)                      # streets along x
        for (a = 0; a < n; a++)
            quad(a*pitch, b*pitch + gap, 0, gap, 0, 0, 0, side, 0, 1, 2)           # and between blocks
    }
    end()
    for (b = 0; b < n; b++) for (a = 0; a < n; a++) {
        h = 8 + 4 * ((7*a + 11*b + a*b) % 6)
        x = a*pitch + gap; y = b*pitch + gap
        begin("block-" a "-" b)
        quad(x, y, 0,  side, 0, 0,  0, 0, h,  2, 2)
        quad(x + side, y, 0,  0, side, 0,  0, 0, h,  2, 2)
        quad(x + side, y + side, 0,  -side, 0, 0,  0, 0, h,  2, 2)
        quad(x, y + side, 0,  0, -side, 0,  0, 0, h,  2, 2)
        quad(x, y, h,  side, 0, 0,  0, side, 0,  2, 2)
        end()
    }
    print "],\n \"solve\": {\"patch_size\": 20}}"
}'
