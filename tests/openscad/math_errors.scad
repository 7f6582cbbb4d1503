echo(abs("a"), sin("a"), abs(1, 2), abs());
echo(min(), min(1, "a"), min([]), min([1, 2], 3), max(undef), min("a", "b"));
echo(norm([1, "a"]), norm(), norm(1, 2));
echo(cross(1, 2), cross([1, 2, 3], [1, 2]), cross([1, 2, 3], [1, 2, "a"]), cross([1, 2, 1 / 0], [1, 2, 3]), cross());
echo(sign("a"), pow(1), pow("a", 1), exp(), atan2(1), atan2("a", 1), round([1]), log(), log("a"), ln("a"), floor("a"));
