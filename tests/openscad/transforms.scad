translate([1, 2, 3]) cube(); translate([1, 2]) cube(); translate() cube(); translate("a") cube(); translate([1, 2, 3, 4]) cube(); translate([1, "a"]) cube(); translate(5) cube();
scale(2) cube(); scale([1, 2]) cube(); scale([1, 2, 3]) cube(); scale("a") cube(); scale([1, 2, 3, 4]) cube(); scale([0, 1, 1]) cube();
mirror([1, 1, 0]) cube(); mirror([0, 0, 0]) cube(); mirror([1, 2]) cube(); mirror() cube(); mirror("a") cube(); mirror([1, 2, 3]) cube();
multmatrix([[1, 0, 0, 1], [0, 1, 0, 2]]) cube(); multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 2]]) cube(); multmatrix("a") cube(); multmatrix() cube();
translate([1, 2, 3]); translate([1, 0, 0]) { } translate([1, 0, 0]) { echo(1); }
translate([1, 2, 3]) { cube(); sphere(); }
