#!/usr/bin/env bash
# Draws examples/pictures/NAME.png for every example, and the pictures of the documents; writes docs/user/examples.md.
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

# Options of `ombre render`.
declare -A options=(
  [auxetic_insole]="--from -50,35"
  [beam_lattice]="--from -30,25"
  [folded_tube]="--from -30,25"
  [helmet_liner]="--from 120,25"
  [changing_cells]="--from -25,25"
  [joined_lattices]="--from -25,25"
  [calibration_sheet]="--from -20,55"
  [graded_wing]="--from -20,35"
  [ink_target]="--from -15,60"
  [painted_ball]="--from -45,25"
  [keychain]="--from -20,50"
  [knob]="--cut x=0 --from -50,20"
  [sharpened_scan]="--view top"
  [soft_actuator]="--from -50,15"
  [seat]="--from -35,30"
  [unit_cells]="--from -15,50"
  [orthosis]="--by modulus --legend --palette plasma --from 30,30"
  [soft_hinge]="--by modulus --legend --palette plasma --from -25,50"
  [shoe_sole]="--by color_rgb --from -20,50"
  [value_nodes]="--from 0,90"
  [wood]="--from -20,35"
  [turned_handle]="--cut z=12 --from -50,35"
  [tuned_grip]="--by modulus --cut y=0 --legend --palette plasma --from -30,30"
)

# Designs of Ombre, and scripts of OpenSCAD in a folder of their own.
design() { [ -f "examples/$1.vcad" ] && echo "examples/$1.vcad" || echo "examples/openscad/$1.scad"; }

# render NAME PICTURE SIZE [OPTION ...]
render() {
  local name=$1 picture=$2 size=$3
  shift 3
  "$ombre" render "$(design "$name")" -o "$picture" --size "$size" --force --quiet "$@"
  echo "$picture"
}

# Coarser voxels than the design's own show single ones, and make small files.
# draw_layers NAME PICTURE COUNT [OPTION OF `ombre slice` ...]
draw_layers() {
  local name=$1 picture=$2 count=$3
  shift 3
  rm -rf "$scratch/job"
  "$ombre" slice "examples/$name.vcad" -o "$scratch/job" --quiet "$@"
  "$ombre" sheet --force "$scratch/job" -o "$picture" --count "$count" --quiet
  echo "$picture"
}

# What an example's first lines say of it, and its picture.
describe() {
  printf '\n## [%s](../../%s)\n\n' "$1" "$(design "$1")"
  sed -n '/^\/\//!q; s/^\/\/ \?//; s/[*<]/\\&/g; s/^\(From\|After\|Try\):/\n&/; p' "$(design "$1")"
  printf '\n![%s](../../examples/pictures/%s.png)\n' "$1" "$1"
}

# The bodies of a gear's bands, one above the other.
draw_bands() {
  "$ombre" mesh examples/gear.vcad --bands 3 --by green -o "$scratch/gear.3mf" --force --quiet
  cat >"$scratch/bands.vcad" <<'DESIGN'
translate(0, 0, 24) mesh("gear.3mf", blue, object="green below 33.33 %");
translate(0, 0, 12) mesh("gear.3mf", cyan, object="green 33.33 to 66.67 %");
mesh("gear.3mf", green, object="green from 66.67 %");
DESIGN
  "$ombre" render "$scratch/bands.vcad" -o "$1" --size 480x400 --from -50,30 --force --quiet
  echo "$1"
}

# A layer of a knob beside a design with a thinner skin.
draw_difference() {
  "$ombre" slice examples/knob.vcad --voxel 0.2 -o "$scratch/knob" --force --quiet
  "$ombre" verify "$scratch/knob" --design examples/knob.vcad -D skin=2 --report "$scratch/knob.html" --force >/dev/null || true
  grep -o 'base64,[^"]*' "$scratch/knob.html" | sed -n 's/base64,//; 9p' | base64 -d >docs/user/checking_layer.png
  echo docs/user/checking_layer.png
  cat >"$scratch/box.vcad" <<'END'
union() {
  difference() {
    rectprism((20, 12, 8), "clear");
    translate(7.9, 0, 0) rectprism((0.15, 9, 20), "clear");
  }
  translate(0, 0, 5) rectprism((16, 0.15, 3), "clear");
}
END
  "$ombre" check "$scratch/box.vcad" --voxel 0.05 --details 0.21 --report "$scratch/check.html" >/dev/null || true
  grep -o 'base64,[^"]*' "$scratch/check.html" | sed -n 's/base64,//; 2p' | base64 -d >docs/user/checking_thin.png
  echo docs/user/checking_thin.png
}

# A seat solved soft, and graded by what moved.
draw_seat() {
  local study=examples/studies/rider.json
  "$ombre" fea examples/seat.vcad --study "$study" --cell 4 --solve --tolerance 1e-5 -o "$scratch/soft.vtu" --force --quiet
  "$ombre" render "$scratch/soft.vtu" --by displacement --deform 5 --legend --from -35,30 --size 640x400 \
    -o docs/user/seat_moved.png --force --quiet
  echo docs/user/seat_moved.png
  render seat docs/user/seat_graded.png 640x400 -D "moved=$scratch/soft.vtu" --from -35,30
  render seat docs/user/seat_slice.png 640x260 -D "moved=$scratch/soft.vtu" --slice y=0
}

mkdir -p examples/pictures
for file in examples/*.vcad examples/openscad/*.scad; do
  name=$(basename "${file%.*}")
  if [[ $# -gt 0 && " $* " != *" $name "* ]]; then continue; fi
  read -ra chosen <<<"${options[$name]:-}"
  render "$name" "examples/pictures/$name.png" 640x480 "${chosen[@]}"
done
if [[ $# -eq 0 || " $* " == *" docs "* ]]; then
  {
    printf '# Examples\n\nWhat their first lines say, and pictures by `ombre render`. tools/make_pictures.sh writes this page.\n'
    for file in examples/*.vcad; do describe "$(basename "$file" .vcad)"; done
    printf '\n# OpenSCAD scripts\n\nDesigns as they are usual there; [openscad.md](openscad.md) says what Ombre does with them.\n'
    for file in examples/openscad/*.scad; do describe "$(basename "$file" .scad)"; done
  } >docs/user/examples.md
  echo docs/user/examples.md
  render graded_wing docs/hero.png 1000x360 --from -20,35 --aa 3
  render gear docs/user/picture_labels.png 480x320 --annotate
  render traffic_light docs/user/picture_names.png 480x360 --by parts --outlines parts --names parts --legend
  render knob docs/user/picture_slice.png 480x320 --slice x=0 --annotate
  render mug docs/user/picture_perspective.png 480x320 --perspective 70 --from 40,35
  render knob docs/user/picture_translucent.png 480x320 --opacity magenta=0.1
  render soft_actuator docs/user/picture_box.png 480x320 --box=-2,-2,-1,0,2,1 --background "#203040"
  draw_bands docs/user/mesh_bands.png
  draw_layers graded_wing docs/user/wing_layers.png 6 --layers 18:48
  draw_layers knob docs/user/knob_layers.png 8 --voxel 0.2
  draw_difference
  draw_seat
fi
