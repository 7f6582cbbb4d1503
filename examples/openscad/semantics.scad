// What operators do with parts: a block cuts two parts, and a hole of one part spares the other.
module two_parts() {
  part("left") color("red") translate([-10, -5, 0]) cube([10, 10, 6]);
  part("right") color("blue") translate([0, -5, 0]) cube([10, 10, 6]);
}

// A block without a part acts on both parts: half of each is left.
intersection() {
  two_parts();
  translate([-5, -10, 0]) cube([10, 20, 10]);
}

// In strict semantics, what belongs to one part does not act on another.
translate([0, 16, 0]) difference(semantics = "strict") {
  two_parts();
  part("left") translate([0, 0, -1]) cylinder(h = 8, d = 6, $fn = 48);
}
