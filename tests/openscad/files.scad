import("x.stl");
import(file = "x.dxf", layer = "l", convexity = 3, origin = [1, 2], scale = 2);
import("x.svg", center = true, dpi = 96);
import("dir/x y.stl");
surface("x.dat");
surface(file = "x.png", center = true, invert = true, convexity = 5);
