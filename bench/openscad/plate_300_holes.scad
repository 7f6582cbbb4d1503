// A plate with 300 holes.
difference() {
  cube([80, 60, 3]);
  for (i = [0 : 19], j = [0 : 14]) translate([2 + 4 * i, 2 + 4 * j, -1]) cylinder(r = 1.5, h = 5, $fn = 30);
}
