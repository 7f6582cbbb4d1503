import pyvcad as pv
materials = pv.default_materials()

# Parameters
center_point = pv.Vec3(0, 0, 0) # At origin
dimensions = pv.Vec3(10,10,10) # In mm
# Create a Rectangular Prism
root = pv.RectPrism(center_point, dimensions,
                    materials.id("red"))
