// It has a module, and nobody calls it.
module lid() cube(4);
