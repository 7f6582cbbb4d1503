// arguments: --voxel 0.5
// A word of one solid works on each part, here a shift by 1. Parts of 10 x 10 x 10 overlap in a half.
// expect volume total 1500 exactly
// expect at (2, 5, 1): inside, white 0.2, black 0.8, part a
// expect at (12, 5, 1): inside, white 1, part b
// expect at (5, 5, 10.5): inside, white 0.5, black 0.5, part a, part b
use <ombre>
module both() {
  part("a") cube(10);
  part("b") translate([5, 0, 0]) cube(10);
}
fgrade(["x/10", "1 - x/10"], ["white", "black"]) ombre_translate([0, 0, 1]) both();
