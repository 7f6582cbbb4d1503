x = 2;
if (1) { x = 9; echo(x); }
echo(x);
union() { x = 4; echo(x); cube(x); }
for (i = [1:2]) { z = i * 2; echo(z); }
module m() { echo(z); z = 4; echo(z); }
m();
b = c;
c = 3;
echo(b);
let (a = 3) { cube(a); sphere(a); }
let (a = 1, b = a + 1) echo(a, b);
{ echo(w); w = 8; }
echo(w);
