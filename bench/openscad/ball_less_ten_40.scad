// A ball less ten: the plainest boolean that takes OpenSCAD seconds.
$fn = 40;
difference() {
  sphere(10);
  for (n = [0 : 9]) translate([9 * cos(n * 126 / PI), 9 * sin(n * 126 / PI), n - 4.5]) sphere(3);
}
