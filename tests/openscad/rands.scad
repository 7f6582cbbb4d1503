echo(rands(0, 1, 3, 42), rands(1, 5, 2, 7), rands(0, 1, 3, 1), rands(1, 0, 2, 1), rands(0, 0, 2, 3), rands(0, 10, 0, 1), rands(0, 1, 2.9, 5));
echo(rands(-10, 10, 4, 12345), rands(0, 1, 2, -1), rands(0, 1, -2, 1), rands(0, 1, 2, 0));
echo(rands(), rands(0, 1), rands(0, 1, 2, "a"), rands(0, "a", 1), rands(0, 1, undef), len(rands(0, 1, 5)));
echo(rands(0, 1 / 0, 2, 1));
// A seed begins the stream anew, and calls without one go on from there.
echo(rands(0, 1, 2, 3), rands(0, 1, 2), rands(0, 1, 1), rands(0, 10, 2, 3), rands(0, 1, 1));
