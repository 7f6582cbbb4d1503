assign(x = 5) cube(x);
module w() { child(0); child(); child(1); }
w() { cube(1); sphere(2); }
import_stl("a.stl");
