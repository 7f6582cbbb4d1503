module m(x) { m(x + 1); }
m(0);
echo("after");
