#include "fea/model/fill.h"

namespace ombre::fea {
namespace {

template <class Body>
void each_part(Fill fill, const Body& body) {
  for (size_t z = 0; z < parts_along; ++z)
    for (size_t y = 0; y < parts_along; ++y)
      for (size_t x = 0; x < parts_along; ++x)
        if (has_part(fill, x, y, z)) body(x, y, z);
}

// Returns the integrals of 1, a and a^2 over a part along its axis, as shares of the brick's length.
std::array<double, 3> along(size_t part) {
  constexpr double step = 2.0 / parts_along;
  const double high = 1 - step * static_cast<double>(part), low = high - step;
  return {(high - low) / 2, (high * high - low * low) / 4, (high * high * high - low * low * low) / 6};
}

}  // namespace

Vec3 fill_centre(Fill fill) {
  Vec3 sum;
  each_part(fill, [&](size_t x, size_t y, size_t z) {
    sum = sum + Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
  });
  const auto count = static_cast<double>(std::popcount(fill));
  return (1.0 / parts_along) * ((1 / count) * sum + Vec3{0.5, 0.5, 0.5});
}

Box fill_box(Fill fill) {
  Box box;
  each_part(fill, [&](size_t x, size_t y, size_t z) {
    const Vec3 low{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    box = hull(box, Box{(1.0 / parts_along) * low, (1.0 / parts_along) * (low + Vec3{1, 1, 1})});
  });
  return box;
}

FillMoments::FillMoments(Fill fill) {
  each_part(fill, [&](size_t x, size_t y, size_t z) {
    const auto a = along(x), b = along(y), c = along(z);
    for (size_t k = 0; k < 3; ++k)
      for (size_t j = 0; j < 3; ++j)
        for (size_t i = 0; i < 3; ++i) values[i + 3 * (j + 3 * k)] += a[i] * b[j] * c[k];
  });
}

}  // namespace ombre::fea
