linear_extrude(10) square();
linear_extrude(height = 10, twist = 90, slices = 5, scale = 2, center = true, convexity = 4) square();
linear_extrude(height = 10, twist = 90, scale = [1, 2]) square();
linear_extrude(height = 10, twist = 90, $fn = 30) square();
linear_extrude(height = -10) square(); linear_extrude(0) square(); linear_extrude(height = 5, scale = -1) square(); linear_extrude(height = 5, scale = "a") square(); linear_extrude(height = 5, scale = [1, "a"]) square();
linear_extrude(5, twist = "a") square(); linear_extrude(height = 5, slices = 7) square();
rotate_extrude() square(); rotate_extrude(angle = 90, $fn = 7, convexity = 3) square(); rotate_extrude(angle = "a") square(); rotate_extrude(angle = 500) square(); rotate_extrude(angle = 0) square(); rotate_extrude(angle = -90) square();
