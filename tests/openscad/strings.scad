echo(len(5), len(undef), len([1:3]), len("abc"), len([1, 2]), len(), len(1, 2));
echo(chr("a"), chr([65, 66]), chr([65:70]), chr(0), chr(65, 66), chr(-1), chr([65, "a"]), chr(1114112), chr(65.7), chr());
echo(ord(""), ord(5), ord("€"), ord("abc"), ord(), ord("a", "b"));
echo(concat(), concat(1), concat("a", [1]), concat([[1]], [[2]]), concat([1, 2], "a", [[3]]), concat(undef));
echo(is_undef(undef), is_bool(true), is_num(1), is_num(0 / 0), is_string("a"), is_list([]), is_list([1:2]), is_num("a"), is_bool(undef));
echo(is_undef(), is_undef(1, 2), is_num(), is_list("a", "b"));
echo(version(), version_num(), version_num([2019, 5, 1]), version_num("a"), version_num([1, 2]), version_num() > 20190500);
