// Tests of texts as polygons: areas against the font's curves, positions against its metrics.
#include "draw/text_outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "draw/font_files.h"
#include "draw/font_search.h"

#ifdef OMBRE_TEXT
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#endif

namespace ombre::draw {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class Texts : public testing::Test {
 protected:
  void SetUp() override {
    const auto file = find_font_file();
    if (!can_outline_text() || !file || !is_usual(*file)) GTEST_SKIP() << "without HarfBuzz, or DejaVu Sans";
    font_ = bytes_of(*file);
  }
  TextOutlines outlined(const std::string& text, const TextLayout& layout = {}) const {
    return *outline_text(font_, 0, text, layout);
  }
  std::string font_;
};

struct Extent {
  Vec2 lo{1e9, 1e9}, hi{-1e9, -1e9};
};

Extent extent_of(const std::vector<Ring>& rings) {
  Extent e;
  for (const Ring& ring : rings)
    for (const Vec2 p : ring) {
      e.lo = {std::min(e.lo.x, p.x), std::min(e.lo.y, p.y)};
      e.hi = {std::max(e.hi.x, p.x), std::max(e.hi.y, p.y)};
    }
  return e;
}

double area_of(const std::vector<Ring>& rings) {
  double sum = 0;
  for (const Ring& ring : rings) sum += doubled_area(ring) / 2;
  return std::abs(sum);
}

#ifdef OMBRE_TEXT
// The area enclosed by curves, as the integral of x dy - y dx along each in closed form.
struct CurveArea {
  double area = 0;
  FT_Vector at{};

  static CurveArea& of(void* user) { return *static_cast<CurveArea*>(user); }
  static double cross_of(const FT_Vector& a, const FT_Vector& b) {
    return static_cast<double>(a.x) * static_cast<double>(b.y) - static_cast<double>(a.y) * static_cast<double>(b.x);
  }
  static int move(const FT_Vector* to, void* user) {
    of(user).at = *to;
    return 0;
  }
  static int line(const FT_Vector* to, void* user) {
    of(user).area += cross_of(of(user).at, *to) / 2;
    of(user).at = *to;
    return 0;
  }
  static int conic(const FT_Vector* by, const FT_Vector* to, void* user) {
    const FT_Vector from = of(user).at;
    of(user).area += (2 * cross_of(from, *by) + 2 * cross_of(*by, *to) + cross_of(from, *to)) / 6;
    of(user).at = *to;
    return 0;
  }
  // used by other fonts only
  static int cubic(const FT_Vector*, const FT_Vector*, const FT_Vector*, void*) { return 1; }
};

double curve_area(const std::string& font, uint32_t letter) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  FT_Init_FreeType(&library);
  FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(font.data()), static_cast<FT_Long>(font.size()), 0,
                     &face);
  FT_Load_Glyph(face, FT_Get_Char_Index(face, letter), FT_LOAD_NO_SCALE);
  CurveArea sum;
  const FT_Outline_Funcs calls{CurveArea::move, CurveArea::line, CurveArea::conic, CurveArea::cubic, 0, 0};
  EXPECT_EQ(FT_Outline_Decompose(&face->glyph->outline, &calls, &sum), 0);
  FT_Done_Face(face);
  FT_Done_FreeType(library);
  return std::abs(sum.area);
}
#endif

}  // namespace

#ifdef OMBRE_TEXT
TEST_F(Texts, HaveTheAreaOfTheirCurves) {
  TextLayout layout;
  layout.measure = TextMeasure::em;
  layout.height_mm = 20;
  const double scale = 20.0 / 2048;  // DejaVu Sans has 2048 units in an em
  for (const char letter : std::string("OB%gS8")) {
    const double expected = curve_area(font_, static_cast<uint32_t>(letter)) * scale * scale;
    const auto rings = outlined(std::string(1, letter), layout).rings;
    EXPECT_NEAR(area_of(rings), expected, 2e-3 * expected) << letter;
    const size_t count = letter == '%' ? 5 : letter == 'B' || letter == '8' ? 3 : letter == 'S' ? 1 : 2;
    EXPECT_EQ(rings.size(), count) << letter;
  }
}
#endif

// The letter I of DejaVu Sans is a bar of 202 x 1493 units.
TEST_F(Texts, CapitalsHaveTheHeight) {
  const auto text = outlined("I");
  ASSERT_EQ(text.rings.size(), 1u);
  const Extent e = extent_of(text.rings);
  EXPECT_NEAR(e.hi.y - e.lo.y, 10, 1e-9);
  EXPECT_NEAR(e.hi.x - e.lo.x, 10 * 202.0 / 1493, 1e-9);
  EXPECT_NEAR(e.hi.y, 5, 1e-9);
  TextLayout em;
  em.measure = TextMeasure::em;
  const Extent f = extent_of(outlined("I", em).rings);
  EXPECT_NEAR(f.hi.y - f.lo.y, 10 * 1493.0 / 2048, 1e-9);
}

// An H stands on its line and is 1493 units high; lines are 2384 apart. The g of the last line reaches below its line.
TEST_F(Texts, AllLinesTogetherHaveTheHeight) {
  TextLayout layout;
  layout.measure = TextMeasure::letters;
  const auto extent = [&](const char* words, TextLevel level) {
    layout.level = level;
    return extent_of(outlined(words, layout).rings);
  };
  for (const char* words : {"H", "HI\nH", "H\ng", "a.\n\ng"}) {
    for (const auto& [level, low] :
         {std::pair(TextLevel::bottom, 0.0), {TextLevel::center, -5.0}, {TextLevel::top, -10.0}}) {
      const Extent e = extent(words, level);
      EXPECT_NEAR(e.lo.y, low, 1e-9) << words;
      EXPECT_NEAR(e.hi.y, low + 10, 1e-9) << words;
    }
  }
  const Extent first = extent("H\nH", TextLevel::first_line);
  EXPECT_NEAR(first.hi.y, 10 * 1493.0 / (1493 + 2384), 1e-9);
  EXPECT_NEAR(first.lo.y, -10 * 2384.0 / (1493 + 2384), 1e-9);
}

TEST_F(Texts, StandWhereTheyShould) {
  const auto extent = [&](TextSide side, TextLevel level) {
    TextLayout layout;
    layout.side = side;
    layout.level = level;
    return extent_of(outlined("HI\nH", layout).rings);
  };
  EXPECT_GT(extent(TextSide::left, TextLevel::center).lo.x, 0);
  EXPECT_LT(extent(TextSide::right, TextLevel::center).hi.x, 0);
  EXPECT_NEAR(extent(TextSide::left, TextLevel::bottom).lo.y, 0, 1e-9);
  EXPECT_NEAR(extent(TextSide::left, TextLevel::top).hi.y, 0, 1e-9);
  EXPECT_NEAR(extent(TextSide::left, TextLevel::first_line).hi.y, 10, 1e-9);
  const Extent middle = extent(TextSide::center, TextLevel::center);
  EXPECT_NEAR(middle.lo.y, -middle.hi.y, 1e-9);
  // The font's table has a line distance of 2384 units.
  EXPECT_NEAR(middle.hi.y - middle.lo.y, 10 + 10 * 2384.0 / 1493, 1e-9);
  TextLayout wide;
  wide.line_spacing = 2;
  const Extent apart = extent_of(outlined("H\nH", wide).rings);
  EXPECT_NEAR(apart.hi.y - apart.lo.y, 10 + 20 * 2384.0 / 1493, 1e-9);
}

TEST_F(Texts, AreShaped) {
  // Kerning moves A and V closer together than their widths.
  const auto width = [&](const std::string& text) {
    const Extent e = extent_of(outlined(text).rings);
    return e.hi.x - e.lo.x;
  };
  EXPECT_LT(width("AVA"), width("A") + width("V") + width("A") - 1);
  // Letters with combining marks equal the precomposed letters.
  EXPECT_EQ(outlined("a\u0308").rings, outlined("\u00e4").rings);
  // Arabic letters change their form when joined: "beh beh" is not twice the single letter.
  EXPECT_NE(outlined("\u0628\u0628").rings.size(), 0u);
  EXPECT_GT(std::abs(area_of(outlined("\u0628\u0628").rings) - 2 * area_of(outlined("\u0628").rings)), 1);
}

// The areas and places that OpenSCAD 2021.01 writes for letters of size 1000 with $fn=8. It hints letters: without
// that, areas differ by 1e-4 and more.
TEST_F(Texts, RunsAreHintedAsInOpenscad) {
  const auto run = [&](const std::string& text, RunLayout layout) {
    layout.em_mm = 1000 * 100.0 / 72;
    layout.chords_per_curve = 2;
    return outline_run(font_, 0, text, layout)->rings;
  };
  EXPECT_NEAR(area_of(run("B", {})), 390335.82, 1);
  EXPECT_NEAR(area_of(run("%", {})), 371318.64, 1);
  EXPECT_NEAR(area_of(run("o", {})), 241078.88, 1);
  const auto expect_extent = [&](const RunLayout& layout, const Extent& expected) {
    constexpr double digits = 0.02;
    const Extent e = extent_of(run("AgV.", layout));
    EXPECT_NEAR(e.lo.x, expected.lo.x, digits);
    EXPECT_NEAR(e.lo.y, expected.lo.y, digits);
    EXPECT_NEAR(e.hi.x, expected.hi.x, digits);
    EXPECT_NEAR(e.hi.y, expected.hi.y, digits);
  };
  RunLayout layout;
  layout.spacing = 1.3;
  expect_extent(layout, {{10.85, -288.64}, {3595.93, 1012.48}});
  layout.spacing = 1;
  layout.side = TextSide::center;
  layout.level = TextLevel::top;
  expect_extent(layout, {{-1475.62, -1277.39}, {1346.92, 23.73}});
  layout.side = TextSide::right;
  layout.level = TextLevel::center;
  expect_extent(layout, {{-2962.09, -642.077}, {-139.553, 659.042}});
  layout.side = TextSide::left;
  layout.level = TextLevel::bottom;
  expect_extent(layout, {{10.85, -6.765}, {2833.39, 1294.35}});
}

TEST_F(Texts, TellWhatIsMissing) {
  EXPECT_TRUE(outlined("Größe Ω µ").missing.empty());
  const auto text = outlined("a\xF0\xB0\x80\x80 \xF0\xB0\x80\x80");  // no usual font has this ideograph
  EXPECT_EQ(text.missing, (std::vector<std::string>{"\xF0\xB0\x80\x80"}));
  EXPECT_TRUE(outlined(" \n\t").rings.empty());
  for (const char* bytes : {"\xFF\xFE", "\xC3", "a\xE2\x82", ""}) outlined(bytes);
}

TEST_F(Texts, SlantWhatHasNoItalics) {
  TextLayout layout;
  layout.slant = 0.2;
  const auto plain = outlined("B"), slanted = outlined("B", layout);
  EXPECT_NEAR(area_of(plain.rings), area_of(slanted.rings), 1e-9);
  const Extent e = extent_of(plain.rings), f = extent_of(slanted.rings);
  EXPECT_NEAR((f.hi.x - f.lo.x) - (e.hi.x - e.lo.x), 2, 1);
}

TEST_F(Texts, KeepToTheFont) {
  EXPECT_FALSE(outline_text("no font", 0, "A", {}));
  EXPECT_FALSE(outline_text("", 0, "A", {}));
}

TEST_F(Texts, FindFontsByName) {
  const auto found = search_font("dejavu sans", false, false);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->has_name);
  EXPECT_TRUE(is_usual(found->file)) << found->file;
  EXPECT_FALSE(found->is_bold);
  EXPECT_TRUE(search_font("DejaVu Sans", true, false)->is_bold);
  EXPECT_FALSE(search_font("No Such Font at All", false, false)->has_name);
}

}  // namespace ombre::draw
