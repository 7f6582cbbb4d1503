import pyvcad as pv
materials = pv.default_materials()

inp_path = "bike_seat_new.inp"
point_map_path = "bike_seat_point_map.csv"
expressions = ["(len-0.000055)/0.00035",
               "-(len-0.000055)/0.00035+1"]
materials = [materials.id("blue"),
             materials.id("green")]

root = pv.SimulationField(inp_path, point_map_path,
                          expressions, materials)
