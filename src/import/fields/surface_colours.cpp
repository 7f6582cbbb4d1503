#include "import/fields/surface_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/box_tree.h"
#include "base/system/assert.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

constexpr std::array<std::string_view, 4> colour_channels{"red", "green", "blue", "alpha"};
using Colour4 = std::array<double, 4>;

class SurfaceColours final : public program::FieldSource {
 public:
  SurfaceColours(std::string name, formats::Mesh mesh, SurfaceImage image, Hash content)
      : name_(std::move(name)), mesh_(std::move(mesh)), image_(std::move(image)), content_(content) {
    ASSERT(!mesh_.triangles.empty());
    ASSERT(image_.columns > 0 ? !mesh_.texture_triangles.empty() : !mesh_.vertex_colours.empty());
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
    return image_.columns > 0 ? colour_of_image(triangle, shares) : colour_of_corners(triangle, shares);
  }

  Colour4 colour_of_corners(uint32_t triangle, const std::array<double, 3>& shares) const {
    Colour4 colour{};
    for (size_t corner = 0; corner < 3; ++corner)
      for (size_t n = 0; n < colour.size(); ++n)
        colour[n] += shares[corner] * static_cast<double>(mesh_.vertex_colours[mesh_.triangles[triangle][corner]][n]);
    for (double& part : colour) part = std::clamp(part, 0.0, 1.0);
    return colour;
  }

  // Interpolates linearly between the centres of pixels. v runs upwards.
  Colour4 colour_of_image(uint32_t triangle, const std::array<double, 3>& shares) const {
    double u = 0, v = 0;
    for (size_t corner = 0; corner < 3; ++corner) {
      const auto& at = mesh_.texture_coordinates[mesh_.texture_triangles[triangle][corner]];
      u += shares[corner] * at[0];
      v += shares[corner] * at[1];
    }
    const double x = (u - std::floor(u)) * static_cast<double>(image_.columns) - 0.5;
    const double y = (1 - (v - std::floor(v))) * static_cast<double>(image_.rows) - 0.5;
    const double i = std::floor(x), j = std::floor(y);
    Colour4 colour{};
    for (size_t n = 0; n < colour.size(); ++n) {
      const auto mix = [&](double row) {
        const double left = pixel(i, row, n), right = pixel(i + 1, row, n);
        return left + (x - i) * (right - left);
      };
      const double above = mix(j), below = mix(j + 1);
      colour[n] = std::clamp(above + (y - j) * (below - above), 0.0, 1.0);
    }
    return colour;
  }

  double pixel(double column, double row, size_t part) const {
    const auto placed = [](double at, size_t count) {
      const auto size = static_cast<double>(count);
      return static_cast<size_t>(at < 0 ? at + size : at >= size ? at - size : at);
    };
    const size_t at = placed(row, image_.rows) * image_.columns + placed(column, image_.columns);
    return image_.rgba[4 * at + part] / 255.0;
  }

  std::string name_;
  formats::Mesh mesh_;
  SurfaceImage image_;
  Hash content_;
  BoxTree tree_;
};

}  // namespace

program::SourceField make_surface_colours(std::string name, formats::Mesh mesh, SurfaceImage image, Hash content) {
  return std::make_shared<SurfaceColours>(std::move(name), std::move(mesh), std::move(image), content);
}

}  // namespace ombre::importing
