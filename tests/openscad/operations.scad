union() { cube(); sphere(); }
union();
difference() { cube(); { sphere(); cube(2); } }
intersection() { cube(); *sphere(); %cube(2); #cube(3); }
hull() cube();
minkowski() { cube(); sphere(1); }
minkowski(convexity = 3) { cube(); sphere(1); }
render() cube();
render(convexity = 4) { cube(); sphere(); }
group() cube();
intersection_for (i = [1, 2]) cube(i);
intersection_for (i = [1, 2], j = [1, 2]) cube([i, j, 1]);
resize([1, 2, 3], auto = true) cube(); resize([1, 2, 0], auto = [true, false]) cube(); resize("a") cube(); resize() cube(); resize([1, "a"]) cube(); resize([1, 2, 3], auto = "a") cube();
offset(r = 3) square(); offset(delta = 3) square(); offset(delta = 3, chamfer = true) square(); offset(3) square(); offset() square(); offset(r = "a") square(); offset(r = 1, delta = 2) square();
projection() cube(); projection(cut = true, convexity = 3) cube(); projection(cut = "a") cube();
