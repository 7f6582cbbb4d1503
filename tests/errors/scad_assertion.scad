size = -1;
assert(size > 0, "a size must be positive");
cube(size);
