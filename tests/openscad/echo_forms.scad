echo(1, "a", [1, "b", undef, true], [0:2:10], function(x) x + 1);
echo(a = 1, "x", b = [1, 2]);
echo();
echo("q\"uo\\te", "tab\there", "nl\nx");
echo("\x41\u20ac\t\"\\");
echo(str(1.0, "a", [1, "b"], undef, true, [0:1]), str(), str([["x"]]), str([0.1, "q\"uote"]));
echo(1) echo(2) echo(3);
echo([[1, 2], "a", [undef]], [], [[]]);
