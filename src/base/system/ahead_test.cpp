#include "base/system/ahead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>

namespace ombre {
namespace {

using Item = std::unique_ptr<size_t>;

Item square(size_t i) { return std::make_unique<size_t>(i * i); }

TEST(Threads, ThingsMadeAheadComeInOrder) {
  for (const size_t window : {1, 3, 1000}) {
    Ahead<Item> squares(500, window, square);
    Item last;
    for (size_t i = 0; i < 500; ++i) {
      last = squares.take(std::move(last));
      EXPECT_EQ(*last, i * i);
    }
  }
}

TEST(Threads, NoMoreIsMadeAheadThanTheWindowHolds) {
  std::atomic<size_t> made{0};
  Ahead<size_t> numbers(500, 4, [&](size_t i) {
    ++made;
    return i;
  });
  for (size_t i = 0; i < 500; ++i) {
    EXPECT_LE(made, i + 4);
    EXPECT_EQ(numbers.take(), i);
  }
}

TEST(Threads, WhatIsMadeAheadNeedNotBeTaken) {
  for (const size_t taken : {0, 1, 50}) {
    Ahead<Item> squares(100, 2, square);
    for (size_t i = 0; i < taken; ++i) squares.take();
  }
  Ahead<Item> none(0, 2, square);
}

TEST(Threads, AFailureAheadIsThrownWhereItWouldBeTaken) {
  Ahead<size_t> numbers(10, 4, [](size_t i) {
    if (i == 3) throw std::runtime_error("3");
    return i;
  });
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(numbers.take(), i);
  EXPECT_THROW(numbers.take(), std::runtime_error);
}

}  // namespace
}  // namespace ombre
