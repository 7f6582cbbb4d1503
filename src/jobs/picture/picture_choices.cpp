#include "jobs/picture/picture_choices.h"

#include <charconv>
#include <cmath>

#include "base/text/text.h"
#include "questions/colour_map.h"

namespace ombre::compile {

using options::WrongValue;

namespace {

constexpr int64_t most_pixels_along = 16384;

std::optional<uint8_t> hex_byte(std::string_view digits) {
  unsigned value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (status != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return static_cast<uint8_t>(value);
}

std::optional<render::Rgba8> colour_of(const std::string& text) {
  if (text == "white") return render::Rgba8{255, 255, 255, 255};
  if (text == "black") return render::Rgba8{0, 0, 0, 255};
  if (text == "gray") return render::Rgba8{128, 128, 128, 255};
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  const std::string_view digits = std::string_view(text).substr(1);
  const auto red = hex_byte(digits.substr(0, 2)), green = hex_byte(digits.substr(2, 2)),
             blue = hex_byte(digits.substr(4, 2));
  if (!red || !green || !blue) return std::nullopt;
  return render::Rgba8{*red, *green, *blue, 255};
}

}  // namespace

std::array<int64_t, 2> parse_size(const std::string& text, const std::string& name) {
  const auto x = text.find('x');
  const auto width = x == std::string::npos ? std::nullopt : parse_number(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parse_number(text.substr(x + 1));
  const auto is_right = [](std::optional<double> v) {
    return v && *v >= 1 && *v <= most_pixels_along && *v == std::floor(*v);
  };
  if (is_right(width) && is_right(height)) return {static_cast<int64_t>(*width), static_cast<int64_t>(*height)};
  throw WrongValue(spelled::option(name, text) + " is not a size in pixels; write for example " + name +
                   " 800x600 (at most " + std::to_string(most_pixels_along) + " each way)");
}

std::array<double, 2> parse_angles(const std::string& text, const std::string& name) {
  const std::vector<double> angles = options::parse_numbers(text);
  if (angles.size() == 2 && std::abs(angles[1]) <= 90) return {angles[0], angles[1]};
  throw WrongValue(spelled::option(name, text) + " is not azimuth,elevation; write for example " +
                   spelled::option(name, "30,20") + " (elevation from -90 to 90)");
}

render::Background parse_background(const std::string& text, const std::string& name) {
  render::Background background;
  background.is_transparent = text == "transparent";
  if (background.is_transparent) return background;
  const auto colour = colour_of(text);
  if (!colour)
    throw WrongValue(spelled::option(name, text) +
                     " is not a colour; write white, black, gray, transparent or for example #20304a");
  background.colour = *colour;
  return background;
}

CutRequest parse_cut_option(const std::string& text, const std::string& name) {
  if (const auto cut = parse_cut(text)) return *cut;
  throw WrongValue(spelled::option(name, text) + " is not a plane; write for example " + name + " x=0 or " + name +
                   " \"z>3.5\" (mm)");
}

SliceView parse_slice_option(const std::string& text, const std::string& name) {
  if (const auto slice = parse_slice(text)) return *slice;
  throw WrongValue(spelled::option(name, text) + " is not a plane; write for example " +
                   spelled::option(name, "z=3.2") + " (mm)");
}

std::pair<std::string, double> parse_opacity(const std::string& text, const std::string& name) {
  const auto sign = text.rfind('=');
  const auto value = sign == std::string::npos ? std::nullopt : parse_number(text.substr(sign + 1));
  if (value && *value >= 0 && *value <= 1) return {text.substr(0, sign), *value};
  throw WrongValue(spelled::option(name, text) + " is not a material and a number from 0 to 1; write for example " +
                   spelled::option(name, "clear=0.2"));
}

PictureRequest PictureChoices::request() const {
  render::ViewOptions shown = render::named_view(view).value();
  if (angles_deg) {
    shown.azimuth_deg = (*angles_deg)[0];
    shown.elevation_deg = (*angles_deg)[1];
  }
  shown.field_of_view_deg = perspective_deg;
  shown.zoom = zoom;
  return {.width = size[0],
          .height = size[1],
          .samples = samples,
          .view = shown,
          .slice = slice,
          .cuts = cuts,
          .box = box,
          .opacity = opacity,
          .by = by,
          .palette = palette,
          .range = range,
          .background = background,
          .annotations = {axes || annotate, scale_bar || annotate, legend || annotate, font},
          .overlays = {outlines, names},
          .frames = frames,
          .threads = work.threads,
          .memory_bytes = work.memory_bytes};
}

}  // namespace ombre::compile
