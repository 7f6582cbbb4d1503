// Compares the index of many parts with a query of each part.
#include "program/parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ombre::program {
namespace {

class RandomBoxes {
 public:
  Box next(double space, double most) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = number(-space, space);
      box.hi[axis] = box.lo[axis] + number(0.01, most);
    }
    return PartIndex::rounded(box);
  }
  Cells cells() {
    Cells cells;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<uint8_t>(number(0, 256)), b = static_cast<uint8_t>(number(0, 256));
      cells.first[axis] = std::min(a, b);
      cells.last[axis] = std::max(a, b);
    }
    return cells;
  }

 private:
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  std::mt19937 random_{7};
};

bool meet(const Box& a, const Box& b) { return !intersect(a, b).is_empty(); }

}  // namespace

TEST(Cells, HoldTheBoxThatTheyAreAround) {
  RandomBoxes boxes;
  for (int n = 0; n < 1000; ++n) {
    const Box whole = boxes.next(10, 5), part = intersect(whole, boxes.next(10, 5));
    if (part.is_empty()) continue;
    const Box held = Cells::around(part, whole).in(whole).expanded(1e-12);
    EXPECT_EQ(intersect(held, part), part);
  }
}

TEST(Cells, OfOneBoxShareTheirFaces) {
  RandomBoxes boxes;
  for (int n = 0; n < 1000; ++n) {
    const Box whole = boxes.next(10, 5);
    Cells low, high;
    low.last[0] = static_cast<uint8_t>(n % 255);
    high.first[0] = static_cast<uint8_t>(low.last[0] + 1);
    EXPECT_EQ(low.in(whole).hi.x, high.in(whole).lo.x);
    EXPECT_EQ(hull(low.in(whole), high.in(whole)), whole);
  }
}

// Returns the program of x * a + b.
Program line_program(double a, double b) {
  Program program;
  program.code = {{Op::input}, {Op::constant}, {Op::multiply}, {Op::constant}, {Op::add}};
  program.code[1].value = a;
  program.code[2].a = 0, program.code[2].b = 1;
  program.code[3].value = b;
  program.code[4].a = 2, program.code[4].b = 3;
  program.outputs = {4};
  return program;
}

// Factors vary only from a later row on; sums vary only in the last row, and only by sign.
TEST(PartTable, GivesBackTheParametersOfEachRow) {
  for (const Precision precision : {Precision::reference, Precision::batch}) {
    PartTable table(precision);
    std::vector<std::vector<double>> rows;
    for (uint32_t n = 0; n < 200; ++n) {
      const double a = n < 100 ? 0.1 : 0.1 * n, b = n == 199 ? -0.0 : 0.0;
      table.add(line_program(a, b), {0}, false);
      rows.push_back({a, b});
    }
    EXPECT_EQ(table.body_count(), 1);
    for (uint32_t row = 0; row < rows.size(); ++row) {
      for (size_t number = 0; number < rows[row].size(); ++number) {
        const double value = rows[row][number], found = table.parameter(row, number);
        EXPECT_EQ(found, precision == Precision::batch ? static_cast<double>(static_cast<float>(value)) : value);
        EXPECT_EQ(std::signbit(found), std::signbit(value));
      }
    }
  }
}

// Slot 2 of the later table is slot 3 of the first.
TEST(PartTable, AppendsRowsWhoseSlotsHaveOtherNumbers) {
  PartTable first(Precision::reference), later(Precision::reference);
  first.add(line_program(1, 2), {0, -1, -1, 0}, false);
  later.add(line_program(3, 4), {0, 0}, false);
  later.add(line_program(5, 6), {0, -1, 0}, false);
  first.append(later, {0, 1, 3});
  ASSERT_EQ(first.size(), 3u);
  ASSERT_EQ(first.body_count(), 2u);
  EXPECT_EQ(first.body_of(2), first.body_of(0));
  EXPECT_EQ(first.body(first.body_of(1)).slots, (std::vector<int>{0, 0}));
  EXPECT_EQ(first.body(first.body_of(2)).slots, (std::vector<int>{0, -1, -1, 0}));
  for (uint32_t row = 0; row < 3; ++row) {
    EXPECT_EQ(first.parameter(row, 0), 1.0 + 2 * row);
    EXPECT_EQ(first.parameter(row, 1), 2.0 + 2 * row);
  }
}

TEST(PartIndex, FindsThePartsWhosePiecesMeetARegion) {
  RandomBoxes boxes;
  PartIndex index, later;
  std::vector<std::vector<Box>> parts;
  for (int n = 0; n < 500; ++n) {
    const Box whole = boxes.next(10, 3);
    const std::vector<Cells> pieces{boxes.cells(), boxes.cells()};
    (n < 300 ? index : later).add(whole, pieces);
    parts.push_back({pieces[0].in(whole), pieces[1].in(whole)});
  }
  index.append(later);
  index.build();
  std::vector<uint32_t> found;
  std::vector<PartIndex::Entry> few;
  for (int n = 0; n < 500; ++n) {
    const Box region = boxes.next(10, 2);
    std::vector<uint32_t> expected;
    for (uint32_t part = 0; part < parts.size(); ++part)
      if (meet(parts[part][0], region) || meet(parts[part][1], region)) expected.push_back(part);
    index.find(region, found);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(index.reaches(region), !expected.empty());
    EXPECT_EQ(index.count(region, 3), std::min<size_t>(expected.size(), 3));
    // Each piece is found once, unless there are too many.
    size_t pieces = 0;
    for (const auto& part : parts) pieces += meet(part[0], region) + meet(part[1], region);
    EXPECT_EQ(index.find_few(region, pieces, few), true);
    EXPECT_EQ(few.size(), pieces);
    for (const PartIndex::Entry& entry : few) {
      EXPECT_TRUE(entry.box == parts[entry.part][0] || entry.box == parts[entry.part][1]);
      EXPECT_TRUE(meet(entry.box, region));
    }
    if (pieces > 0) {
      EXPECT_FALSE(index.find_few(region, pieces - 1, few));
    }
  }
}

}  // namespace ombre::program
