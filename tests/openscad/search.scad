echo(search("a", "abab"), search("a", "abab", 1), search("a", "abab", 0), search("a", "abab", 2), search("ax", "abab"), search("x", "abab"), search("x", "abab", 0));
echo(search(1, [1, 2, 1]), search(1, [1, 2, 1], 0), search([1], [1, 2, 1]), search([1, 9], [1, 2, 1]), search([1, 9], [1, 2, 1], 0));
echo(search(3, [[1, 2], [3, 4], [3, 5]]), search(3, [[1, 2], [3, 4], [3, 5]], 0), search(4, [[1, 2], [3, 4]], 1, 1));
echo(search(["a", "b"], [["a", 1], ["b", 2], ["a", 3]]), search("abc", [["a", 1], ["b", 2], ["a", 3]], 0));
echo(search([3, 4], [[1, 2], [3, 4]]), search([[3, 4]], [[1, 2], [3, 4]]), search("zz", [["a", 1]]));
echo(search("a", ["a", "b"]));
echo(search("a", 5), search(undef, [1]), search(1));
echo(search("a", [["x", "a"], ["a", "y"]], 0, 1), search(1, [[0], [1]], 1, 5), search("€", "a€b"), search("ab", [["ab", 1]]), search(["ab"], [["ab", 1]]));
echo(search([1, "a", [2]], [1, "a", [2], [1, 5]]), search("ab", [["a"], ["x"], ["b"]], 0, 0));
