table = [[0, 10], [5, 20], [10, 0]];
echo([for (x = [-1, 0, 2.5, 5, 7, 10, 99]) lookup(x, table)]);
echo(lookup(0, [[1, 1], [2, 2]]), lookup(9, [[1, 1], [2, 2]]), lookup(1, 1), lookup(1, []), lookup(1, [1, 2]), lookup(1, [["a", 1], [2, 2]]));
echo(lookup("a", [[1, 1]]), lookup(undef, [[1, 2]]));
echo(lookup(2, [[3, 1], [1, 3]]), lookup(1.5, [[1, [1, 2]], [2, [3, 4]]]), lookup(5, [[1, 2]]), lookup(1.5, [[1, 1], ["a", 3], [2, 2]]));
