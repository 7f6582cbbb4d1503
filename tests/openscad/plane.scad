square(); square(4); square([1, 2]); square([1, 2], center = true); square("a"); square([1, 2, 3]); square(-1); square([1, "a"]);
circle(); circle(3); circle(d = 3); circle(r = 2, d = 6); circle("a"); circle(-1); circle(1, 2);
polygon([[0, 0], [1, 0], [0, 1]]);
polygon(points = [[0, 0], [1, 0], [0, 1], [2, 2], [3, 2], [2, 3]], paths = [[0, 1, 2], [3, 4, 5]], convexity = 2);
polygon([[0.1, 1 / 3], [1e10, 0], [0, 1e-10]]);
text("hi");
text("hi", size = 5, font = "Liberation Sans:style=Bold", halign = "center", valign = "top", spacing = 1.2, direction = "rtl", language = "de", script = "latn", $fn = 9);
text("a\"b\\c"); text("a", size = "b"); text("a", halign = "foo"); text("x", 5, "f");
