#include "render/shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/math/math.h"
#include "base/math/srgb.h"
#include "base/system/tasks.h"

namespace ombre::render {
namespace {

// Direction towards the light in the view's frame: from behind the eye, left and above.
const Vec3 key_light{-0.74, -0.42, -0.53};
constexpr double ambient = 0.32, diffuse = 0.62, from_the_eye = 0.12, highlight = 0.10;

// Returns the 40th power, which defines the sharpness of the highlight.
double to_the_40th(double v) {
  const double v4 = (v * v) * (v * v), v8 = v4 * v4, v16 = v8 * v8;
  return v16 * v16 * v8;
}

double to_linear(uint8_t value) { return linear_of_srgb(value / 255.0); }

// Returns the linear value halfway between the byte values n - 1 and n.
double border_below(size_t n) {
  const double v = (static_cast<double>(n) - 0.5) / 255;
  return v <= 12.92 * 0.0031308 ? v / 12.92 : math::pow((v + 0.055) / 1.055, 2.4);
}

// Finds the byte of a linear value by the borders between bytes, starting from a table.
class SrgbBytes {
 public:
  SrgbBytes() {
    for (size_t n = 0; n < 255; ++n) borders_[n] = border_below(n + 1);
    borders_[255] = 2;
    for (size_t n = 0; n < first_.size(); ++n) first_[n] = above(0, static_cast<double>(n) / parts);
  }
  uint8_t of(double linear) const {
    const double within = linear > 0 ? std::min(linear, 1.0) : 0;
    return above(first_[static_cast<size_t>(within * parts)], within);
  }

 private:
  static constexpr double parts = 1024;
  // Returns the byte of a linear value of at most 1, searching from `byte` on.
  uint8_t above(uint8_t byte, double linear) const {
    while (borders_[byte] <= linear) ++byte;
    return byte;
  }
  std::array<double, 256> borders_;
  std::array<uint8_t, 1025> first_;
};

uint8_t to_srgb(double linear) {
  static const SrgbBytes bytes;
  return bytes.of(linear);
}

struct Light {
  double share = 1, shine = 0;  // share of the surface's own colour; share of white
};

Light light_on(Vec3 normal) {
  const double towards_light = std::max(0.0, dot(normal, key_light)), towards_eye = std::max(0.0, -normal.x);
  static const Vec3 between = Vec3{-1, 0, 0} + key_light;  // direction between eye and light
  static const Vec3 half = (1 / length(between)) * between;
  const double glance = std::max(0.0, dot(normal, half));
  return {ambient + diffuse * towards_light + from_the_eye * towards_eye, highlight * to_the_40th(glance)};
}

// Depths over the film as a relief, with its normals.
class Relief {
 public:
  Relief(const RayBand& band, const Film& film, const Camera& camera, float RayHit::*depth)
      : band_(band), film_(film), camera_(camera), depth_(depth) {}

  float depth(int64_t column, int64_t row) const {
    return band_.has(column, row) ? band_.at(column, row).*depth_ : RayHit::none;
  }

  // Returns the normal towards the eye. Of the two neighbours on opposite sides, the one nearer in depth is used,
  // because the other may lie behind an edge.
  Vec3 normal(int64_t column, int64_t row) const {
    const Vec3 across = step(column, row, 1, 0), down = step(column, row, 0, 1);
    const Vec3 n = cross(across, down);
    const double size = length(n);
    if (!(size > 0)) return {-1, 0, 0};
    return (n.x > 0 ? -1 / size : 1 / size) * n;
  }

 private:
  Vec3 place(int64_t column, int64_t row) const {
    return camera_.unprojected({static_cast<double>(depth(column, row)), film_.right_of(column), film_.down_of(row)});
  }

  Vec3 step(int64_t column, int64_t row, int64_t dx, int64_t dy) const {
    const float here = depth(column, row), before = depth(column - dx, row - dy), after = depth(column + dx, row + dy);
    const float to_before = std::abs(here - before), to_after = std::abs(after - here);
    if (to_before == RayHit::none && to_after == RayHit::none)
      return {0, static_cast<double>(dx), static_cast<double>(dy)};
    if (to_after <= to_before) return place(column + dx, row + dy) - place(column, row);
    return place(column, row) - place(column - dx, row - dy);
  }

  const RayBand& band_;
  const Film& film_;
  const Camera& camera_;
  float RayHit::*depth_;
};

struct Sum {
  double red = 0, green = 0, blue = 0, cover = 0;
  void add(const Colour& colour, double share, double shine) {
    red += static_cast<double>(colour.red) * share + shine;
    green += static_cast<double>(colour.green) * share + shine;
    blue += static_cast<double>(colour.blue) * share + shine;
  }
};

}  // namespace

Rgba8 encoded(const Colour& linear) { return {to_srgb(linear.red), to_srgb(linear.green), to_srgb(linear.blue), 255}; }

Colour linear(Rgba8 srgb) {
  return {static_cast<float>(to_linear(srgb[0])), static_cast<float>(to_linear(srgb[1])),
          static_cast<float>(to_linear(srgb[2]))};
}

namespace {

// Converts hits of rays to pixels.
class Shader {
 public:
  Shader(const RayBand& band, const Film& film, const Camera& camera, const ShadeOptions& options)
      : band_(band),
        outer_(band, film, camera, &RayHit::surface),
        inner_(band, film, camera, &RayHit::end),
        options_(options),
        behind_(linear(options.background.colour)) {}

  void shade_row(int64_t y, std::span<uint8_t> pixels) const {
    for (size_t x = 0; 4 * x < pixels.size(); ++x) shade_pixel(static_cast<int64_t>(x), y, pixels.data() + 4 * x);
  }

 private:
  void shade_pixel(int64_t x, int64_t y, uint8_t* pixel) const {
    const int64_t samples = options_.samples;
    Sum sum;
    for (int64_t row = y * samples; row < (y + 1) * samples; ++row)
      for (int64_t column = x * samples; column < (x + 1) * samples; ++column) add_ray(column, row, sum);
    // Colours of transparent pictures are not premultiplied by alpha.
    const double rays = static_cast<double>(samples * samples);
    const bool is_transparent = options_.background.is_transparent;
    const double over = is_transparent ? (sum.cover > 0 ? sum.cover : 1) : rays;
    for (const double value : {sum.red, sum.green, sum.blue}) *pixel++ = to_srgb(value / over);
    const double alpha = is_transparent ? sum.cover / rays : 1;
    *pixel = static_cast<uint8_t>(std::lround(255 * alpha));
  }

  void add_ray(int64_t column, int64_t row, Sum& sum) const {
    const RayHit& ray = band_.at(column, row);
    double left = 1;
    if (ray.surface != RayHit::none && ray.surface != ray.end) {
      const Light here = light(outer_, column, row);
      sum.add(ray.veil, here.share, here.shine);
      left = static_cast<double>(ray.passes);
    }
    if (ray.end != RayHit::none) {
      const Light here = light(inner_, column, row);
      sum.add(ray.at_end, left * here.share, left * here.shine);
      left = 0;
    }
    sum.cover += 1 - left;
    if (!options_.background.is_transparent) sum.add(behind_, left, 0);
  }

  Light light(const Relief& relief, int64_t column, int64_t row) const {
    return options_.lighting == Lighting::none ? Light{} : light_on(relief.normal(column, row));
  }

  const RayBand& band_;
  Relief outer_, inner_;
  ShadeOptions options_;
  Colour behind_;
};

}  // namespace

void shade(const RayBand& band, const Film& film, const Camera& camera, const ShadeOptions& options, int64_t begin,
           int64_t end, int threads, std::vector<uint8_t>& pixels) {
  const auto row_bytes = static_cast<size_t>(film.width / options.samples) * 4, before = pixels.size();
  pixels.resize(before + static_cast<size_t>(end - begin) * row_bytes);
  const Shader shader(band, film, camera, options);
  run_parallel(static_cast<size_t>(end - begin), threads, [&](size_t n) {
    shader.shade_row(begin + static_cast<int64_t>(n), std::span(pixels).subspan(before + n * row_bytes, row_bytes));
  });
}

}  // namespace ombre::render
