// Draws axes, scale bar and legend on a design's pictures.
#include "jobs/picture/picture_labels.h"

#include <algorithm>
#include <cmath>

#include "base/math/round_numbers.h"
#include "base/text/text.h"
#include "questions/colour_map.h"
#include "questions/part_labels.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

constexpr int64_t smallest_part = 16;  // least pixels for the part along each axis

void check_letters(const std::vector<render::Swatch>& legend, const draw::Pen& pen, const SourceRange& where,
                   Diagnostics& diagnostics) {
  for (const render::Swatch& swatch : legend) {
    if (pen.has_letters(swatch.name)) continue;
    diagnostics.warning(where, pen.font_file() + " lacks letters of the material \"" + swatch.name + "\"",
                        "name a font that has them by " + spelled::option("--font"));
    return;
  }
}

// Puts the part's pixels into the left upper corner of a larger picture.
std::vector<uint8_t> on_background(const std::vector<uint8_t>& part, const render::Layout& layout,
                                   const PictureRequest& request) {
  render::Rgba8 colour = request.background.colour;
  if (request.background.is_transparent) colour = {};
  std::vector<uint8_t> pixels(static_cast<size_t>(request.width * request.height * 4));
  for (size_t n = 0; n < pixels.size(); ++n) pixels[n] = colour[n % 4];
  for (int64_t row = 0; row < layout.height; ++row)
    std::copy_n(part.data() + row * layout.width * 4, layout.width * 4, pixels.data() + row * request.width * 4);
  return pixels;
}

// Returns about five round numbers within the range.
std::vector<render::ColourBar::Tick> ticks_of(Interval range) {
  if (range.is_point()) return {{0.5, format_rounded(range.lo, 3)}};
  constexpr double most_steps = 6;
  const double width = range.hi - range.lo;
  const double step = math::least_round(width / most_steps);
  std::vector<render::ColourBar::Tick> ticks;
  for (double n = std::ceil(range.lo / step - 1e-9); n * step <= range.hi + 1e-9 * width; ++n)
    ticks.push_back({(n * step - range.lo) / width, format_rounded(n * step, 6)});
  return ticks;
}

// Returns nothing if the value is a colour itself.
std::optional<render::ColourBar> colour_bar(const design::Design& design, const ValueColours& value) {
  constexpr int colours = 256;
  if (attribute_parts(design, value.of).size() > 1) return std::nullopt;
  const Palette* palette = palette_called(value.palette);
  const std::string unit = value_unit(design, value.of);
  render::ColourBar bar{unit.empty() ? value.of : value.of + ", " + unit, {}, ticks_of(value.range)};
  for (int n = 0; n < colours; ++n)
    bar.colours.push_back(map_colour((n + 0.5) / colours, palette ? *palette : palettes().front()));
  return bar;
}

}  // namespace

std::optional<PictureLabels> PictureLabels::make(const Loaded& loaded, const PictureRequest& request, const Box& box,
                                                 const std::optional<ValueColours>& value, Diagnostics& diagnostics) {
  const AnnotationRequest& wanted = request.annotations;
  const SourceRange where{loaded.source, 0, 0};
  PictureLabels labels(request, draw::Pen(wanted.font_file));
  labels.annotations_.axes = wanted.axes;
  labels.annotations_.scale_bar = wanted.scale_bar;
  const std::vector<std::string> parts =
      value && value->of == part_label ? part_names(loaded.design) : std::vector<std::string>();
  for (size_t n = 0; wanted.legend && n < parts.size(); ++n)
    labels.annotations_.legend.push_back({parts[n], label_colour(n + 1)});
  if (wanted.legend && value && parts.empty()) labels.annotations_.colour_bar = colour_bar(loaded.design, *value);
  if (wanted.legend && !value) {
    const auto materials = materials_within(loaded.design, box, request.threads, diagnostics);
    if (!materials) return std::nullopt;
    for (const MaterialId id : *materials) {
      const design::Material& material = loaded.design.materials.all()[id];
      labels.annotations_.legend.push_back({material.name, material.colour});
    }
  }
  labels.layout_ = render::lay_out(request.width, request.height, labels.annotations_, labels.pen_);
  if (std::min(labels.layout_.width, labels.layout_.height) < smallest_part) {
    diagnostics.error(Code::option, where, "the picture is too small for what is to be written on it",
                      "make it larger by " + spelled::option("--size") + ", or leave out axes, scale bar or legend");
    return std::nullopt;
  }
  if (wanted.font_file.empty() && !labels.pen_.is_usual_font())
    diagnostics.warning(
        where, "there is no DejaVu Sans, the usual font; the picture is labelled in " + labels.pen_.font_file(),
        "install fonts-dejavu-core for the same picture everywhere");
  check_letters(labels.annotations_.legend, labels.pen_, where, diagnostics);
  return labels;
}

void PictureLabels::add_to(Picture& picture, const render::Camera& camera) {
  picture.rgba = on_background(picture.rgba, layout_, *request_);
  const draw::Canvas canvas{request_->width, request_->height, &picture.rgba};
  render::annotate(canvas, layout_, annotations_, camera, picture.pixel_mm, request_->background, pen_);
}

}  // namespace ombre::compile
