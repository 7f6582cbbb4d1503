translate([0, 0, 1] cube(4);
