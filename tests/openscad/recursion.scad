function count(n) = n == 0 ? "done" : count(n - 1);
echo(count(100000));
function depth(n) = n == 0 ? 0 : 1 + depth(n - 1);
echo(depth(2000));
module tree(n) { if (n > 0) { tree(n - 1); translate([n, 0, 0]) cube(); } }
tree(3);
