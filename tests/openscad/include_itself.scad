// A file may include itself: once from the first file, and once more for each name that OpenSCAD takes for another one.
include <include_itself.scad>
include <../openscad/include_itself.scad>
include <../../tests/openscad/include_itself.scad>
include <./no_such_file.scad>
echo("read");
