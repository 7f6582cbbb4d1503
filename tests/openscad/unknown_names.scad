x = y;
echo(x);
echo(foo(1));
bar(1);
bar() cube();
echo(PI, is_undef(q), is_undef($q), is_undef(qq[1]));
echo($foo, $children, $parent_modules);
