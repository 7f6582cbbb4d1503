import pyvcad as pv
materials = pv.default_materials()

# Parameters
dimensions = pv.Vec3(15,10,5) # in mm
center = pv.Vec3(0,0,0)
# Create a gray bar
bar = pv.RectPrism(center, dimensions, materials.id("gray"))
# Apply a red to blue gradient
expressions = [f"x/{dimensions.x}+0.5",
               f"-x/{dimensions.x}+0.5"]
materials = [materials.id("red"),
             materials.id("blue")]
root = pv.FGrade(expressions, materials, True, bar)
