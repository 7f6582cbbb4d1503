// Compares the filter with geometry for balls and blocks.
#include "eval/batch/part_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "program/field.h"

namespace ombre::eval {
namespace {

using program::Builder;
using program::Field;
using program::PartTable;

struct Part {
  Vec3 centre;
  double size = 0;  // radius of a ball, half the side of a block
  bool is_ball = true;
};

class Parts {
 public:
  explicit Parts(size_t count) {
    for (size_t n = 0; n < count; ++n) {
      all.push_back({{number(-9, 9), number(-9, 9), number(-9, 9)}, number(0.1, 2), n % 3 != 0});
      add(all.back());
    }
  }

  Box box() {
    const Vec3 low{number(-10, 10), number(-10, 10), number(-10, 10)};
    return {low, low + Vec3{number(0, 3), number(0, 3), number(0, 3)}};
  }

  std::vector<Part> all;
  PartTable table{program::Precision::batch};

 private:
  double number(double lo, double hi) {
    return static_cast<double>(static_cast<float>(std::uniform_real_distribution(lo, hi)(random_)));
  }

  void add(const Part& part) {
    Builder builder;
    const Field x = builder.input(0) - part.centre.x, y = builder.input(1) - part.centre.y,
                z = builder.input(2) - part.centre.z;
    const Field inside = part.is_ball ? square(x) + square(y) + square(z) <= part.size * part.size
                                      : max(max(abs(x), abs(y)), abs(z)) <= part.size;
    table.add(builder.finish({{"inside", inside}}), {0}, false);
  }

  std::mt19937 random_{3};
};

// Returns the distance from the surface of a part to the nearest point of a box, negative if they intersect.
double gap(const Part& part, const Box& box) {
  double sum = 0, most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double outside = std::max({box.lo[axis] - part.centre[axis], part.centre[axis] - box.hi[axis], 0.0});
    sum += outside * outside;
    most = std::max(most, outside);
  }
  return (part.is_ball ? std::sqrt(sum) : most) - part.size;
}

}  // namespace

TEST(PartReach, IsThatOfGeometry) {
  for (const KernelSet& kernels : kernel_sets()) {
    PartReach reach(kernels);
    Parts parts(300);
    size_t reaching = 0;
    for (int round = 0; round < 200; ++round) {
      const Box box = parts.box();
      std::vector<uint32_t> kept(parts.all.size());
      for (uint32_t n = 0; n < kept.size(); ++n) kept[n] = n;
      reach.keep_reaching(parts.table, box, kept);
      EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
      for (uint32_t n = 0; n < parts.all.size(); ++n) {
        const double mm = gap(parts.all[n], box);
        if (std::abs(mm) > 0.002) {
          ASSERT_EQ(std::binary_search(kept.begin(), kept.end(), n), mm < 0) << mm;
        }
      }
      reaching += kept.size();
    }
    EXPECT_GT(reaching, 200);
  }
}

}  // namespace ombre::eval
