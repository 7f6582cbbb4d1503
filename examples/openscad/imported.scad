// A drawing and a mesh from files: a plate cut after an SVG, and a tetrahedron on it.
plate = 3;
color("lightgray") linear_extrude(plate) difference() {
  offset(4) import("plate.svg", center = true);
  import("plate.svg", center = true);
}
color("red") translate([0, 0, plate]) scale(4) import("pyramid.off");
