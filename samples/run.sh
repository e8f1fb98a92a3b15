#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash samples/run.sh [SCENE]: installs what is missing, builds Plumb, runs the pile (or the scene named) and makes a
# replay, a picture, a recording and a summary of it in out/.
set -eu
here=$PWD
cd "$(dirname "$0")/.."
. cmake/setup.sh

# A name of samples/scenes, or a path from where the caller is.
wanted=${1:-pile}
case "$wanted" in /*) path=$wanted ;; *) path=$here/$wanted ;; esac
scene=samples/scenes/$wanted.json
[ ! -f "$path" ] || scene=$path
if [ ! -f "$scene" ]; then
  echo "samples/run.sh: there is no scene $wanted; those shipped: $(cd samples/scenes && ls *.json | sed 's/.json$//' | tr '\n' ' ')" >&2
  exit 2
fi

install_missing $build_packages
build release

name=$(basename "$scene" .json)
mkdir -p out
build/release/bin/plumb run "$scene" --out "out/$name.html" --out "out/$name.png" --out "out/$name.plumb" \
  --summary "out/$name.json"
echo
echo "replay   out/$name.html   (opens in any browser, from disk)"
echo "picture  out/$name.png"
echo "summary  out/$name.json"
echo "recording out/$name.plumb"
