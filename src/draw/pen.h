// Draws letters and shapes on a picture, with smooth edges.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::draw {

using Rgb = std::array<uint8_t, 3>;

// A point in pixels from the upper left corner of the picture.
struct Spot {
  double right = 0, down = 0;
};

// A picture with rows from the top and 4 bytes of RGBA per pixel; colours are not premultiplied.
struct Canvas {
  int64_t width = 0, height = 0;
  std::vector<uint8_t>* rgba = nullptr;
};

// Returns false if this build lacks the drawing library.
bool can_draw();

// Draws on canvases. The same calls give the same pixels. Not thread-safe.
class Pen {
 public:
  // Constructs a pen with the letters of a font file; "" uses the first usual font that exists. Throws Error if there
  // is none, or if this build lacks the library.
  explicit Pen(const std::string& font_file = "");
  ~Pen();
  Pen(Pen&&) noexcept;
  Pen& operator=(Pen&&) noexcept;

  const std::string& font_file() const;
  bool is_usual_font() const;  // true for the font of the documentation's and tests' pictures
  // Returns true if the font has all letters of a UTF-8 text. Missing letters are drawn as boxes.
  bool has_letters(std::string_view text) const;

  // Returns the width of a text in pixels; `size` is the approximate height of a line in pixels.
  double text_width(std::string_view text, int size);
  // Writes a text that starts at `left`, on the baseline.
  void write(const Canvas& canvas, Spot left, std::string_view text, int size, Rgb colour);

  // Fills a polygon with corners in either direction; parts outside the picture are clipped.
  void fill(const Canvas& canvas, std::span<const Spot> corners, Rgb colour);
  void rectangle(const Canvas& canvas, Spot upper_left, Spot lower_right, Rgb colour);
  void line(const Canvas& canvas, Spot from, Spot to, double width, Rgb colour);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ombre::draw
