function f(x) = let (y = 1) assert(x > 2) x;
function g(x) = 1 + f(x);
y = [for (i = [1:3]) g(i)];
cube(y[0]);
