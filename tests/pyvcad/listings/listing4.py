import pyvcad as pv
materials = pv.default_materials()

# Parameters
sphere_radius = 10
cell_size = pv.Vec3(5,5,5)
cell_type = pv.LatticeType.BodyCenteredCubic
strut_dia = 0.35

# Create a unit cell (BCC lattice)
cell_bcc = pv.GraphLattice(cell_type, cell_size, strut_dia,
                           materials.id("gray"))

# Tile the unit cell to fill space
lattice_fill = pv.Tile(cell_bcc)

# Create bounding geometry (sphere)
sphere = pv.Sphere(pv.Vec3(0,0,0), sphere_radius)

# Intersection of lattice with bounding sphere
filled_sphere = pv.Intersection(False, [lattice_fill, sphere])
root = filled_sphere
