$fa = 0;
sphere();
$fs = 0;
cube();
circle(2, $fn = 5);
linear_extrude(1) circle();
