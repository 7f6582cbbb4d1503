#include "questions/possible_outputs.h"

#include "jobs/slice/plan.h"
#include "jobs/test_designs.h"
#include "program/field.h"

namespace ombre::compile {
namespace {

using program::Builder;
using program::Field;
using program::Point;
using program::select;

using MakeField = Field (*)(const Point& p);

const Box space = Box::centered({5, 5, 5});

std::vector<bool> possible(const std::vector<MakeField>& outputs) {
  Builder builder;
  const Point p = Point::origin_frame(builder);
  program::Outputs fields;
  for (const MakeField output : outputs) fields.emplace_back("output", output(p));
  const program::Program program = builder.finish(fields);
  const std::vector<bool> found = possible_outputs(program, space, 1);
  EXPECT_EQ(possible_outputs(program, space, 2), found);
  return found;
}

bool is_possible(MakeField inside, MakeField output) { return possible({inside, output}).at(1); }

Field all(const Point& p) { return p.constant(1); }

// Returns 1 where two shares that add up to one leave nothing, which is nowhere.
Field rest(const Point& p) {
  const Field a = max(0.1 * p.x + 0.5, 0.0), b = max(0.5 - 0.1 * p.x, 0.0);
  return select(a + b <= 0, p.constant(1), p.constant(0));
}

// Returns a condition and its opposite, which is false everywhere. Interval arithmetic cannot see that along the
// surface between them.
Field never(const Point& p) { return logical_and(less(p.x, p.y * p.z), less_equal(p.y * p.z, p.x)); }

TEST(PossibleOutputs, SharesThatAddUpLeaveNothing) { EXPECT_FALSE(is_possible(all, rest)); }

TEST(PossibleOutputs, SmallPlacesAreFound) {
  const auto in_a_corner = [](const Point& p) {
    const Field x = p.x - 4.5, y = p.y - 4.5, z = p.z - 4.5;
    return x * x + y * y + z * z <= 0.04;
  };
  EXPECT_TRUE(is_possible(all, in_a_corner));
}

TEST(PossibleOutputs, OnlyWhatIsInsideCounts) {
  const auto low = [](const Point& p) { return p.x <= 1; };
  const auto high = [](const Point& p) { return less_equal(p.constant(2), p.x); };
  EXPECT_FALSE(is_possible(low, high));
  EXPECT_TRUE(is_possible(high, high));
}

TEST(PossibleOutputs, WhatCannotBeExcludedIsPossible) { EXPECT_TRUE(is_possible(all, never)); }

TEST(PossibleOutputs, OneThatCannotBeExcludedDoesNotHideAnother) {
  EXPECT_EQ(possible({all, never, rest}), (std::vector<bool>{true, true, false}));
}

std::vector<std::string> materials_of(const std::string& text, int most = 255) {
  Diagnostics diagnostics;
  PlanOptions options;
  options.printer.max_materials = most;
  const LoadedPtr loaded = load_text(text, diagnostics);
  const auto plan = loaded ? plan_slice(loaded, options, diagnostics) : std::nullopt;
  EXPECT_TRUE(plan) << to_text(diagnostics);
  std::vector<std::string> names;
  if (!plan) return names;
  for (const SliceMaterial& material : plan->request.materials) names.push_back(material.name);
  return names;
}

// The solid's own material is taken where no fraction is positive, which is nowhere.
TEST(PossibleOutputs, AGradeOfTwoMaterialsIsNoJobOfThree) {
  const std::string grade =
      "root((-5,-5,-5),(5,5,5),(0.2,0.2,0.2)) fgrade([\"x/10+0.5\",\"0.5-x/10\"],[\"magenta\",\"yellow\"]) sphere(5);";
  EXPECT_EQ(materials_of(grade, 2), (std::vector<std::string>{"magenta", "yellow"}));
  const std::string partly =
      "root((-5,-5,-5),(5,5,5),(0.2,0.2,0.2)) fgrade([\"x-2\",\"x-3\"],[\"magenta\",\"yellow\"]) sphere(5, \"cyan\");";
  EXPECT_EQ(materials_of(partly), (std::vector<std::string>{"cyan", "magenta", "yellow"}));
}

}  // namespace
}  // namespace ombre::compile
