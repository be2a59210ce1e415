#!/usr/bin/env bash
# Builds Kinora and renders the walking character: 24 frames and a contact sheet.
set -euo pipefail
cd "$(dirname "$0")"
scripts/build release:programs
out=build/demo
mkdir -p "$out"
build/release/bin/kinora-render assets/scenes/walker.dae --frames 1-24 --size 640x360 --quality preview \
    --overwrite --contact-sheet "$out/walker-sheet.png" -o "$out/walker.####.png"
echo "kinora: the frames are in $PWD/$out, all of them on one sheet: $PWD/$out/walker-sheet.png"
