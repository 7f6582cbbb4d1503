rotate(45) cube(); rotate([10, 20, 30]) cube(); rotate(a = 45, v = [1, 1, 0]) cube(); rotate(90, [1, 2, 3]) cube(); rotate(120, [1, 1, 1]) cube();
rotate([90, 0, 0]) cube(); rotate([0, 180, 45]) cube(); rotate([90, 90, 90]) cube(); rotate([0, 0, 270]) cube(); rotate(-30) cube();
rotate("a") cube(); rotate([1, "a"]) cube(); rotate([1, 2, 3, 4]) cube(); rotate(a = [1, 2, 3], v = [1, 0, 0]) cube(); rotate(a = 45, v = "x") cube(); rotate(a = 45, v = [0, 0, 0]) cube(); rotate() cube();
rotate(180, [0, 0, 1]) cube(); rotate(a = 60, v = [1, 0, 0]) cube();
