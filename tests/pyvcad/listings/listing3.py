import pyvcad as pv
def create_calibration_sheet(s, count_x, count_y,
                           thickness, materials):
    # center the whole sheet around the origin
    w = s * count_x
    h = s * count_y
    union = pv.Union()
    for i in range(count_x):
        for j in range(count_y):
            # compute volume fractions
            c_frac = i / (count_x - 1)
            m_frac = j / (count_y - 1)
            w_frac = 1.0 - (c_frac + m_frac)
            fractions = [f"{c_frac:.3f}",
                        f"{m_frac:.3f}",
                        f"{w_frac:.3f}"]

            # compute the center of this swatch
            x_pos = -w/2 + s/2 + i * s
            y_pos = -h/2 + s/2 + j * s
            center = pv.Vec3(x_pos, y_pos, 0)

            size = pv.Vec3(s, s, thickness)
            base = pv.RectPrism(center, size)
            graded = pv.FGrade(fractions, materials,
                              True, base)
            union.add_child(graded)
    return union

# Load some materials
mats = pv.default_materials()
root = create_calibration_sheet(
    s = 25, # swatch size (mm)
    count_x = 12, # subdivisions
    count_y = 12,
    thickness = 10, # mm plate thickness
    materials = [mats.id("cyan"), mats.id("magenta"),
                 mats.id("white")]
)
