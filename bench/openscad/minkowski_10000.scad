// A rounded block: a sum of convex solids with some 10,000 facets.
minkowski() {
  cube([30, 20, 10]);
  sphere(2, $fn = 100);
}
