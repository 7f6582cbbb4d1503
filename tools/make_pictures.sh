#!/usr/bin/env bash
# Draws examples/pictures/NAME.png for every example, and docs/hero.png. The same program draws the
# same bytes on every machine.
#
#   tools/make_pictures.sh PATH_OF_OMBRE [NAME ...]
set -euo pipefail

if [[ $# -lt 1 ]]; then
  echo "usage: tools/make_pictures.sh PATH_OF_OMBRE [NAME ...]" >&2
  exit 1
fi
ombre=$(realpath "$1")
shift
cd "$(dirname "$0")/.."
export OMBRE_DATA=$PWD
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Layers on the sheet, and options of `ombre slice`. Rows of tiles are full with 2, 3, 6, 8 or 15 of them.
# Coarser voxels than the design's own show single ones, and make small files.
declare -A options=(
  [calibration_sheet]="2 --voxel 0.25"
  [cone_and_sphere]="8 --voxel 0.2"
  [gear]="3 --voxel 0.3"
  [graded_cube]="3 --voxel 0.2"
  [graded_wing]="8"
  [knob]="8 --voxel 0.2"
  [mug]="8 --voxel 0.6"
  [overlap]="8"
  [parametric_hook]="8 --voxel 0.2"
  [soft_actuator]="8"
  [tensile_bar_prob]="2"
  [tensile_bar_thresh]="2"
  [tetrahedron]="8 --voxel 0.2"
)

# draw NAME PICTURE COUNT [OPTION ...]
draw() {
  local name=$1 picture=$2 count=$3
  shift 3
  rm -rf "$scratch/job"
  "$ombre" slice "examples/$name.vcad" -o "$scratch/job" --quiet "$@"
  "$ombre" sheet --force "$scratch/job" -o "$picture" --count "$count" --quiet
  echo "$picture"
}

mkdir -p examples/pictures
for file in examples/*.vcad; do
  name=$(basename "$file" .vcad)
  if [[ $# -gt 0 && " $* " != *" $name "* ]]; then continue; fi
  read -ra chosen <<<"${options[$name]:-8}"
  draw "$name" "examples/pictures/$name.png" "${chosen[@]}"
done
if [[ $# -eq 0 || " $* " == *" hero "* ]]; then draw graded_wing docs/hero.png 6 --layers 18:48; fi
