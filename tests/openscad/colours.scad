color([1, 0, 0]) cube(); color([1, 0, 0], 0.5) cube(); color("red", 0.5) cube(); color("#ff0000") cube(); color("#f00a") cube(); color("#ff000080") cube(); color(alpha = 0.5) cube();
color() cube(); color(5) cube(); color([1, 2]) cube(); color([2, 0, 0]) cube(); color("#12") cube(); color("nocolor") cube(); color("RED") cube(); color("DarkSlateGray") cube(); color("transparent") cube(); color([0.1, 0.2, 0.3, 0.4]) cube();
color("red") translate([0, 0, 1]) { cube(); }
