// Places found in meshes of results, with the values there: questions a second, at random points and along rows.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

#include "import/fields/result_source.h"

namespace {

using namespace ombre;
using Clock = std::chrono::steady_clock;

constexpr double side_mm = 50;
constexpr size_t batch = 1024;
// Corners of the six tetrahedra of a cube, each from one corner to the opposite one (Kuhn); bits are x, y, z.
constexpr std::array<std::array<uint32_t, 4>, 6> tetrahedra_of_cube = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
constexpr std::array<uint32_t, 8> brick_of_cube = {0, 1, 3, 2, 4, 5, 7, 6};

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

double linear(Vec3 p) { return 1 + 0.5 * p.x - 0.25 * p.y + 0.125 * p.z; }

// A cube whose inner nodes are moved by up to a tenth of a cell, so that bricks have curved sides.
formats::Results cube(uint32_t along, formats::ElementKind kind) {
  formats::Results made;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  const double cell = side_mm / along;
  const auto is_inner = [&](uint32_t n) { return n > 0 && n < along; };
  for (uint32_t k = 0; k <= along; ++k)
    for (uint32_t j = 0; j <= along; ++j)
      for (uint32_t i = 0; i <= along; ++i) {
        Vec3 p{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        if (is_inner(i) && is_inner(j) && is_inner(k)) p = p + Vec3{shift(random), shift(random), shift(random)};
        made.points.push_back(cell * p);
      }
  const auto corner = [&](uint32_t i, uint32_t j, uint32_t k, uint32_t bits) {
    return (i + (bits & 1)) + (along + 1) * ((j + (bits >> 1 & 1)) + (along + 1) * (k + (bits >> 2)));
  };
  for (uint32_t k = 0; k < along; ++k)
    for (uint32_t j = 0; j < along; ++j)
      for (uint32_t i = 0; i < along; ++i) {
        if (kind == formats::ElementKind::brick8) {
          std::array<uint32_t, 8> nodes{};
          for (size_t n = 0; n < 8; ++n) nodes[n] = corner(i, j, k, brick_of_cube[n]);
          made.add_element(kind, nodes.data());
          continue;
        }
        for (const auto& corners : tetrahedra_of_cube) {
          std::array<uint32_t, 4> nodes{};
          for (size_t n = 0; n < 4; ++n) nodes[n] = corner(i, j, k, corners[n]);
          made.add_element(kind, nodes.data());
        }
      }
  made.fields.push_back({"temperature", "C", 1, false, {}});
  for (const Vec3& p : made.points) made.fields[0].values.push_back(linear(p));
  return made;
}

std::vector<Vec3> random_points(size_t count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> at(0, side_mm);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {at(random), at(random), at(random)};
  return points;
}

// Rows along x, as slicing has them.
std::vector<Vec3> points_in_rows(size_t count) {
  const auto along = static_cast<size_t>(std::cbrt(static_cast<double>(count)));
  const double step = side_mm / static_cast<double>(along);
  std::vector<Vec3> points;
  for (size_t k = 0; k < along; ++k)
    for (size_t j = 0; j < along; ++j)
      for (size_t i = 0; i < along; ++i)
        points.push_back(
            step * Vec3{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, static_cast<double>(k) + 0.5});
  return points;
}

struct Asked {
  double per_second = 0, greatest_error = 0;
};

Asked ask(const program::FieldSource& source, const std::vector<Vec3>& points, unsigned threads) {
  const int channel = source.channel(importing::result_channel_name(0, 0));
  std::vector<double> values(points.size());
  const auto ask_every = [&](size_t first) {
    for (size_t n = first * batch; n < points.size(); n += threads * batch) {
      const size_t count = std::min(batch, points.size() - n);
      source.sample_all(channel, {points.data() + n, count}, {values.data() + n, count});
    }
  };
  const auto begin = Clock::now();
  std::vector<std::jthread> others;
  for (unsigned n = 1; n < threads; ++n) others.emplace_back(ask_every, n);
  ask_every(0);
  others.clear();
  Asked found{static_cast<double>(points.size()) / seconds_since(begin), 0};
  for (size_t n = 0; n < points.size(); ++n) {
    const double error = std::abs(values[n] - linear(points[n]));
    found.greatest_error = std::isnan(error) ? error : std::max(found.greatest_error, error);
  }
  return found;
}

void measure(const char* name, uint32_t along, formats::ElementKind kind, size_t count, unsigned threads) {
  formats::Results results = cube(along, kind);
  const auto begin = Clock::now();
  const auto mesh = std::make_shared<const importing::ResultMesh>(std::move(results));
  const double index_seconds = seconds_since(begin);
  const auto source = importing::make_result_source("cube", mesh, {}, hash_bytes(name));
  const Asked at_random = ask(*source, random_points(count), threads);
  const Asked in_rows = ask(*source, points_in_rows(count), threads);
  std::printf(
      "{\"elements\": %zu, \"kind\": \"%s\", \"threads\": %u, \"index_seconds\": %.6f, \"at_random\": %.0f, "
      "\"in_rows\": %.0f, \"greatest_error\": %.3g}\n",
      mesh->element_count(), name, threads, index_seconds, at_random.per_second, in_rows.per_second,
      std::max(at_random.greatest_error, in_rows.greatest_error));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::fprintf(stderr, "bench_results ELEMENTS QUESTIONS THREADS\n");
    return 2;
  }
  const double elements = std::atof(arguments[1]);
  const auto questions = static_cast<size_t>(std::atof(arguments[2]));
  const auto threads = static_cast<unsigned>(std::atoi(arguments[3]));
  const auto along = [&](double of_cell) { return static_cast<uint32_t>(std::lround(std::cbrt(elements / of_cell))); };
  measure("bricks", along(1), formats::ElementKind::brick8, questions, threads);
  measure("tetrahedra", along(6), formats::ElementKind::tetrahedron4, questions, threads);
}
