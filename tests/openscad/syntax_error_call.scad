cube();
sphere(;
