// A model of parts: a housing and three lenses, each with its colour and its material.
module lens(z, colour) part(str("lens at ", z)) material(colour) translate([0, -5, z]) rotate([90, 0, 0]) cylinder(r = 4, h = 2, $fn = 48);

lens(26, "red");
lens(15, "yellow");
lens(4, "green");
part("housing") material("black") difference() {
  translate([-7, -5, -3]) cube([14, 8, 36]);
  for (z = [4, 15, 26]) translate([0, -2, z]) rotate([90, 0, 0]) cylinder(r = 3, h = 9, $fn = 48);
}
