// A column whose star turns as it rises, and narrows.
points = 7;
module star(r, inner) polygon([for (n = [0 : 2 * points - 1]) let (a = 180 * n / points, d = n % 2 == 0 ? r : inner) d * [cos(a), sin(a)]]);

color("white") linear_extrude(height = 50, twist = 120, scale = 0.6, slices = 60) star(12, 8);
color("black") for (z = [-3, 50]) translate([0, 0, z]) cylinder(r = z < 0 ? 14 : 9, h = 3, $fn = 60);
