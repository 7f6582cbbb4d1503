#include "render/shade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace ombre::render {
namespace {

constexpr Colour white{1, 1, 1}, gray{0.5F, 0.5F, 0.5F}, black{0, 0, 0}, azure{0.125F, 0.5F, 1};

RayHit opaque(double depth, Colour colour) {
  return {static_cast<float>(depth), static_cast<float>(depth), colour, {}, 1};
}

using RayOf = std::function<RayHit(int64_t column, int64_t row)>;

// Fills the rows of the film, and one above and one below.
RayBand band_of(const Film& film, const RayOf& ray) {
  RayBand band(-1, film.height + 1, film.width);
  for (int64_t row = -1; row <= film.height; ++row)
    for (int64_t column = 0; column < film.width; ++column) band.at(column, row) = ray(column, row);
  return band;
}

std::vector<Rgba8> shaded(const Film& film, const RayOf& ray, const ShadeOptions& options, const Camera& camera = {}) {
  std::vector<uint8_t> bytes;
  shade(band_of(film, ray), film, camera, options, 0, film.height / options.samples, 1, bytes);
  std::vector<Rgba8> pixels(bytes.size() / 4);
  for (size_t n = 0; n < bytes.size(); ++n) pixels[n / 4][n % 4] = bytes[n];
  return pixels;
}

const ShadeOptions unlit{Lighting::none, 1, {{0, 0, 255, 255}, false}};

// Returns the depth at which a ray of the film meets the plane through the target with this normal.
double depth_of_plane(const Camera& camera, const Film& film, Vec3 normal, int64_t column, int64_t row) {
  const double across = normal.y * film.right_of(column) + normal.z * film.down_of(row);
  return camera.is_orthographic() ? -across / normal.x : -across / (normal.x + across / camera.distance_mm);
}

// Returns the pixels of a plane, whose normal has the components depth, right and down.
std::vector<Rgba8> plane(Vec3 normal, Colour colour, const Camera& camera = {}) {
  const Film film{12, 10, 0.5};
  const auto ray = [&](int64_t column, int64_t row) {
    return opaque(depth_of_plane(camera, film, normal, column, row), colour);
  };
  return shaded(film, ray, {}, camera);
}

// The light that a gray plane sends back itself, without what shines on it.
double matt_light(Vec3 normal) {
  return static_cast<double>(linear(plane(normal, gray)[50]).red - linear(plane(normal, black)[50]).red);
}

}  // namespace

// IEC 61966-2-1.
TEST(Colours, AreEncodedAsSrgb) {
  EXPECT_EQ(encoded({0, 0.5F, 1}), (Rgba8{0, 188, 255, 255}));
  EXPECT_EQ(encoded({0.2F, 0.0031308F, 0.01F}), (Rgba8{124, 10, 25, 255}));
  EXPECT_EQ(encoded({-1, 7, NAN}), (Rgba8{0, 255, 0, 255}));
  EXPECT_NEAR(linear({128, 0, 0, 255}).red, 0.215861, 1e-6);
  EXPECT_NEAR(linear({0, 1, 0, 255}).green, 1 / (255 * 12.92), 1e-9);
  for (int n = 0; n < 256; ++n) {
    const auto byte = static_cast<uint8_t>(n);
    EXPECT_EQ(encoded(linear({byte, 0, byte, 7})), (Rgba8{byte, 0, byte, 255}));
  }
}

TEST(Shade, WithoutLightShowsTheMaterialOrTheBackground) {
  const auto ray = [](int64_t column, int64_t row) {
    return column == 1 && row == 0 ? opaque(3, gray) : RayHit::nothing();
  };
  const Rgba8 blue{0, 0, 255, 255};
  EXPECT_EQ(shaded({2, 2, 1}, ray, unlit), (std::vector<Rgba8>{blue, {188, 188, 188, 255}, blue, blue}));
}

TEST(Shade, PixelsAreMeansOfLight) {
  ShadeOptions options = unlit;
  options.samples = 2;
  options.background.colour = {0, 0, 0, 255};
  const auto ray = [](int64_t column, int64_t) {
    return column % 2 == 0 || column > 1 ? opaque(1, white) : RayHit::nothing();
  };
  EXPECT_EQ(shaded({4, 2, 1}, ray, options), (std::vector<Rgba8>{{188, 188, 188, 255}, {255, 255, 255, 255}}));
}

TEST(Shade, TransparentPicturesKeepColoursApartFromAlpha) {
  ShadeOptions options = unlit;
  options.samples = 2;
  options.background.is_transparent = true;
  const auto ray = [](int64_t column, int64_t row) {
    return column == 0 && row == 0 ? opaque(1, azure) : RayHit::nothing();
  };
  Rgba8 quarter = encoded(azure);
  quarter[3] = 64;
  EXPECT_EQ(shaded({4, 2, 1}, ray, options), (std::vector<Rgba8>{quarter, {0, 0, 0, 0}}));
}

TEST(Shade, TranslucentMaterialVeilsWhatIsBehind) {
  RayHit ray{1, RayHit::none, {}, {0.3F, 0, 0}, 0.5F};
  const auto pixel = [&](const ShadeOptions& options) {
    return shaded(
        {1, 1, 1}, [&](int64_t, int64_t) { return ray; }, options)[0];
  };
  EXPECT_EQ(pixel(unlit), encoded({0.3F, 0, 0.5F}));
  ShadeOptions clear = unlit;
  clear.background.is_transparent = true;
  Rgba8 half = encoded({0.6F, 0, 0});
  half[3] = 128;
  EXPECT_EQ(pixel(clear), half);
  ray.end = 2;
  ray.at_end = {0, 1, 0};
  EXPECT_EQ(pixel(unlit), encoded({0.3F, 0.5F, 0}));
}

TEST(Shade, PlanesAreEvenlyLit) {
  Camera near_eye;
  near_eye.distance_mm = 20;
  for (const Vec3 normal : {Vec3{-1, 0, 0}, Vec3{-0.8, 0.6, 0}, Vec3{-0.8, 0, -0.6}, Vec3{-0.6, -0.48, 0.64}}) {
    const std::vector<Rgba8> far = plane(normal, azure), near = plane(normal, azure, near_eye);
    for (size_t n = 0; n < far.size(); ++n)
      for (size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(far[n][channel], far[0][channel], 1) << n;
        EXPECT_NEAR(near[n][channel], far[0][channel], 1) << n;
      }
  }
}

// Lambert: light follows the cosine, which is linear in the normal. So what planes of opposite tilts send back together
// is the same in all directions.
TEST(Shade, LightFollowsTheCosine) {
  const double to_the_sides = matt_light({-0.8, 0.6, 0}) + matt_light({-0.8, -0.6, 0});
  const double up_and_down = matt_light({-0.8, 0, 0.6}) + matt_light({-0.8, 0, -0.6});
  const double aslant = matt_light({-0.8, 0.36, 0.48}) + matt_light({-0.8, -0.36, -0.48});
  EXPECT_NEAR(to_the_sides, up_and_down, 0.014);
  EXPECT_NEAR(to_the_sides, aslant, 0.014);
}

TEST(Shade, LightComesFromAboveOnTheLeft) {
  EXPECT_GT(matt_light({-0.8, -0.6, 0}), matt_light({-0.8, 0.6, 0}) + 0.1);
  EXPECT_GT(matt_light({-0.8, 0, -0.6}), matt_light({-0.8, 0, 0.6}) + 0.1);
  EXPECT_GT(matt_light({-0.1, 0.995, 0}), 0.05) << "no side is black";
}

// At an edge, the neighbour on the surface decides, not the one behind it.
TEST(Shade, EdgesAreLitLikeTheirSurfaces) {
  const auto ray = [](int64_t column, int64_t row) {
    const bool is_square = column >= 3 && column < 8 && row >= 2 && row < 7;
    return is_square ? opaque(5, gray) : column > 0 ? opaque(50, gray) : RayHit::nothing();
  };
  const std::vector<Rgba8> pixels = shaded({10, 9, 1}, ray, {});
  for (size_t n = 0; n < pixels.size(); ++n) {
    if (n % 10 > 0) {
      EXPECT_EQ(pixels[n], pixels[1]) << n;
    }
  }
  const auto alone = [](int64_t column, int64_t row) {
    return column == 4 && row == 4 ? opaque(5, gray) : RayHit::nothing();
  };
  EXPECT_EQ(shaded({10, 9, 1}, alone, {})[44], pixels[1]);
}

TEST(Shade, RowsAreAppendedWhateverTheThreads) {
  const Film film{9, 8, 0.5};
  const Camera camera;
  const RayBand band = band_of(film, [](int64_t column, int64_t row) {
    return column + row < 4 ? RayHit::nothing() : opaque(0.1 * static_cast<double>(column * column + row), azure);
  });
  std::vector<uint8_t> whole, parts{1, 2, 3, 4};
  shade(band, film, camera, {}, 0, 8, 1, whole);
  for (int64_t row = 0; row < 8; row += 2) shade(band, film, camera, {}, row, row + 2, 3, parts);
  ASSERT_EQ(whole.size(), size_t{4} * 9 * 8);
  EXPECT_EQ((std::vector<uint8_t>{parts.begin(), parts.begin() + 4}), (std::vector<uint8_t>{1, 2, 3, 4}));
  EXPECT_EQ((std::vector<uint8_t>{parts.begin() + 4, parts.end()}), whole);
}

}  // namespace ombre::render
