// The pen of builds without FreeType: its constructor throws.
#include "draw/pen.h"

#ifndef OMBRE_FREETYPE

#include "base/text/error.h"

namespace ombre::draw {

struct Pen::Parts {
  std::string file;
};

Pen::Pen(const std::string&) {
  throw Error(
      Code::library_missing,
      "this ombre was built without FreeType, which draws axes, scale bars and legends; install libfreetype-dev, "
      "configure with -DOMBRE_FREETYPE=ON and build again, or leave them out");
}
Pen::~Pen() = default;
Pen::Pen(Pen&&) noexcept = default;
Pen& Pen::operator=(Pen&&) noexcept = default;
const std::string& Pen::font_file() const { return parts_->file; }
bool Pen::is_usual_font() const { return false; }
bool Pen::has_letters(std::string_view) const { return false; }
double Pen::text_width(std::string_view, int) { return 0; }
void Pen::write(const Canvas&, Spot, std::string_view, int, Rgb) {}
void Pen::fill(const Canvas&, std::span<const Spot>, Rgb) {}

}  // namespace ombre::draw

#endif
