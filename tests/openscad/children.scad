module k() { children(1); children([0, 1]); children([0:1]); children([1, 0]); children(); for (i = [0:$children - 1]) children(i); children(7); }
k() { cube(1); sphere(2); }
k() { for (i = [1, 2]) cube(i); if (false) cube(); if (true) { cube(9); } }
module n() { if ($children > 0) children(); else cube(3); }
n();
n() sphere(1);
union() { union() { n(); } }
module o() { union() { children(0); } %children(0); #translate([1, 0, 0]) children(0); *cube(); }
o() { cube(); }
module wrong() { children("a"); children(-1); children(5); child(); }
wrong() { cube(1); sphere(2); }
children();
