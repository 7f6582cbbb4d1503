// Listings of the thesis on multi-material OpenSCAD (2023), with volumes calculated by hand.
#include "solids/test_trees.h"

namespace ombre::solids {
namespace {

class Thesis : public KernelTest {};

TEST_F(Thesis, Listing3_2ModulesUniteWhatTheyHold) {
  EXPECT_EQ(described(intersection({group({cube(1, 1, 2), cube(2, 1, 1)}), cube(1, 1, 1.5)})), "1.5");
}

TEST_F(Thesis, Listing3_3ColoursOfAModuleStayApart) {
  EXPECT_EQ(described(group({colour(red, {moved(0, 0, 10, {cube(10)})}), colour(green, {cube(20, 10, 10)}),
                             colour(green, {cube(10, 20, 10)})})),
            "1000 red; 3000 green");
}

TreePtr two_colours() { return group({colour(red, {cube(10, 10, 20)}), colour(blue, {cube(20, 10, 10)})}); }

// The thesis intersects the two colours of a module with each other (1000 red). Here each colour is intersected with
// the other child, so the shape is that of plain OpenSCAD.
TEST_F(Thesis, Listing3_4ColoursOfAModuleAreIntersectedEach) {
  EXPECT_EQ(described(intersection({two_colours(), cube(15, 10, 15)})), "1500 red; 1500 blue");
}

TEST_F(Thesis, Listing3_4InPlainOpenScad) {
  EXPECT_EQ(described(with(intersection({two_colours(), cube(15, 10, 15)}), Semantics::permissive)), "2000 red");
}

TEST_F(Thesis, Listing3_5And3_6DifferenceOfEachSolid) {
  const auto two = [](const TreePtr& second) { return group({colour(red, {cube(10, 20, 10)}), second}); };
  const TreePtr plain = colour(blue, {moved(0, 0, 10, {cube(20, 10, 10)})});
  EXPECT_EQ(described(difference({two(part("other_part", {plain})), cube(10, 10, 20)})),
            "1000 red; 1000 blue part other_part");
  EXPECT_EQ(described(difference({two(plain), cube(10, 10, 20)})), "1000 red; 1000 blue");
}

TEST_F(Thesis, Listing3_8ColoursDoNotKeepSolidsApart) {
  const Pieces pieces = evaluated(intersection({colour(red, {sphere(10)}), node(Cube{{15, 15, 15}, true})}));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].attributes.colour, red);
}

TEST_F(Thesis, Listing3_11OutermostAttributeWins) {
  EXPECT_EQ(described(material("PLA", {material("ABS", {cube(1)})})), "1 of PLA");
}

TEST_F(Thesis, Listing3_12And3_13Empty) {
  const TreePtr empty = difference({cube(1), cube(1)});
  EXPECT_EQ(described(empty), "");
  EXPECT_EQ(described(hull({empty})), "");
}

TEST_F(Thesis, Listing3_14EmptySolidsHaveNoAttributesUnlessRequested) {
  const auto support = [](Children children) { return part("support", {material("PLA", std::move(children))}); };
  const TreePtr tree = intersection({support({}), support({cube(1)})});
  EXPECT_EQ(described(tree), "1 part support of PLA");
  EXPECT_EQ(described(tree, true), "");
}

TreePtr rods() {
  return group({hull({part("left", {sphere(1)}), part("left", {moved(10, 0, 0, {sphere(1)})}),
                      part("right", {moved(10, 10, 0, {sphere(1)})}), part("right", {moved(0, 10, 0, {sphere(1)})})})});
}

TEST_F(Thesis, Listing3_16And3_17PartsAreHulledByThemselves) {
  const Pieces pieces = evaluated(rods());
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].attributes.part, "left");
  EXPECT_EQ(pieces[1].attributes.part, "right");
  EXPECT_NEAR(size_of(pieces[0]), size_of(pieces[1]), 1e-9);
  // The hull contains a cylinder of length 10 over the sphere's greatest cross section, whose area exceeds 3.
  EXPECT_GT(size_of(pieces[0]), 10 * 3);
  const Pieces both = evaluated(part("both", {rods()}));
  ASSERT_EQ(both.size(), 1U);
  EXPECT_EQ(both[0].attributes.part, "both");
  EXPECT_NEAR(size_of(both[0]), 2 * size_of(pieces[0]), 1e-9);
}

TEST_F(Thesis, Listing3_18EqualSubtreesOfOtherColours) {
  const TreePtr shape = unite({cube(10, 20, 10), cube(20, 10, 10)});
  EXPECT_EQ(described(group({colour(blue, {moved(-15, 0, 0, {shape})}), colour(red, {moved(15, 0, 0, {shape})})})),
            "3000 blue; 3000 red");
}

TEST_F(Thesis, Listing3_19And3_20TheFirstColourCounts) {
  EXPECT_EQ(described(difference({colour(red, {cube(10)}), moved(5, 5, 5, {colour(green, {cube(10)})})})), "875 red");
  EXPECT_EQ(described(unite({colour(green, {cube(5)}), moved(10, 0, 0, {cube(5)})})), "250 green");
}

TEST_F(Thesis, Listing3_21PartsAreNotIntersected) {
  EXPECT_EQ(described(intersection({part("part1", {cube(1)}), part("part2", {moved(2, 1, 1, {cube(1)})})})),
            "1 part part1; 1 part part2");
}

TEST_F(Thesis, Listing4_1SolidsMayOverlap) {
  EXPECT_EQ(described(group({colour(red, {cube(10, 10, 20)}), colour(green, {cube(10, 20, 10)})})),
            "2000 red; 2000 green");
}

TEST_F(Thesis, Listing4_4StrictUnionsKeepColoursApart) {
  EXPECT_EQ(described(with(unite({colour(red, {cube(1)}), colour(green, {cube(2)}), colour(red, {cube(3)})}),
                           Semantics::strict)),
            "27 red; 8 green");
}

TEST_F(Thesis, Listing4_7PermissiveUnionsKeepNothingApart) {
  EXPECT_EQ(described(with(unite({material("PLA", {cube(5, 5, 20)}), material("ABS", {cube(5, 20, 5)})}),
                           Semantics::permissive)),
            "875 of PLA");
}

TEST_F(Thesis, Listing4_8And4_9EmptySolidsWithAttributes) {
  EXPECT_EQ(described(unite({part("part1", {}), part("part2", {cube(1)})}), true), "1 part part2");
  const TreePtr both = intersection({part("part1", {}), part("part1", {cube(1)})});
  EXPECT_EQ(described(both, true), "");
  EXPECT_EQ(described(both), "1 part part1");
}

TEST_F(Thesis, TransformsDoNotOpenUpWhatTheyHold) {
  // A transform without attributes is one child, as in plain OpenSCAD.
  EXPECT_EQ(described(intersection({moved(1, 0, 0, {cube(1, 1, 2), cube(2, 1, 1)}), cube(3)})), "3");
}

TEST_F(Thesis, StrictDifferencesSubtractWhatMatches) {
  const TreePtr tree = difference({part("a", {cube(2)}), part("a", {cube(1)}), part("b", {moved(1, 1, 1, {cube(1)})})});
  EXPECT_EQ(described(tree), "6 part a");
  EXPECT_EQ(described(with(tree, Semantics::strict)), "7 part a");
}

TEST_F(Thesis, SolidsWithoutAttributesActOnAll) {
  const TreePtr two = group({part("a", {cube(2)}), part("b", {moved(2, 0, 0, {cube(2)})})});
  const TreePtr block = moved(1, 0, 0, {cube(2)});
  for (const Semantics semantics : {Semantics::standard, Semantics::strict}) {
    EXPECT_EQ(described(with(intersection({two, block}), semantics)), "4 part a; 4 part b");
    EXPECT_EQ(described(with(intersection({block, two}), semantics)), "4 part a; 4 part b");
    EXPECT_EQ(described(with(difference({two, block}), semantics)), "4 part a; 4 part b");
    EXPECT_EQ(described(with(minkowski({two, cube(1)}), semantics)), "27 part a; 27 part b");
  }
  EXPECT_EQ(described(with(intersection({two, block}), Semantics::permissive)), "8 part a");
}

TEST_F(Thesis, ColoursStayApartWhereTheShapeAllows) {
  const TreePtr two = group({colour(red, {cube(2)}), colour(blue, {moved(2, 0, 0, {cube(2)})})});
  EXPECT_EQ(described(intersection({two, moved(1, 0, 0, {cube(2)})})), "4 red; 4 blue");
  EXPECT_EQ(described(minkowski({two, cube(1)})), "27 red; 27 blue");
  EXPECT_EQ(described(difference({two, moved(1, 0, 0, {cube(2, 2, 1)})})), "6 red; 6 blue");
  EXPECT_EQ(described(node(Union{1}, {two})), "8 red; 8 blue");
  EXPECT_EQ(described(node(Resize{{8, 0, 0}}, {two})), "16 red; 16 blue");
  EXPECT_EQ(described(node(Projection{}, {two})), "4 red; 4 blue");
  const TreePtr flat = group({colour(red, {square(2, 2)}), colour(blue, {moved(2, 0, 0, {square(2, 2)})})});
  EXPECT_EQ(described(node(LinearExtrude{3}, {flat})), "12 red; 12 blue");
  EXPECT_EQ(described(intersection({flat, moved(1, 0, 0, {square(2, 2)})})), "2 red; 2 blue");
  EXPECT_EQ(described(with(node(LinearExtrude{3}, {flat}), Semantics::permissive)), "24 red");
}

TEST_F(Thesis, OperationsThatJoinColoursSaySo) {
  const TreePtr two = group({colour(red, {cube(2)}), colour(blue, {moved(3, 0, 0, {cube(2)})})});
  const auto said = [](const TreePtr& tree) {
    Diagnostics messages;
    const std::string made = described(evaluate(tree, {}, messages));
    const std::string message = messages.list().empty() ? "" : ' ' + messages.list()[0].message;
    return made + message.substr(0, message.find(','));
  };
  EXPECT_EQ(said(hull({two})), "20 red hull() joins shapes of several colours");
  EXPECT_EQ(said(with(hull({two}), Semantics::strict)), "8 red; 8 blue");
  EXPECT_EQ(said(hull({colour(red, {cube(2), moved(3, 0, 0, {cube(2)})})})), "20 red");
  EXPECT_EQ(said(node(Union{}, {two})), "16 red union() joins shapes of several colours");
  EXPECT_EQ(said(with(node(Union{}, {two}), Semantics::strict)), "8 red; 8 blue");
}

// OpenSCAD 2021.01 gives these results.
TEST_F(Thesis, ASumWithNothingIsNothingInThePlaneAlone) {
  const TreePtr none = intersection({square(1, 1), moved(5, 5, 0, {square(1, 1)})});
  EXPECT_EQ(described(minkowski({none, circle(2, 8)})), "");
  EXPECT_EQ(described(minkowski({circle(2, 8), none})), "");
  EXPECT_EQ(described(minkowski({cube(2), difference({cube(1), cube(1)})})), described(cube(2)));
  EXPECT_EQ(described(minkowski({difference({cube(1), cube(1)}), cube(2), cube(1)})), described(cube(3)));
}

}  // namespace
}  // namespace ombre::solids
