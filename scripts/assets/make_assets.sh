#!/bin/sh
# scripts/assets/make_assets.sh: makes again what assets/scenes holds that no hand wrote.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
scenes=$here/../../assets/scenes
shaders=$here/../../assets/shaders/scenes

python3 "$here/make_tintoy.py" "$shaders" "$scenes/tintoy.dae"
python3 "$here/make_court.py" "$shaders/.." "$scenes/court.dae"
python3 "$here/make_layers.py" "$scenes/layers.dae"
python3 "$here/make_attach.py" "$scenes/attach.dae"
python3 "$here/make_atelier.py" "$scenes/atelier.dae"
python3 "$here/make_studio.py" "$scenes/studio.dae"

if ! command -v blender >/dev/null; then
    echo "walker.dae needs Blender 3.4 and its numpy: " \
        "apt-get install -y --no-install-recommends blender python3-numpy" >&2
    exit 1
fi
raw=$(mktemp --suffix=.dae)
trap 'rm -f "$raw"' EXIT
blender --background --python-exit-code 1 --python "$here/make_walker.py" -- "$raw" >/dev/null
python3 "$here/add_rsl.py" "$raw" "$shaders" "$scenes/walker.dae"
ls -l "$scenes"
