cube(1);
translate([1, 0, 0]) { !sphere(2); cube(3); }
cube(4);
