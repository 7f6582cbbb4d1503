// child() takes the first child for what is no number.
module shown() {
  child(undef);
  child(true);
  child("1");
  child([1]);
  child([1:2]);
  child(index = 1);
  child(1.7);
  child(-1);
  child(2);
}
shown() {
  cube(1);
  sphere(2);
}
shown();
