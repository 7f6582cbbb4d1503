// Numbers that stand in a drawing.
for (name = ["wide", "tall", "slanted", "long", "corner"]) echo(name, dxf_dim(file = "measures.dxf", layer = "sizes", name = name));
for (name = ["bore", "round", "x_place", "y_place"]) echo(name, dxf_dim(file = "measures.dxf", name = name));
echo(scaled = dxf_dim(file = "measures.dxf", name = "long", scale = 2));
echo(cross = dxf_cross(file = "measures.dxf", layer = "marks"));
echo(moved = dxf_cross(file = "measures.dxf", layer = "marks", origin = [1, 2], scale = 3));
echo(parallel = dxf_cross(file = "measures.dxf", layer = "beside"));
echo(missing = dxf_dim(file = "measures.dxf", name = "none"));
echo(no_file = dxf_dim(file = "nowhere.dxf", name = "none"));
