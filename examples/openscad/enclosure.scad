// A rounded enclosure: a box and a ball, added by minkowski(), hollowed, with slots for air.
size = [30, 20, 10];
rounding = 3;
wall = 1.5;

module rounded(size, r) minkowski() { cube(size, center = true); sphere(r, $fn = 20); }

color("gray") difference() {
  rounded(size, rounding);
  rounded(size, rounding - wall);
  translate([0, 0, 20]) cube(40, center = true);
  for (x = [-9:3:9]) translate([x, 0, -8]) cube([1.2, 14, 8], center = true);
}
