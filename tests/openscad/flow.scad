if (true) cube();
if (false) cube();
if (false) cube(); else sphere();
if (false) cube(); else if (true) sphere(); else cube(2);
if (false) cube(); else if (false) sphere();
for (i = [1, 2]) cube(i);
for (i = []) cube(i);
for (i = [1, 2], j = [3, 4]) { cube([i, j, 1]); }
for (i = [1:3]) for (j = [i:3]) translate([i, j, 0]) cube();
echo("with child") cube();
assert(true) cube();
let (a = 3) cube(a);
if (undef) echo("no"); else echo("yes");
if ("") echo("no"); else if (1) echo("elif");
;
{ }
{ cube(); sphere(); }
