#!/bin/sh
# Draws icon.png and its small sizes: an arm about its axis, the arc that it sweeps, where it should
# be (a ring) and where it is (a disc). icon.svg is the same drawing. Small sizes are drawn with
# bolder lines, or nothing would be left of the ring. Needs ImageMagick.
set -eu
cd "$(dirname "$0")"

# The arc as short lines: some releases of ImageMagick close an open path.
arc=$(awk 'BEGIN {
    for (a = -89; a <= -1; a += 2) {
        r = a * 3.14159265 / 180
        x = 252 + 560 * cos(r); y = 772 + 560 * sin(r)
        if (a > -89) printf "line %.1f,%.1f %.1f,%.1f ", u, v, x, y
        u = x; v = y
    }
}')

# draw FILE PIXELS ARC ARM FOOT HAND RING RING_LINE: widths and radii on a field of 1024
draw() {
    convert -size 1024x1024 xc:none \
        -fill '#0B5F7A' -draw 'roundrectangle 32,32 992,992 210,210' \
        -fill none -stroke '#9FD3E0' -strokewidth "$3" \
        -draw "stroke-linecap round stroke-linejoin round $arc" \
        -stroke white -strokewidth "$4" -draw 'stroke-linecap round line 262,762 655,369' \
        -stroke none -fill white \
        -draw "circle 262,762 262,$((762 + $5))" -draw "circle 655,369 655,$((369 + $6))" \
        -stroke '#F2A65E' -strokewidth "$8" -fill '#0B5F7A' \
        -draw "circle 476,258 476,$((258 + $7))" \
        -resize "$2x$2" -strip "PNG32:$1"
}

draw icon.png 256 44 60 78 86 70 46
draw icon-48.png 48 56 76 90 100 84 62
draw icon-32.png 32 64 88 100 110 96 74
draw icon-16.png 16 84 110 110 124 116 110
