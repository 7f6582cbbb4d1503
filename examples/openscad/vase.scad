// A vase: a profile turned by rotate_extrude(), its rim in another material.
height = 60;
function radius(z) = 14 + 6 * sin(z * 5) - z / 12;
wall = 1.6;
outside = [for (z = [0 : 2 : height]) [radius(z), z]];
inside = [for (z = [height : -2 : 2]) [radius(z) - wall, z]];

material("cyan") rotate_extrude($fn = 72) polygon(concat([[0, 0]], outside, inside, [[0, 2]]));
material("magenta") translate([0, 0, height]) rotate_extrude($fn = 72) translate([radius(height) - wall / 2, 0]) circle(1.4, $fn = 16);
