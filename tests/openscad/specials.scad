function r() = $x;
$x = 7;
echo(r());
echo(let ($x = 8) r());
module s() { echo($x); }
s($x = 9);
translate([0, 0, 0], $x = 10) s();
union() { $x = 11; s(); }
for ($x = [1, 2]) s();
echo([for ($x = [1, 2]) r()]);
echo($fn, $fa, $fs, $t, $preview);
module a() { echo($parent_modules, parent_module(0), parent_module(1)); b(); }
module b() { echo($parent_modules, parent_module(0), parent_module(1), $children); }
a();
sphere(1, $fn = 5);
$fn = 9;
sphere(2);
cylinder(h = 1, r = 1, $fa = 30, $fs = 0.5);
