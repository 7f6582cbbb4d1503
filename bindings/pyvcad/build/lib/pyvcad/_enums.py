"""Names of choices."""
from enum import Enum


class LatticeType(Enum):
    BodyCenteredCubic = 0
    FaceCenteredCubic = 1
    Cubic = 2
    KelvinCell = 3


class FontAspect(Enum):
    Regular = 0
    Bold = 1
    Italic = 2
    BoldItalic = 3


class HorizontalAlignment(Enum):
    Left = 0
    Center = 1
    Right = 2


class VerticalAlignment(Enum):
    Bottom = 0
    Center = 1
    Top = 2
    TopFirstLine = 3
