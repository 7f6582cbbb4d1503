// arguments: --voxel 0.5
// Values that vary in space are OpenSCAD's values too: the distance to a ball of 4 around the origin, and what is
// computed with it. 8^3 of a block, green where it is within 4 mm of the centre; nothing is left where a loop gives nothing.
// expect volume total 512 exactly
// expect at (3, 0, 0): inside, green 1
// expect at (3.9, 3.9, 3.9): inside, yellow 1
use <ombre>
d = distance_to(ombre_sphere(4));
near = d < 0 ? 1 : 0;
fgrade([near, 1 - near], ["green", "yellow"]) cube(8, center = true);
gaussian(sigma = 1) for (i = []) cube(i);
