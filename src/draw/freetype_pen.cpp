// The pen by FreeType: outlines of letters, and its rasterizer for all filled shapes.
#include "draw/pen.h"

#ifdef OMBRE_FREETYPE

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/text/error.h"
#include "base/text/utf8.h"
#include "draw/font_files.h"

namespace ombre::draw {
namespace {

constexpr double units = 64;        // FreeType's units per pixel
constexpr double farthest = 30000;  // pixels; the limit of its 32-bit rasterizer

// Blends a colour over a pixel. Fully transparent pixels have no colour of their own.
void lay_over(uint8_t* pixel, Rgb colour, unsigned cover) {
  const unsigned below = pixel[3] * (255 - cover), alpha = cover * 255 + below;
  if (alpha == 0) return;
  for (size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<uint8_t>((colour[i] * cover * 255 + pixel[i] * below + alpha / 2) / alpha);
  pixel[3] = static_cast<uint8_t>((alpha + 127) / 255);
}

struct Ink {
  const Canvas* canvas = nullptr;
  Rgb colour{};
};

// FreeType calls this with the spans of a row that an outline covers; its rows count from the bottom.
void lay_spans(int y, int count, const FT_Span* spans, void* user) {
  const Ink& ink = *static_cast<const Ink*>(user);
  uint8_t* const row = ink.canvas->rgba->data() + (ink.canvas->height - 1 - y) * ink.canvas->width * 4;
  for (int n = 0; n < count; ++n)
    for (ptrdiff_t x = spans[n].x; x < spans[n].x + spans[n].len; ++x)
      lay_over(row + 4 * x, ink.colour, spans[n].coverage);
}

void render(FT_Library library, FT_Outline& outline, const Canvas& canvas, Rgb colour) {
  Ink ink{&canvas, colour};
  FT_Raster_Params params{};
  params.flags = FT_RASTER_FLAG_AA | FT_RASTER_FLAG_DIRECT | FT_RASTER_FLAG_CLIP;
  params.gray_spans = lay_spans;
  params.user = &ink;
  params.clip_box = {0, 0, canvas.width, canvas.height};
  if (FT_Outline_Render(library, &outline, &params) != 0)
    throw Error(Code::memory, "FreeType cannot draw: memory runs out");
}

FT_Pos to_units(double pixels) { return std::lround(std::clamp(pixels, -farthest, farthest) * units); }

// Calls each(code point); invalid bytes count as the replacement character.
template <class Each>
void each_letter(std::string_view text, const Each& each) {
  constexpr uint32_t replacement = 0xFFFD;
  for (size_t at = 0; at < text.size();) {
    const size_t size = code_point_size(text, at);
    each(size == 0 ? replacement : code_point(text, at));
    at += std::max<size_t>(size, 1);
  }
}

}  // namespace

struct Pen::Parts {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  std::string file;

  ~Parts() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  void set_size(int size) { FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size)); }

  // Loads a letter's outline without hinting, which depends on the library's version and settings.
  bool load(uint32_t letter) {
    return FT_Load_Glyph(face, FT_Get_Char_Index(face, letter), FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) == 0 &&
           face->glyph->format == FT_GLYPH_FORMAT_OUTLINE;
  }
  double advance() const { return static_cast<double>(face->glyph->linearHoriAdvance) / 65536; }
};

Pen::Pen(const std::string& font_file) : parts_(std::make_unique<Parts>()) {
  const auto found = font_file.empty() ? find_font_file() : font_file;
  if (!found)
    throw Error(Code::unknown_font,
                "there is no font to label pictures with; install fonts-dejavu-core, or name a font by " +
                    spelled::option("--font"));
  parts_->file = *found;
  if (FT_Init_FreeType(&parts_->library) != 0) throw Error(Code::memory, "FreeType does not start: memory runs out");
  if (FT_New_Face(parts_->library, parts_->file.c_str(), 0, &parts_->face) != 0 || !FT_IS_SCALABLE(parts_->face))
    throw Error(Code::file_kind,
                parts_->file + " is not a font with outlines that can be read; name another, a .ttf or .otf file",
                {{"file", parts_->file}});
}

Pen::~Pen() = default;
Pen::Pen(Pen&&) noexcept = default;
Pen& Pen::operator=(Pen&&) noexcept = default;

const std::string& Pen::font_file() const { return parts_->file; }
bool Pen::is_usual_font() const { return is_usual(parts_->file); }

bool Pen::has_letters(std::string_view text) const {
  bool has_all = true;
  each_letter(text, [&](uint32_t letter) { has_all = has_all && FT_Get_Char_Index(parts_->face, letter) != 0; });
  return has_all;
}

double Pen::text_width(std::string_view text, int size) {
  parts_->set_size(size);
  double width = 0;
  each_letter(text, [&](uint32_t letter) { width += parts_->load(letter) ? parts_->advance() : 0; });
  return width;
}

void Pen::write(const Canvas& canvas, Spot left, std::string_view text, int size, Rgb colour) {
  parts_->set_size(size);
  const double up = static_cast<double>(canvas.height) - left.down;
  double right = left.right;
  each_letter(text, [&](uint32_t letter) {
    if (!parts_->load(letter)) return;
    FT_Outline_Translate(&parts_->face->glyph->outline, to_units(right), to_units(up));
    render(parts_->library, parts_->face->glyph->outline, canvas, colour);
    right += parts_->advance();
  });
}

void Pen::fill(const Canvas& canvas, std::span<const Spot> corners, Rgb colour) {
  std::vector<FT_Vector> points;
  for (const Spot spot : corners)
    points.push_back({to_units(spot.right), to_units(static_cast<double>(canvas.height) - spot.down)});
  FT_Outline outline{};
  // FreeType 2.13 changed these types to unsigned.
  using Tag = std::remove_reference_t<decltype(*outline.tags)>;
  using Index = std::remove_reference_t<decltype(*outline.contours)>;
  std::vector<Tag> tags(points.size(), FT_CURVE_TAG_ON);
  auto last = static_cast<Index>(points.size() - 1);
  outline.n_contours = 1;
  outline.n_points = static_cast<Index>(points.size());
  outline.points = points.data();
  outline.tags = tags.data();
  outline.contours = &last;
  render(parts_->library, outline, canvas, colour);
}

}  // namespace ombre::draw

#endif
