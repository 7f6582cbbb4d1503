echo([for (i = [1:3]) i], [for (i = [0:3]) if (i % 2 == 0) i else -i], [for (i = 0, j = 1; i < 3; i = i + 1, j = j * 2) [i, j]]);
echo([each [1, 2], each [3:5], each "ab", each 3, each undef]);
echo([for (i = [1:2]) let (k = i * 2) k], [for (i = [0:1], j = [0:1]) [i, j]], [for (c = "abc") c]);
echo([for (a = [1, 2]) for (b = [3, 4]) a * b], [if (true) 1, if (false) 2, if (false) 3 else 4]);
echo([for (i = [0:3]) each [i, i * i]], [1, 2, 3, ], len([1, 2, ]));
echo([for (i = 5) i], [for (i = undef) i], [for (i = true) i]);
echo([for (i = [1:2]) for (j = [1:i]) if (i == j) [i, j]]);
echo([for (x = [[1, 2], [3, 4]]) each x], [let (a = 1) a, (for (i = [0:1]) i)]);
