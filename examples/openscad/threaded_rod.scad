// A threaded rod and its nut, made from children() of a module that cuts threads; as libraries do it.
// Try: -D pitch=1.5, or -D turns=4.
diameter = 10;
pitch = 2.5;
turns = 6;
steps = 24;

// A tooth that winds up around z: hulls of thin slices, one after the other.
module thread(d, pitch, turns) for (n = [0 : steps * turns - 1]) hull() for (k = [n, n + 1])
  rotate(360 * k / steps) translate([d / 2, 0, pitch * k / steps]) rotate([90, 0, 0]) linear_extrude(0.01) polygon([[-1.2, -pitch * 0.45], [0.4, -0.1], [0.4, 0.1], [-1.2, pitch * 0.45]]);

module tapped(d, pitch, turns) difference() {
  children();
  translate([0, 0, -1]) cylinder(d = d - 1, h = pitch * turns + 2, $fn = 48);
}

material("gray") intersection() {
  union() {
    cylinder(d = diameter - 2, h = pitch * turns, $fn = 48);
    thread(diameter - 1, pitch, turns);
  }
  cylinder(d = diameter + 2, h = pitch * turns);
}
material("red") translate([18, 0, 0]) tapped(diameter, pitch, 3) cylinder(d = 18, h = 7, $fn = 6);
