// arguments: --voxel 0.5
// A cube of 20 from black at x = 0 to white at x = 20, with a hole of 4 x 4 through it along z; OpenSCAD's cube has a
// corner in the origin.
// expect volume total 20^3-4*4*20 exactly
// expect at (5, 5, 5): inside, white 0.25, black 0.75, distance -3*sqrt(2)
// expect at (15, 5, 5): inside, white 0.75, black 0.25
// expect at (10, 10, 10): outside, distance 2
use <ombre>
length = 20;
difference() {
  fgrade(probabilities=["x/length", "1 - x/length"], materials=["white", "black"]) cube(length);
  translate([8, 8, -1]) cube([4, 4, 30]);
}
