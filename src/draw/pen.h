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

// Pixels from the left upper corner of the picture.
struct Spot {
  double right = 0, down = 0;
};

// Rows from the top, 4 bytes of RGBA a pixel; colours are not premultiplied.
struct Canvas {
  int64_t width = 0, height = 0;
  std::vector<uint8_t>* rgba = nullptr;
};

// False where this was built without the library that draws.
bool can_draw();

// The same calls give the same pixels. Not thread-safe.
class Pen {
 public:
  // With the letters of a font file; "" takes the first there is of the usual ones. Throws Error when there is none, or
  // this was built without the library.
  explicit Pen(const std::string& font_file = "");
  ~Pen();
  Pen(Pen&&) noexcept;
  Pen& operator=(Pen&&) noexcept;

  const std::string& font_file() const;
  bool is_usual_font() const;  // of which the pictures of documents and tests are made
  // Whether the font has all letters of a text in UTF-8. What it lacks is drawn as a box.
  bool has_letters(std::string_view text) const;

  // Sizes are pixels from line to line or so.
  double text_width(std::string_view text, int size);
  // From `left` on, standing on a line.
  void write(const Canvas& canvas, Spot left, std::string_view text, int size, Rgb colour);

  // What lies outside the picture is cut off. Corners in any direction.
  void fill(const Canvas& canvas, std::span<const Spot> corners, Rgb colour);
  void rectangle(const Canvas& canvas, Spot upper_left, Spot lower_right, Rgb colour);
  void line(const Canvas& canvas, Spot from, Spot to, double width, Rgb colour);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ombre::draw
