include <MCAD/units.scad>
use <MCAD/regular_shapes.scad>
use <MCAD/boxes.scad>
use <MCAD/nuts_and_bolts.scad>
echo(mm, inch);
roundedBox([10, 20, 30], 2, false);
hexagon(4);
nutHole(3);
