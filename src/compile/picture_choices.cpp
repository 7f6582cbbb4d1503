#include "compile/picture_choices.h"

#include <charconv>
#include <cmath>

#include "base/text.h"
#include "compile/colour_map.h"

namespace ombre::compile {

using options::choice;
using options::flag;
using options::group;
using options::option;
using options::WrongValue;
namespace kind = options::kind;

namespace {

constexpr int64_t most_pixels_along = 16384;

std::array<int64_t, 2> parse_size(const std::string& text, const std::string& name) {
  const auto x = text.find('x');
  const auto width = x == std::string::npos ? std::nullopt : parse_number(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parse_number(text.substr(x + 1));
  const auto is_right = [](std::optional<double> v) {
    return v && *v >= 1 && *v <= most_pixels_along && *v == std::floor(*v);
  };
  if (is_right(width) && is_right(height)) return {static_cast<int64_t>(*width), static_cast<int64_t>(*height)};
  throw WrongValue(name + " " + text + " is not a size in pixels; write for example " + name + " 800x600 (at most " +
                   std::to_string(most_pixels_along) + " each way)");
}

std::array<double, 2> parse_angles(const std::string& text, const std::string& name) {
  const std::vector<double> angles = options::parse_numbers(text);
  if (angles.size() == 2 && std::abs(angles[1]) <= 90) return {angles[0], angles[1]};
  throw WrongValue(name + " " + text + " is not azimuth,elevation; write for example " + name +
                   " 30,20 (elevation from -90 to 90)");
}

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

render::Background parse_background(const std::string& text, const std::string& name) {
  render::Background background;
  background.is_transparent = text == "transparent";
  if (background.is_transparent) return background;
  const auto colour = colour_of(text);
  if (!colour)
    throw WrongValue(name + " " + text +
                     " is not a colour; write white, black, gray, transparent or for example #20304a");
  background.colour = *colour;
  return background;
}

CutRequest parse_cut_option(const std::string& text, const std::string& name) {
  if (const auto cut = parse_cut(text)) return *cut;
  throw WrongValue(name + " " + text + " is not a plane; write for example " + name + " x=0 or " + name +
                   " \"z>3.5\" (mm)");
}

SliceView parse_slice_option(const std::string& text, const std::string& name) {
  if (const auto slice = parse_slice(text)) return *slice;
  throw WrongValue(name + " " + text + " is not a plane; write for example " + name + " z=3.2 (mm)");
}

std::pair<std::string, double> parse_opacity(const std::string& text, const std::string& name) {
  const auto sign = text.rfind('=');
  const auto value = sign == std::string::npos ? std::nullopt : parse_number(text.substr(sign + 1));
  if (value && *value >= 0 && *value <= 1) return {text.substr(0, sign), *value};
  throw WrongValue(name + " " + text + " is not a material and a number from 0 to 1; write for example " + name +
                   " clear=0.2");
}

constexpr options::Kind<std::array<int64_t, 2>> size_kind{"size in pixels", parse_size};
constexpr options::Kind<std::array<double, 2>> angles_kind{"2 numbers", parse_angles};
constexpr options::Kind<render::Background> colour_kind{"colour", parse_background};
constexpr options::Kind<CutRequest> cut_kind{"planes", parse_cut_option};
constexpr options::Kind<SliceView> plane_kind{"plane", parse_slice_option};
constexpr options::Kind<std::pair<std::string, double>> opacity_kind{"material with number", parse_opacity};

const std::vector<std::string>& divided_names() {  // in the order of Divided
  static const std::vector<std::string> names{"parts", "materials"};
  return names;
}

}  // namespace

const options::Spec<PictureChoices>& PictureChoices::options() {
  using P = PictureChoices;
  static const options::Spec<P> spec{
      group(&P::design),
      option("-o,--output", &P::output, kind::file,
             "The picture to write, - for stdout (default: the design's name with .png)", "FILE"),
      option("--size", &P::size, size_kind, "Of the picture in pixels (default 800x600)", "WxH"),
      choice("--view", &P::view, render::view_names(),
             "From where: iso (default), front, back, left, right, top or bottom", "NAME"),
      option("--from", &P::angles_deg, angles_kind,
             "From where, as angles: azimuth (0 in front, 90 from the right), elevation", "AZ,EL")
          .excludes({"--view"}),
      option("--perspective", &P::perspective_deg, kind::number,
             "Vertical field of view; degrees (default 0: parallel rays)", "DEG")
          .between(0, 120),
      option("--zoom", &P::zoom, kind::number, "Enlarge the middle of the picture", "X").between(0.01, 1000),
      options::list("--cut", &P::cuts, cut_kind,
                    "Cut along a plane: x=0 takes away the side of the eye, x>0 or x<0 that side; x>0,y<0 takes a "
                    "wedge out; may be repeated",
                    "PLANE"),
      option("--box", &P::box, kind::box, "Show only what is within this box; mm", "X0,Y0,Z0,X1,Y1,Z1"),
      options::list("--opacity", &P::opacity, opacity_kind,
                    "Of a material, 0 (clear) to 1, in place of its own; may be repeated", "MATERIAL=N"),
      option("--by,--colour-by,--color-by", &P::by, kind::text,
             "Colour by a material's fraction or an attribute, from dark blue (least) to yellow, or\nby parts, each in "
             "a colour of its own",
             "NAME|parts"),
      option("--range", &P::range, kind::range,
             "The values from the first colour to the last (default: those of the design)", "LO,HI")
          .needs("--by"),
      choice("--palette", &P::palette, palette_names(),
             "From the least value to the greatest: " + join(palette_names(), ", "), "NAME")
          .needs("--by"),
      option("--deform", &P::deform, kind::number,
             "Of results (.vtu, .xdmf, .frd): how many times the displacement moves the part (default 0)", "X"),
      option("--background", &P::background, colour_kind, "white (default), black, gray, transparent or #rrggbb",
             "COLOUR"),
      option("--aa", &P::samples, kind::whole, "Rays along the edge of a pixel, which smooth edges (default 2)", "N")
          .between(1, 8),
      option("--frames", &P::frames, kind::whole, "Pictures all around the part, numbered (default 1)", "N")
          .between(1, 3600),
      group(&P::work, WorkOptions::options("Most memory for rays, pixels and stages (default 4G)")),
      option("--slice", &P::slice, plane_kind,
             "The plane x, y or z = mm in place of a view: flat, in the materials' colours", "PLANE")
          .excludes({"--view", "--from", "--perspective", "--opacity", "--frames"}),
      flag("--axes", &P::axes, "Draw the directions x, y and z in the corner"),
      flag("--scale-bar", &P::scale_bar, "Draw a length in mm; in perspective it holds at the part's middle"),
      flag("--legend", &P::legend, "List the materials and their colours"),
      flag("--annotate", &P::annotate, "Axes, scale bar and legend"),
      choice("--outlines", &P::outlines, divided_names(),
             "Draw the borders between parts or materials, as they are seen", "parts|materials"),
      choice("--names", &P::names, divided_names(), "Write the names of parts or materials upon them",
             "parts|materials"),
      option("--font", &P::font, kind::file, "Of what is written (default: DejaVu Sans, or another of the system's)",
             "FILE"),
      flag("--force", &P::force, "Replace pictures that are there")};
  return spec;
}

PictureRequest PictureChoices::request() const {
  PictureRequest request;
  request.width = size[0];
  request.height = size[1];
  request.view = render::named_view(view).value();
  if (angles_deg) {
    request.view.azimuth_deg = (*angles_deg)[0];
    request.view.elevation_deg = (*angles_deg)[1];
  }
  request.view.field_of_view_deg = perspective_deg;
  request.view.zoom = zoom;
  request.box = box;
  request.background = background;
  request.cuts = cuts;
  request.slice = slice;
  request.opacity = opacity;
  request.by = by;
  request.palette = palette;
  request.range = range;
  request.annotations = {axes || annotate, scale_bar || annotate, legend || annotate, font};
  request.marks = {outlines, names};
  request.samples = samples;
  request.frames = frames;
  request.threads = work.threads;
  request.memory_bytes = work.memory_bytes;
  return request;
}

}  // namespace ombre::compile
