a = 1;
a = 2;
echo(a);
module e() { x = 1; y = x + 1; x = 5; echo(x, y); }
e();
union() { q = 1; q = 2; cube(q); }
a = 3;
