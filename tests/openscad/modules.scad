module m(a, b = 2) { echo(a, b, $children, parent_module(0)); children(); }
m(1, 2, 3) cube();
m(1, a = 3) cube();
m(1, d = 4) sphere();
module n(x = $fn, $fn = 7) { echo(x, $fn); sphere(); children(); }
n() sphere();
n($fn = 3) sphere();
n($zz = 4) echo($zz);
module outer() { module inner() { echo("inner", w); } w = 3; inner(); }
outer();
inner();
module empty() { }
empty();
empty() cube();
module twice() { cube(); }
module twice() { sphere(); }
twice();
