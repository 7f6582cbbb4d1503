use <ombre>
module ball() fgrade(["1"], ["white"]) sphere(5);
translate([1, 0, 0]) hull() {
  ball();
  translate([20, 0, 0]) ball();
}
