// A handle by hulls: from each ball to the next.
path = [[0, 0, 0], [0, 0, 12], [6, 0, 20], [18, 0, 24], [30, 0, 20], [36, 0, 12], [36, 0, 0]];
thickness = 5;

module ball(p) translate(p) sphere(d = thickness, $fn = 24);

material("red") for (n = [0 : len(path) - 2]) hull() { ball(path[n]); ball(path[n + 1]); }
material("gray") for (x = [0, 36]) translate([x, 0, -4]) difference() {
  cylinder(d = 14, h = 3, $fn = 48);
  translate([0, 0, -1]) cylinder(d = 3, h = 5, $fn = 24);
}
