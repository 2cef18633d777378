#!/bin/sh
# Draws icon.png: an arm about its axis, the arc that it sweeps, where it should be (a ring) and
# where it is (a disc). Needs ImageMagick.
set -eu
cd "$(dirname "$0")"
convert -size 1024x1024 xc:none \
    -fill '#0B5F7A' -draw 'roundrectangle 32,32 992,992 210,210' \
    -fill none -stroke '#9FD3E0' -strokewidth 44 \
    -draw 'stroke-linecap round path "M 262,212 A 560,560 0 0 1 812,762"' \
    -stroke white -strokewidth 60 -draw 'stroke-linecap round path "M 262,762 L 655,369"' \
    -stroke none -fill white -draw 'circle 262,762 262,840' -draw 'circle 655,369 655,455' \
    -stroke '#F2A65E' -strokewidth 46 -fill '#0B5F7A' -draw 'circle 476,258 476,328' \
    -resize 256x256 -strip PNG32:icon.png
