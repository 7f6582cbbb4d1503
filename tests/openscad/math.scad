echo(sin(0), sin(30), sin(90), sin(180), sin(360), sin(45), sin(-30), sin(1e10));
echo(cos(0), cos(60), cos(90), cos(180), cos(270), cos(45));
echo(tan(0), tan(45), tan(90), tan(180), tan(135));
echo(asin(0.5), asin(2), acos(0.5), acos(-0.5), atan(1), atan(-1), atan2(0, 0), atan2(1, 1), atan2(1, -1));
echo(round(2.5), round(-2.5), floor(-1.5), ceil(1.2), sign(-3), sign(0), exp(1), log(100), log(2, 8), ln(2), pow(2, 0.5), sqrt(4), sqrt(-1), ln(0));
echo(abs(-3), min(1), min([3, 1, 2]), max(1, 5, 2), max(["a", "b"]), max([true]), min([[1, 2], [0, 5]]), max([1, "a"]));
echo(norm([]), norm("a"), norm([3, 4, 12]));
