// arguments: --voxel 0.5
// OpenSCAD's cube has a corner in the origin, Ombre's its centre: 10^3 and 4^3, of which 2^3 are in both. The outermost
// material counts.
// expect volume red 1000+64-8 exactly
// expect at (-1, -1, -1): inside, red 1
// expect at (9, 9, 9): inside, red 1
use <ombre>
material("red") ombre_union() {
  material("blue") cube(10);
  ombre_cube(4, "green");
}
