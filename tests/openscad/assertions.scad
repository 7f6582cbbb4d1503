function f(x) = assert(x > 0, "must be positive") x;
module m(a) { echo(f(a)); }
assert(1 < 2);
assert(true, "fine") echo("inside");
echo(f(1));
m(-1);
echo("never");
