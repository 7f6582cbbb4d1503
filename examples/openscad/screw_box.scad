// A box with a lid: both in their own material, with holes for four screws.
// The customizer's comments make sliders of the sizes.
// Try: -D width=60, or: ombre scad screw_box.scad -o "out-{part}.stl" for a file of each part.
/* [Size] */
width = 40;   // [20:100]
depth = 30;   // [20:100]
height = 18;  // [8:60]
wall = 2;     // [1:0.5:4]
screw = 2.5;  // [2:0.5:4]

$fn = 32;

module at_corners() for (x = [4, width - 4], y = [4, depth - 4]) translate([x, y, 0]) children();

part("box") material("gray") difference() {
  union() {
    difference() {
      cube([width, depth, height]);
      translate([wall, wall, wall]) cube([width - 2 * wall, depth - 2 * wall, height]);
    }
    at_corners() cylinder(r = 3.5, h = height);
  }
  translate([0, 0, height - 8]) at_corners() cylinder(d = screw, h = 9);
}

part("lid") material("blue") translate([0, 0, height + 8]) difference() {
  cube([width, depth, wall]);
  translate([0, 0, -1]) at_corners() cylinder(d = screw + 0.4, h = wall + 2);
}
