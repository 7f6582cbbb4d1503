square(4);
