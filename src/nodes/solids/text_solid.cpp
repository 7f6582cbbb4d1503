// Solids of letters.
#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Letters {
  std::string text;
  double height = 10, depth = 2;
  MaterialName material;
  Choice style = "regular";
  FontName font{"DejaVu Sans", {}};
  Choice h_align = "center", v_align = "center";
  double line_spacing = 1;
  Choice measure = "capitals";
  program::SourceField outline;  // made with the node

  static Spec<Letters> spec() {
    return {
        "text",
        "Solid letters in XY, read from above, with half of their depth on each side of z = 0.",
        {{"text", &Letters::text, "The text; lines end with \\n", required()},
         {"height", &Letters::height, "Height of capital letters, or of what measure selects", unit::positive_mm},
         {"depth", &Letters::depth, "Thickness along z", unit::positive_mm},
         {"material", &Letters::material, "Its material"},
         {"style", &Letters::style, "Style of the font; a font without italics is slanted",
          one_of({"regular", "bold", "italic", "bold_italic"})},
         {"font", &Letters::font,
          "Name of an installed font, or path of a .ttf or .otf file; if it is missing, another font is used and a "
          "warning names it"},
         {"h_align", &Letters::h_align, "End of the lines that is at x = 0", one_of({"left", "center", "right"})},
         {"v_align", &Letters::v_align,
          "Position of y = 0: bottom (the foot of the last line), top (the top of the first line's capitals), center "
          "(midway between these two), or top_first_line (the foot of the first line)",
          one_of({"bottom", "center", "top", "top_first_line"})},
         {"line_spacing", &Letters::line_spacing, "Factor of the font's own distance from line to line", positive("")},
         {"measure", &Letters::measure,
          "Meaning of height: capitals (the letter H), em (the font's size), or letters (from the lowest point of all "
          "lines to "
          "the highest, which v_align means then)",
          one_of({"capitals", "em", "letters"})}},
        no_inputs,
        "text(\"B1\", 8, 2, \"red\", style=\"bold\");"};
  }

  bool makes_nothing() const { return text.find_first_not_of(" \t\r\n") == std::string::npos; }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("texts cannot be made here");
    TextRequest request{font, text, style, h_align, v_align, measure, height, line_spacing};
    outline = reader.loader->source(request, reader);
    font = request.font;
    return outline != nullptr;
  }

  Box bounds(const Box&) const {
    Box box = outline->bounds();
    box.lo.z = -depth / 2;
    box.hi.z = depth / 2;
    return box;
  }

  Field distance(const Point& p) const { return corner(ask("distance", p), beyond_ends(p)); }
  // Does not need distances, which makes it fast along rows of voxels.
  Field membership(const Inputs&, const Point& p, Border border) const {
    return logical_and(truth(ask("inside", p)), at_most(beyond_ends(p), 0, border));
  }

 private:
  Field beyond_ends(const Point& p) const { return abs(p.z) - depth / 2; }
  Field ask(const char* channel, const Point& p) const {
    const int number = outline->channel(channel);
    ASSERT(number >= 0);
    return p.builder().source(outline, number, p.x, p.y, p.constant(0));
  }
};

}  // namespace

void add_text(Registry& registry) { registry.add<Letters>("text"); }

}  // namespace ombre::nodes
