// Attributes and lengths at elements of an SVG file. Only for builds with pugixml.
#pragma once

#include <initializer_list>
#include <string_view>

#include "base/math/vec.h"
#include "formats/containers/xml_file.h"
#include "formats/drawings/svg_style.h"

namespace ombre::formats {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words);

// Returns an attribute that a style sheet cannot set, or an empty text.
std::string_view svg_attribute(pugi::xml_node node, const char* name);

// Returns a value of an element, or an empty text.
std::string_view svg_value(const SvgValues& values, std::string_view name);

class SvgMeasures {
 public:
  explicit SvgMeasures(const XmlFile& file) : file_(file) {}

  const XmlFile& file() const { return file_; }

  // Sets the millimetres in a unit of the content, for lengths with absolute units.
  void set_unit(double millimetres) { unit_mm_ = millimetres; }

  // Returns a length in the element's units; `whole` is the length of 100 %, and `otherwise` that of no text. Reports
  // what is no length, and throws DesignError.
  double length(pugi::xml_node node, std::string_view text, double whole, double otherwise = 0) const;

 private:
  const XmlFile& file_;
  double unit_mm_ = 1;
};

// Returns the length of 100 % for lengths that are neither across nor along (SVG 1.1, section 7.10).
double diagonal_of(const Vec2& view);

}  // namespace ombre::formats
