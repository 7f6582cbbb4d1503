// a comment
/* another
   one */
2d = 3;
echo(2d);
1e = 4;
echo(1e, 1e3);
$special_9 = 1;
echo($special_9, "a
b");
x=1;y=2;echo(x,y);echo(x-y,x--y,-x- -y,!!x);
echo("\z\q");
a_b = 1; _c = 2; echo(a_b, _c);
echo(trueish, undefined);
