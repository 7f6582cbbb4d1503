module a() { for (i = [1]) if (true) union() { assert(false); } }
a();
