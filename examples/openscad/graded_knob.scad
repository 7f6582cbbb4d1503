// Ombre's words in a script of OpenSCAD: a knob that is hard at its shaft and soft at its rim, with a gyroid inside.
// Try: ombre slice graded_knob.scad --printer j750, or: ombre scad graded_knob.scad -o "{part}.stl"
use <ombre>

radius = 18;   // [10 : 40]
height = 14;   // [8 : 30]
grips = 9;     // [3 : 15]

module outline() {
  difference() {
    circle(radius, $fn = 90);
    for (n = [0 : grips - 1]) rotate(360 * n / grips) translate([radius + 2, 0]) circle(4.5, $fn = 40);
  }
}

module body() linear_extrude(height) offset(1) offset(-1) outline();
module shaft() cylinder(d = 6, h = 3 * height, center = true, $fn = 6);

// 0 on the axis, 1 at the rim.
softness = ramp(coordinates().rho, 5, radius);

part("knob") difference() {
  fgrade([1 - softness, softness], ["blue", "yellow"]) body();
  shaft();
  translate([0, 0, height - 4]) cylinder(r = radius - 5, h = 10, $fn = 60);
}

part("infill") intersection() {
  tpms("gyroid", cell = [5, 5, 5], thickness = 0.9, material = "clear");
  translate([0, 0, height - 4]) difference() {
    cylinder(r = radius - 5, h = 3, $fn = 60);
    shaft();
  }
}
