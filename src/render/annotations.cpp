// Draws axes, a scale bar and a legend beside the contents of a picture.
#include "render/annotations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/round_numbers.h"
#include "base/text/text.h"

namespace ombre::render {
namespace {

using draw::Canvas;
using draw::Pen;
using draw::Rgb;
using draw::Spot;

// Height of a line of text as a share of the picture's height, and its limits in pixels.
constexpr double text_share = 1.0 / 40;
constexpr int smallest_text = 11, largest_text = 64;
// Lengths in units of the text size.
constexpr double axes_strip = 6, scale_strip = 2.6, row = 1.6, margin = 1, gap = 0.5, swatch = 1, arm = 2;
constexpr double legend_share = 0.3;  // greatest share of the picture's width
constexpr double bar_share = 0.3;     // greatest share of the width of the contents
constexpr double bar_lines = 14;      // greatest height of a bar of colours, in text sizes
constexpr Rgb dark_ink{45, 48, 54}, light_ink{235, 237, 240};

int text_size(int64_t height) {
  return static_cast<int>(
      std::clamp<double>(std::round(static_cast<double>(height) * text_share), smallest_text, largest_text));
}

Rgb ink_on(const Background& background) {
  if (background.is_transparent) return dark_ink;
  const Rgba8 c = background.colour;
  constexpr int half_bright = 500 * 255;
  return 299 * c[0] + 587 * c[1] + 114 * c[2] > half_bright ? dark_ink : light_ink;
}

// Shortens text that is too long, and ends it in an ellipsis.
std::string shortened(const std::string& text, double width, int size, Pen& pen) {
  if (pen.text_width(text, size) <= width) return text;
  std::string kept = text;
  const auto is_inside_letter = [&] { return (static_cast<unsigned char>(kept.back()) & 0xC0) == 0x80; };
  while (!kept.empty() && pen.text_width(kept + "…", size) > width) {
    while (kept.size() > 1 && is_inside_letter()) kept.pop_back();
    kept.pop_back();
  }
  return kept + "…";
}

// Draws the annotations of one picture.
class Annotator {
 public:
  Annotator(const Canvas& picture, const Layout& layout, Rgb ink, Pen& pen)
      : picture_(picture), layout_(layout), unit_(layout.text_size), ink_(ink), pen_(pen) {}

  void draw_axes(const Camera& camera) {
    const Spot origin{unit_ * axes_strip / 2, static_cast<double>(picture_.height) - unit_ * axes_strip / 2};
    std::array<int, 3> order{0, 1, 2};  // axes that point away are drawn first
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return camera.forward[a] > camera.forward[b]; });
    for (const int axis : order) draw_axis(axis, origin, camera.right[axis], camera.down[axis]);
  }

  void draw_scale_bar(const Camera& camera, double pixel_mm) {
    const double length = math::greatest_round(bar_share * static_cast<double>(layout_.width) * pixel_mm);
    const double right = static_cast<double>(layout_.width) - unit_ * margin, left = right - length / pixel_mm;
    const double down = static_cast<double>(picture_.height) - unit_ * margin;
    const double thick = std::max(1.0, std::round(unit_ / 8));
    pen_.rectangle(picture_, {left, down - thick}, {right, down}, ink_);
    for (const double end : {left, right - thick})
      pen_.rectangle(picture_, {end, down - unit_ * gap}, {end + thick, down}, ink_);
    const std::string text = format_rounded(length) + (camera.is_orthographic() ? " mm" : " mm at the middle");
    const double middle = (left + right - text_width(text)) / 2, most = right - text_width(text);
    write({std::max(0.0, std::min(middle, most)), down - unit_ * 0.75}, text);
  }

  void draw_legend(const std::vector<Swatch>& legend) {
    const double left = static_cast<double>(layout_.width) + unit_ * margin;
    const double text_left = left + unit_ * (swatch + gap);
    const double room = static_cast<double>(picture_.width) - unit_ * margin - text_left;
    const auto rows = static_cast<size_t>(std::max(1.0, (static_cast<double>(picture_.height) / unit_ - margin) / row));
    const size_t shown = legend.size() <= rows ? legend.size() : rows - 1;
    double line = unit_ * (margin + swatch);  // baseline of the text
    for (size_t n = 0; n < shown; ++n, line += unit_ * row) {
      draw_swatch({left, line - unit_ * swatch}, legend[n].colour);
      write({text_left, line - unit_ * 0.14}, shortened(legend[n].name, room, layout_.text_size, pen_));
    }
    if (shown < legend.size())
      write({left, line - unit_ * 0.14}, "and " + std::to_string(legend.size() - shown) + " more");
  }

  void draw_colour_bar(const ColourBar& bar) {
    const double left = std::round(static_cast<double>(layout_.width) + unit_ * margin);
    const double room = static_cast<double>(picture_.width) - unit_ * margin - left;
    write({left, unit_ * (margin + swatch)}, shortened(bar.title, room, layout_.text_size, pen_));
    const double top = std::round(unit_ * (margin + swatch + row));
    const double most = static_cast<double>(picture_.height) - unit_ * margin - top;
    const double height = std::round(std::min(unit_ * bar_lines, most)), right = left + std::round(unit_ * swatch);
    if (height < unit_) return;
    pen_.rectangle(picture_, {left - 1, top - 1}, {right + 1, top + height + 1}, ink_);
    for (double line = 0; line < height; ++line) {
      const auto n = static_cast<size_t>((1 - (line + 0.5) / height) * static_cast<double>(bar.colours.size()));
      const Rgba8& colour = bar.colours[n];
      pen_.rectangle(picture_, {left, top + line}, {right, top + line + 1}, {colour[0], colour[1], colour[2]});
    }
    const double thick = std::max(1.0, std::round(unit_ / 12)), text_left = right + unit_ * gap;
    for (const ColourBar::Tick& tick : bar.ticks) {
      const double at = std::round(top + (1 - tick.share) * height);
      pen_.rectangle(picture_, {right, at - thick / 2}, {right + unit_ * gap / 2, at + thick / 2}, ink_);
      write({text_left, at + unit_ * 0.36}, shortened(tick.text, room - (text_left - left), layout_.text_size, pen_));
    }
  }

 private:
  double text_width(const std::string& text) { return pen_.text_width(text, layout_.text_size); }
  void write(Spot left, const std::string& text) { pen_.write(picture_, left, text, layout_.text_size, ink_); }

  void draw_axis(int axis, Spot origin, double right, double down) {
    static constexpr Rgb colours[] = {{214, 48, 49}, {34, 150, 70}, {52, 110, 235}};
    static constexpr const char* names[] = {"x", "y", "z"};
    const Rgb colour = colours[axis];
    const double seen = std::hypot(right, down), thick = std::max(1.5, unit_ / 7);
    const Spot tip{origin.right + unit_ * arm * right, origin.down + unit_ * arm * down};
    pen_.line(picture_, origin, tip, thick, colour);
    // An axis seen from its end is a square.
    pen_.rectangle(picture_, {tip.right - thick, tip.down - thick}, {tip.right + thick, tip.down + thick}, colour);
    constexpr double edge_on = 0.2;
    const Spot away = seen > edge_on ? Spot{right / seen, down / seen} : Spot{-0.7, 0.7};
    const std::string name = names[axis];
    pen_.write(picture_,
               {tip.right + unit_ * 0.65 * away.right - text_width(name) / 2,
                tip.down + unit_ * 0.65 * away.down + unit_ * 0.27},
               name, layout_.text_size, colour);
  }

  // The outline makes swatches in the background's colour visible.
  void draw_swatch(Spot upper_left, Rgba8 colour) {
    const Spot from{std::round(upper_left.right), std::round(upper_left.down)};
    const double size = std::round(unit_ * swatch);
    pen_.rectangle(picture_, from, {from.right + size, from.down + size}, ink_);
    pen_.rectangle(picture_, {from.right + 1, from.down + 1}, {from.right + size - 1, from.down + size - 1},
                   {colour[0], colour[1], colour[2]});
  }

  const Canvas& picture_;
  const Layout& layout_;
  double unit_;
  Rgb ink_;
  Pen& pen_;
};

}  // namespace

Layout lay_out(int64_t picture_width, int64_t picture_height, const Annotations& annotations, Pen& pen) {
  Layout layout{picture_width, picture_height, text_size(picture_height)};
  const double unit = layout.text_size;
  if (annotations.axes || annotations.scale_bar)
    layout.height -= std::llround(unit * (annotations.axes ? axes_strip : scale_strip));
  if (annotations.legend.empty() && !annotations.colour_bar) return layout;
  double text = 0;
  if (const auto& bar = annotations.colour_bar) {
    text = pen.text_width(bar->title, layout.text_size) - unit * (swatch + gap);
    for (const ColourBar::Tick& tick : bar->ticks) text = std::max(text, pen.text_width(tick.text, layout.text_size));
  }
  for (const Swatch& one : annotations.legend) text = std::max(text, pen.text_width(one.name, layout.text_size));
  const double wanted = unit * (margin + swatch + gap + margin) + text;
  layout.width -= std::lround(std::ceil(std::min(wanted, legend_share * static_cast<double>(picture_width))));
  return layout;
}

void annotate(const Canvas& picture, const Layout& layout, const Annotations& annotations, const Camera& camera,
              double pixel_mm, const Background& background, Pen& pen) {
  Annotator annotator(picture, layout, ink_on(background), pen);
  if (annotations.axes) annotator.draw_axes(camera);
  if (annotations.scale_bar) annotator.draw_scale_bar(camera, pixel_mm);
  annotator.draw_legend(annotations.legend);
  if (annotations.colour_bar) annotator.draw_colour_bar(*annotations.colour_bar);
}

}  // namespace ombre::render
