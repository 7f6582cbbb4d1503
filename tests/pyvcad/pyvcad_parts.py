"""Small parts that several files of tests ask."""
import pyvcad as pv

red, green, blue, gray = (pv.default_materials.id(name) for name in ("red", "green", "blue", "gray"))
origin = pv.Vec3(0, 0, 0)


def ball(radius=10.0, material=1):
    return pv.Sphere(origin, radius, material)


def graded_bar():
    """Blue at x = -10, red at x = 10."""
    return pv.FGrade(["0.5 + x/20", "0.5 - x/20"], [red, blue], True, pv.RectPrism(origin, pv.Vec3(20, 4, 4), gray))
