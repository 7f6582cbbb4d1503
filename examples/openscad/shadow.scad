// A solid, and what projection() makes of it: its shadow, and the cut through its middle.
module bracket() difference() {
  union() { cube([24, 16, 4]); cube([4, 16, 20]); }
  translate([14, 8, -1]) cylinder(r = 4, h = 6, $fn = 40);
  translate([-1, 8, 13]) rotate([0, 90, 0]) cylinder(r = 3, h = 6, $fn = 40);
}

color("gray") bracket();
color("black") translate([32, 0, 0]) linear_extrude(0.8) projection() bracket();
color("red") translate([0, 22, 0]) linear_extrude(0.8) projection(cut = true) translate([0, 0, -2]) bracket();
