%cube(1);
#sphere(1);
*cylinder();
translate([1, 0, 0]) { %cube(2); #cube(3); }
difference() { cube(4); #translate([1, 1, 1]) %sphere(2); }
module m() { %cube(5); }
#m();
%for (i = [1, 2]) cube(i);
#if (true) cube();
