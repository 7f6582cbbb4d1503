material("PLA") cube(4);
