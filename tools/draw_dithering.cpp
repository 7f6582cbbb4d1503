// Draws the pictures of docs/user/dithering.md and prints its figures:
// ninja -C build/dev draw_dithering && build/dev/tools/draw_dithering docs/user
#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "export/contact_sheet.h"
#include "export/digits.h"
#include "export/output_file.h"
#include "voxel/blue_noise.h"
#include "voxel/diffusion.h"
#include "voxel/test_spectrum.h"

namespace {

using ombre::exporting::Picture;
using ombre::formats::Rgba;
using namespace ombre::voxel;

constexpr Rgba paper{250, 250, 248, 255}, ink{90, 90, 90, 255}, grid{220, 222, 226, 255};
constexpr Rgba dark{34, 62, 110, 255}, light{226, 231, 238, 255};

// The fraction of a material at (i, j), the same in all layers.
using Fraction = std::function<double(int64_t i, int64_t j)>;

// Whether voxels of a block have the material; x fastest, then y, then z.
struct Block {
  int64_t width, height;
  std::vector<uint8_t> set;
  bool at(int64_t i, int64_t j, int64_t k) const { return set[static_cast<size_t>((k * height + j) * width + i)] != 0; }
};

struct Size {
  int64_t x, y, z;
};

Block by_draw(const Size& size, const Fraction& fraction,
              const std::function<double(int64_t, int64_t, int64_t)>& draw) {
  Block block{size.x, size.y, {}};
  for (int64_t k = 0; k < size.z; ++k)
    for (int64_t j = 0; j < size.y; ++j)
      for (int64_t i = 0; i < size.x; ++i) block.set.push_back(draw(i, j, k) < fraction(i, j) ? 1 : 0);
  return block;
}

Block white(const Size& size, const Fraction& fraction) {
  return by_draw(size, fraction,
                 [](int64_t i, int64_t j, int64_t k) { return hashed_draw(row_hash(0, j, k), i) * 0x1p-24; });
}

Block blue(const Size& size, const Fraction& fraction) {
  return by_draw(size, fraction, [](int64_t i, int64_t j, int64_t k) {
    return blue_noise_row(blue_noise_draws, 0, j, k)[i] * 0x1p-24;
  });
}

Block diffusion(const Size& size, const Fraction& fraction) {
  Block block{size.x, size.y, {}};
  const std::vector<uint8_t> inside(static_cast<size_t>(size.x), 1);
  std::vector<uint8_t> chosen(inside.size());
  std::vector<float> one(inside.size()), rest(inside.size());
  for (int64_t k = 0; k < size.z; ++k) {
    LayerDiffuser diffuser(size.x, 2, 0, k);
    for (int64_t j = 0; j < size.y; ++j) {
      for (size_t i = 0; i < one.size(); ++i) {
        one[i] = static_cast<float>(fraction(static_cast<int64_t>(i), j));
        rest[i] = 1 - one[i];
      }
      const std::array<const float*, 2> fractions{one.data(), rest.data()};
      const bool is_last = j + 1 == size.y;
      diffuser.row(j, inside, is_last ? std::span<const uint8_t>() : inside, fractions, chosen);
      for (const uint8_t material : chosen) block.set.push_back(material == 0 ? 1 : 0);
    }
  }
  return block;
}

struct Method {
  const char* name;
  std::function<Block(const Size&, const Fraction&)> dither;
  Rgba colour;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all{{"stochastic", white, {150, 150, 150, 255}},
                                       {"blue noise", blue, {30, 100, 220, 255}},
                                       {"diffusion", diffusion, {220, 90, 30, 255}}};
  return all;
}

Fraction even(double fraction) {
  return [fraction](int64_t, int64_t) { return fraction; };
}

// ---- patterns, a column for each method

constexpr int64_t panel_width = 192, panel_height = 64, zoom = 2, margin = 16;

void draw_panel(Picture& picture, int64_t left, int64_t top, const std::function<bool(int64_t, int64_t)>& is_set) {
  for (int64_t y = 0; y < zoom * panel_height; ++y)
    for (int64_t x = 0; x < zoom * panel_width; ++x)
      picture.set(static_cast<uint32_t>(left + x), static_cast<uint32_t>(top + y),
                  is_set(x / zoom, y / zoom) ? dark : light);
}

Picture patterns() {
  constexpr int64_t step_x = zoom * panel_width + margin, step_y = zoom * panel_height + margin;
  Picture picture(static_cast<uint32_t>(3 * step_x + margin), static_cast<uint32_t>(3 * step_y + margin), paper);
  const Fraction ramp = [](int64_t i, int64_t) { return (static_cast<double>(i) + 0.5) / panel_width; };
  for (size_t m = 0; m < methods().size(); ++m) {
    const Method& method = methods()[m];
    const int64_t left = margin + static_cast<int64_t>(m) * step_x;
    // A layer of a ramp, a layer of 10 %, a vertical cut through 25 %.
    const Size layer{panel_width, panel_height, 1};
    const Block graded = method.dither(layer, ramp), tenth = method.dither(layer, even(0.1));
    const Block cut = method.dither({panel_width, 32, panel_height}, even(0.25));
    draw_panel(picture, left, margin, [&](int64_t x, int64_t y) { return graded.at(x, y, 0); });
    draw_panel(picture, left, margin + step_y, [&](int64_t x, int64_t y) { return tenth.at(x, y, 0); });
    draw_panel(picture, left, margin + 2 * step_y, [&](int64_t x, int64_t y) { return cut.at(x, 20, y); });
  }
  return picture;
}

// ---- spectra

constexpr int64_t layers = 16;

std::vector<SquarePattern> squares(const Method& method, double fraction) {
  const Block block = method.dither({128, 128, layers}, even(fraction));
  std::vector<SquarePattern> all;
  for (int64_t k = 0; k < layers; ++k)
    all.emplace_back(64, [&, k](int64_t i, int64_t j) { return block.at(32 + i, 32 + j, k); });
  return all;
}

// Of a voxel with the one above it.
double correlation(const std::vector<SquarePattern>& patterns, double fraction) {
  double sum = 0, count = 0;
  for (size_t k = 0; k + 1 < patterns.size(); ++k)
    for (size_t n = 0; n < patterns[k].values.size(); ++n, ++count)
      sum += (patterns[k].values[n] - fraction) * (patterns[k + 1].values[n] - fraction);
  return sum / count / (fraction * (1 - fraction));
}

constexpr std::array<double, 3> fractions{0.1, 0.25, 0.5};

void print_figures() {
  for (const double fraction : fractions)
    for (const Method& method : methods()) {
      const std::vector<SquarePattern> patterns = squares(method, fraction);
      double variance = 0;
      for (const SquarePattern& pattern : patterns) variance += patch_variance(pattern, 16, fraction) / layers;
      std::printf("| %g %% | %s | %.3f | %.3f | %+.2f |\n", 100 * fraction, method.name,
                  Spectrum(patterns, fraction).low(), variance, correlation(patterns, fraction));
    }
}

constexpr uint32_t plot_width = 360, plot_height = 240, plot_margin = 40;
constexpr double most_power = 2.4;

// A plot's corner, and where a point of it lies.
struct Plot {
  uint32_t left, top;
  uint32_t column(double frequency) const { return left + static_cast<uint32_t>(frequency / 0.5 * plot_width); }
  uint32_t row(double power) const {
    return top + plot_height - static_cast<uint32_t>(std::min(power, most_power) / most_power * plot_height);
  }
};

void draw_axes(Picture& picture, const Plot& plot) {
  for (const double power : {0.0, 1.0, 2.0}) {
    for (uint32_t x = 0; x <= plot_width; ++x) picture.set(plot.left + x, plot.row(power), grid);
    ombre::exporting::draw_text(picture, plot.left - 16, plot.row(power) - 5, std::to_string(static_cast<int>(power)),
                                2, ink);
  }
  for (int tenth = 0; tenth <= 5; ++tenth) {
    const uint32_t column = plot.column(tenth / 10.0);
    for (uint32_t y = 0; y <= plot_height; ++y) picture.set(column, plot.top + y, grid);
    ombre::exporting::draw_text(picture, column - 10, plot.top + plot_height + 8, "0." + std::to_string(tenth), 2, ink);
  }
}

void draw_curve(Picture& picture, const Plot& plot, const Spectrum& spectrum, const Rgba& colour) {
  constexpr double ring = 1.0 / 64;
  uint32_t last = 0;
  for (int n = 1; n <= 32; ++n) {
    const uint32_t row = plot.row(spectrum.mean((n - 0.5) * ring, (n + 0.5) * ring));
    const uint32_t from = plot.column((n - 0.5) * ring), to = plot.column(std::min((n + 0.5) * ring, 0.5));
    for (uint32_t x = from; x <= to; ++x)
      for (uint32_t thick = 0; thick < 2; ++thick) picture.set(x, row + thick, colour);
    if (n > 1)
      for (uint32_t y = std::min(row, last); y <= std::max(row, last); ++y)
        for (uint32_t thick = 0; thick < 2; ++thick) picture.set(from + thick, y, colour);
    last = row;
  }
}

Picture spectra() {
  constexpr uint32_t step = plot_width + plot_margin;
  Picture picture(plot_margin + 3 * step, plot_height + 2 * plot_margin, paper);
  for (size_t f = 0; f < fractions.size(); ++f) {
    const Plot plot{plot_margin + static_cast<uint32_t>(f) * step, plot_margin / 2};
    draw_axes(picture, plot);
    for (const Method& method : methods())
      draw_curve(picture, plot, Spectrum(squares(method, fractions[f]), fractions[f]), method.colour);
  }
  return picture;
}

void write(const std::string& path, const Picture& picture) {
  ombre::exporting::write_file(path, ombre::formats::encode_png(picture.width, picture.height, picture.rgba));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: draw_dithering FOLDER\n", stderr);
    return EXIT_FAILURE;
  }
  const std::string folder = argv[1];
  write(folder + "/dithering.png", patterns());
  write(folder + "/dithering_spectra.png", spectra());
  print_figures();
  return EXIT_SUCCESS;
}
