#include "import/fields/surface_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/box_tree.h"
#include "base/math/srgb.h"
#include "base/system/assert.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

constexpr std::array<std::string_view, 4> colour_channels{"red", "green", "blue", "alpha"};
using formats::ImageWrap;
using Colour4 = std::array<double, 4>;
constexpr Colour4 white{1, 1, 1, 1};

class SurfaceColours final : public program::FieldSource {
 public:
  SurfaceColours(std::string name, formats::Mesh mesh, std::vector<SurfaceImage> images, Hash content)
      : name_(std::move(name)), mesh_(std::move(mesh)), images_(std::move(images)), content_(content) {
    ASSERT(!mesh_.triangles.empty() && mesh_.shadings.size() == mesh_.triangles.size());
    std::vector<Box> boxes;
    for (uint32_t n = 0; n < mesh_.triangles.size(); ++n) boxes.push_back(box_of(corners(n)));
    tree_ = BoxTree(boxes);
  }

  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override {
    const auto* const found = std::ranges::find(colour_channels, channel_name);
    return found == colour_channels.end() ? -1 : static_cast<int>(found - colour_channels.begin());
  }
  Interval range(int, const Box&) const override { return {0, 1}; }
  double ops_of_sample(int) const override { return 500; }

  double sample(int channel, Vec3 p) const override { return colour_at(p)[static_cast<size_t>(channel)]; }

  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override {
    for (size_t n = 0; n < points.size(); ++n) {
      const Colour4 colour = colour_at(points[n]);
      for (size_t c = 0; c < channels.size(); ++c) values[c][n] = colour[static_cast<size_t>(channels[c])];
    }
  }

 private:
  std::array<Vec3, 3> corners(uint32_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
  }

  // Returns the first of the nearest triangles.
  uint32_t nearest_triangle(Vec3 p) const {
    std::pair<double, uint32_t> best{Box::inf, 0};
    tree_.nearest(p, Box::inf, -1, [&](uint32_t n) {
      const double squared = squared_distance(p, corners(n));
      best = std::min(best, {squared, n});
      return std::sqrt(squared);
    });
    return best.second;
  }

  Colour4 colour_at(Vec3 p) const {
    if (!is_finite(p)) return {};
    const uint32_t triangle = nearest_triangle(p);
    const std::array<double, 3> shares = nearest_shares(corners(triangle), p);
    const formats::TriangleShading& shading = mesh_.shadings[triangle];
    Colour4 colour = colour_of_corners(shading, shares);
    if (shading.image < 0) return colour;
    const Colour4 pixel = colour_of_image(images_[static_cast<size_t>(shading.image)], shading, shares);
    if (colour == white) return pixel;
    for (size_t n = 0; n < 3; ++n) colour[n] = srgb_of_linear(linear_of_srgb(colour[n]) * linear_of_srgb(pixel[n]));
    colour[3] *= pixel[3];
    return colour;
  }

  static Colour4 colour_of_corners(const formats::TriangleShading& shading, const std::array<double, 3>& shares) {
    if (shading.colours[0] == shading.colours[1] && shading.colours[1] == shading.colours[2])
      return plain(shading.colours[0]);
    Colour4 colour{};
    for (size_t corner = 0; corner < 3; ++corner)
      for (size_t n = 0; n < colour.size(); ++n)
        colour[n] += shares[corner] * static_cast<double>(shading.colours[corner][n]);
    for (double& part : colour) part = std::clamp(part, 0.0, 1.0);
    return colour;
  }

  static Colour4 plain(const std::array<float, 4>& colour) {
    Colour4 made;
    for (size_t n = 0; n < made.size(); ++n) made[n] = std::clamp(static_cast<double>(colour[n]), 0.0, 1.0);
    return made;
  }

  // Returns where a place in an image lies, from 0 to 1.
  static double wrapped(double place, ImageWrap wrap) {
    if (wrap == ImageWrap::clamp) return std::clamp(place, 0.0, 1.0);
    const double part = place - std::floor(place);
    const bool is_mirrored = wrap == ImageWrap::mirror && std::fmod(std::floor(place), 2) != 0;
    return is_mirrored ? 1 - part : part;
  }

  // Interpolates linearly between the centres of pixels. v runs upwards.
  static Colour4 colour_of_image(const SurfaceImage& image, const formats::TriangleShading& shading,
                                 const std::array<double, 3>& shares) {
    double u = 0, v = 0;
    for (size_t corner = 0; corner < 3; ++corner) {
      u += shares[corner] * shading.places[corner][0];
      v += shares[corner] * shading.places[corner][1];
    }
    const double x = wrapped(u, image.wrap_u) * static_cast<double>(image.columns) - 0.5;
    const double y = (1 - wrapped(v, image.wrap_v)) * static_cast<double>(image.rows) - 0.5;
    const double i = std::floor(x), j = std::floor(y);
    Colour4 colour{};
    for (size_t n = 0; n < colour.size(); ++n) {
      const auto mix = [&](double row) {
        const double left = pixel(image, i, row, n), right = pixel(image, i + 1, row, n);
        return left + (x - i) * (right - left);
      };
      const double above = mix(j), below = mix(j + 1);
      colour[n] = std::clamp(above + (y - j) * (below - above), 0.0, 1.0);
    }
    return colour;
  }

  // Beyond an edge lies the opposite one of an image that repeats, else the edge itself.
  static double pixel(const SurfaceImage& image, double column, double row, size_t part) {
    const auto placed = [](double at, size_t count, ImageWrap wrap) {
      const auto size = static_cast<double>(count);
      if (wrap != ImageWrap::repeat) return static_cast<size_t>(std::clamp(at, 0.0, size - 1));
      return static_cast<size_t>(at < 0 ? at + size : at >= size ? at - size : at);
    };
    const size_t at =
        placed(row, image.rows, image.wrap_v) * image.columns + placed(column, image.columns, image.wrap_u);
    return image.rgba[4 * at + part] / 255.0;
  }

  std::string name_;
  formats::Mesh mesh_;
  std::vector<SurfaceImage> images_;
  Hash content_;
  BoxTree tree_;
};

}  // namespace

program::SourceField make_surface_colours(std::string name, formats::Mesh mesh, std::vector<SurfaceImage> images,
                                          Hash content) {
  return std::make_shared<SurfaceColours>(std::move(name), std::move(mesh), std::move(images), content);
}

}  // namespace ombre::importing
