// arguments: --voxel 0.5 -D size=6
// A script as a design: its parts are the design's. -D takes the place of a variable.
// expect volume red 216 exactly
// expect volume blue 216 exactly
// expect at (2, 2, 2): inside, red 1, distance -2, part first
// expect at (12, 2, 2): inside, blue 1, distance -2, part second
size = 4;
part("first") material("red") cube(size);
part("second") material("blue") translate([10, 0, 0]) cube(size);
