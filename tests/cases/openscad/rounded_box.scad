// arguments: --voxel 0.25
// Cylinders and balls on the edges of three boxes, whose union touches itself on the way. The volume of the facets is
// that of OpenSCAD 2021.01.
// expect volume red 22083.95 within 0.4%
// expect at (0, 0, 0): inside, red 1
module rounded(size, radius) {
  rot = [[0, 0, 0], [90, 0, 90], [90, 90, 0]];
  cube([size[0], size[1] - radius * 2, size[2] - radius * 2], center = true);
  cube([size[0] - radius * 2, size[1], size[2] - radius * 2], center = true);
  cube([size[0] - radius * 2, size[1] - radius * 2, size[2]], center = true);
  for (axis = [0:2])
    for (x = [radius - size[axis] / 2, -radius + size[axis] / 2],
         y = [radius - size[(axis + 1) % 3] / 2, -radius + size[(axis + 1) % 3] / 2])
      rotate(rot[axis]) translate([x, y, 0]) cylinder(h = size[(axis + 2) % 3] - 2 * radius, r = radius, center = true);
  for (x = [radius - size[0] / 2, -radius + size[0] / 2], y = [radius - size[1] / 2, -radius + size[1] / 2],
       z = [radius - size[2] / 2, -radius + size[2] / 2])
    translate([x, y, z]) sphere(radius);
}
rounded([20, 30, 40], 5);
