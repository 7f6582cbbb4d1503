// A plate with a name in another colour, flush with its face.
name = "Ombre";
size = 9;
depth = 1;

module letters() translate([0, 0, 3 - depth]) linear_extrude(depth) text(name, size, font = "DejaVu Sans:style=Bold", halign = "center", valign = "center");

color("yellow") letters();
color("black") difference() {
  linear_extrude(3) offset(3) square([50, 14], center = true);
  letters();
  for (x = [-24, 24]) translate([x, 0, -1]) cylinder(d = 3, h = 5, $fn = 24);
}
