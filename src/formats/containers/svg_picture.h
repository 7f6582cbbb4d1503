// Writes pictures of lines, circles and words as SVG. Lengths are in pixels; y points downwards.
#pragma once

#include <string>
#include <string_view>

#include "base/text/text.h"
#include "formats/containers/xml_text.h"

namespace ombre::formats {

// The corners of a path.
class SvgPath {
 public:
  SvgPath& to(double x, double y) {
    text_ += (text_.empty() ? "M" : "L") + format_rounded(x, 6) + " " + format_rounded(y, 6);
    return *this;
  }
  std::string closed() const { return text_ + "Z"; }
  const std::string& open() const { return text_; }

 private:
  std::string text_;
};

// A white page. Each call draws above what is there; `style` is further attributes, as XML.
class SvgPicture {
 public:
  SvgPicture(double width, double height) {
    const std::string w = format_rounded(width, 6), h = format_rounded(height, 6);
    text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w +
            " " + h + "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"" + w + "\" height=\"" + h +
            "\" fill=\"white\"/>\n";
  }

  // `anchor` says which part of the words lies at x: start, middle or end.
  void words(double x, double y, std::string_view anchor, std::string_view text, std::string_view style = {}) {
    text_ += "<text" + place("x", x) + place("y", y) + xml_attribute("text-anchor", anchor) + with(style) + ">" +
             xml_escaped(text) + "</text>\n";
  }
  void path(const std::string& corners, std::string_view style) {
    text_ += "<path d=\"" + corners + "\"" + with(style) + "/>\n";
  }
  void line(double x0, double y0, double x1, double y1, std::string_view style) {
    path(SvgPath().to(x0, y0).to(x1, y1).open(), style);
  }
  void circle(double x, double y, double radius, std::string_view style) {
    text_ += "<circle" + place("cx", x) + place("cy", y) + place("r", radius) + with(style) + "/>\n";
  }
  std::string svg() const { return text_ + "</svg>\n"; }

 private:
  static std::string place(std::string_view name, double value) {
    return xml_attribute(name, format_rounded(value, 6));
  }
  static std::string with(std::string_view style) { return style.empty() ? "" : " " + std::string(style); }

  std::string text_;
};

}  // namespace ombre::formats
