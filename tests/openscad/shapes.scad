cube(); cube(3); cube([1, 2, 3]); cube([1, 2, 3], center = true); cube(size = 2, center = true); cube([1, 2]); cube("a"); cube([1, 2, "a"]); cube(-1); cube([0, 1, 1]);
sphere(); sphere(2); sphere(d = 5); sphere(r = 2, d = 3); sphere("a"); sphere(0); sphere(r = -1); sphere(r = [1]); sphere(1e-10);
cylinder(); cylinder(10, 1, 2); cylinder(h = 10, d = 3, center = true); cylinder(h = 10, d1 = 3, r2 = 1); cylinder(h = 2, r = 3);
cylinder(r = "a"); cylinder(h = -1); cylinder(h = 0); cylinder(h = "a"); cylinder(h = 1, r = 0); cylinder(r = 1, r1 = 2); cylinder(r = 3, d1 = 5); cylinder(r = 1, d = 5); cylinder(d1 = 3, d2 = 4, h = 1); cylinder(3, 4);
cube(1, 2, 3); cube(size = 1, size = 2); cube(foo = 3); sphere(1, 2);
cube(123456789);
