// Compares operators and builtin functions with OpenSCAD's documentation and with mathematics.
#include <gtest/gtest.h>

#include "base/text/test_cases.h"
#include "lang/engine/test_vocabulary.h"

namespace ombre::lang {
namespace {

void expect_values(const std::string& lines) {
  for_cases(lines, [](const std::string& expression, const std::string& expected) {
    EXPECT_EQ(value_of(expression), expected) << expression;
  });
}

// Compares messages without their positions.
void expect_errors(const std::string& lines) {
  for_cases(lines, [](const std::string& expression, const std::string& expected) {
    const std::string message = first_message("echo(" + expression + ");");
    const size_t at = message.find("error: ");
    EXPECT_EQ(at == std::string::npos ? message : message.substr(at + 7), expected) << expression;
  });
}

TEST(Values, Arithmetic) {
  expect_values(R"(
    1 + 2 * 3 => 7
    7 % 4 => 3
    -7 % 4 => -3
    2 ^ 3 ^ 2 => 512
    -2 ^ 2 => -4
    2 ^ -1 => 0.5
    1 / 0 => inf
    -1 / 0 => -inf
    0 / 0 => nan
    0.1 + 0.2 => 0.3
    1 / 3 => 0.333333333333333
    1e20 => 1e+20
    +3 - -3 => 6
    10 - 4 - 3 => 3
  )");
}

TEST(Values, Vectors) {
  expect_values(R"(
    [1, 2] + [3, 4] => [4, 6]
    [1, 2, 3] - [1, 1] => [0, 1]
    [[1, 2], [3]] + [[1, 1], [1]] => [[2, 3], [4]]
    -[1, [2]] => [-1, [-2]]
    2 * [1, 2] => [2, 4]
    [2, 4] / 2 => [1, 2]
    8 / [2, 4] => [4, 2]
    [1, 2, 3] * [4, 5, 6] => 32
    [[1, 2], [3, 4]] * [5, 6] => [17, 39]
    [5, 6] * [[1, 2], [3, 4]] => [23, 34]
    [[1, 2], [3, 4]] * [[5, 6], [7, 8]] => [[19, 22], [43, 50]]
    (1, 2) + (3, 4) => [4, 6]
    (1 + 2) => 3
  )");
}

TEST(Values, Objects) {
  expect_values(R"(
    object(a = 1, b = [2, "c"]) => { a = 1; b = [2, "c"]; }
    object(a = 1).a => 1
    object(a = 1)["a"] => 1
    object(a = object(b = 2)).a.b => 2
    object(object(a = 1, b = 2), b = 3) => { a = 1; b = 3; }
    object(a = 1, b = 2) == object(b = 2, a = 1) => true
    is_object(object()) => true
    is_object([1]) => false
    is_solid(object()) => false
    has_key(object(a = undef), "a") => true
    has_key(object(a = 1), "b") => false
  )");
  expect_errors(R"(
    object(3) => object() needs members with names, or objects, found a number; write for example object(size = 3)
    object(edges = 1, index = 2).edge => this object has no member .edge; it has .edges, .index
    has_key([1], "a") => has_key() needs an object, found a list of 1
  )");
}

TEST(Values, ComparisonsAndLogic) {
  expect_values(R"(
    1 < 2 && 2 <= 2 && 3 > 2 && 3 >= 3 => true
    "a" < "b" => true
    false < true => true
    [1, [2, "a"]] == [1, [2, "a"]] => true
    [1] == 1 => false
    undef == undef => true
    [0:2] == [0:1:2] => true
    0 / 0 == 0 / 0 => false
    1 != "1" => true
    !0 && !"" && ![] && !undef && !false => true
    1 && "a" && [0] && [0:1] => true
    false && nothing => false
    true || nothing => true
    1 ? 2 : nothing => 2
  )");
}

TEST(Values, IndicesAndParts) {
  expect_values(R"(
    [1, 2, 3][1] => 2
    [1, 2, 3][3] => undef
    [1, 2, 3][-1] => undef
    [1, 2, 3][1.9] => 2
    "aéb"[1] => "é"
    "ab"[2] => undef
    [3:2:9][1] => 2
    (1, 2, 3).z => 3
    (1, 2).z => undef
    [[1, 2], [3, 4]].y.x => 3
  )");
}

TEST(Values, ListComprehensions) {
  expect_values(R"(
    [for (i = [0:3]) i * i] => [0, 1, 4, 9]
    [for (i = [0:0.1:0.3]) i] => [0, 0.1, 0.2, 0.3]
    [for (i = [3:-1:1]) i] => [3, 2, 1]
    [for (i = [3:1]) i] => []
    [for (i = [1, 2], j = [i:2]) [i, j]] => [[1, 1], [1, 2], [2, 2]]
    [for (c = "aé") c] => ["a", "é"]
    [for (i = 0, s = 1; i < 4; i = i + 1, s = s * 2) s] => [1, 2, 4, 8]
    [for (i = [0:4]) if (i % 2 == 0) i else if (i == 3) "x"] => [0, 2, "x", 4]
    [each [1, 2], each [3:4], each "ab", 5] => [1, 2, 3, 4, "a", "b", 5]
    [for (v = [[1, 2], [3]]) each v] => [1, 2, 3]
    [each for (i = [1:2]) [i, i]] => [1, 1, 2, 2]
    [let (a = 1, b = a + 1) for (i = [a:b]) i, 7] => [1, 2, 7]
    [(for (i = [1:2]) i), (3)] => [1, 2, 3]
  )");
}

TEST(Values, LetAssertEchoAndFunctions) {
  expect_values(R"(
    let(a = 2, b = a * a) a + b => 6
    assert(true) 5 => 5
    (function(x, y = 3) x * y)(2) => 6
    let(f = function(n) n <= 1 ? 1 : n * f(n - 1)) f(5) => 120
    let(add = function(a) function(b) a + b) add(3)(4) => 7
    let(g = [function(x) x, function(x) -x]) g[1](5) => -5
    is_function(function() 1) => true
  )");
  EXPECT_EQ(run_script("x = echo(\"in\", a = [1, \"b\"]) 3; echo(x);").echoes, "\"in\", a = [1, \"b\"]\n3\n");
}

TEST(Values, Mathematics) {
  expect_values(R"(
    abs(-2) => 2
    [sign(-2), sign(0), sign(3)] => [-1, 0, 1]
    [for (a = [-360:30:360]) sin(a) == -sin(-a)] == [for (a = [-360:30:360]) true] => true
    [sin(0), sin(30), sin(90), sin(180), sin(210), sin(-90), sin(360)] => [0, 0.5, 1, 0, -0.5, -1, 0]
    [cos(0), cos(60), cos(90), cos(120), cos(180), cos(270), cos(-60)] => [1, 0.5, 0, -0.5, -1, 0, 0.5]
    [tan(0), tan(45), tan(135), tan(90)] => [0, 1, -1, inf]
    sin(1) => 0.0174524064372835
    [asin(1), asin(0.5), acos(0), acos(0.5), acos(-1), atan(1)] => [90, 30, 90, 60, 180, 45]
    [atan2(1, 1), atan2(0, -1), atan2(-1, 0)] => [45, 180, -90]
    [floor(-1.5), ceil(1.2), round(2.5), round(-2.5)] => [-2, 2, 3, -3]
    [ln(1), log(1000), log(2, 8), exp(0), pow(2, 10), sqrt(16)] => [0, 3, 3, 1, 1024, 4]
    [min(3, 1, 2), max([3, 1, 2]), min(4)] => [1, 3, 4]
    norm([3, 4]) => 5
    [cross([2, 3, 4], [5, 6, 7]), cross([2, 1], [0, 4])] => [[-3, 6, -3], 8]
    PI => 3.14159265358979
    rands(0, 1, 3) == rands(0, 1, 3, 0) => true
    rands(0, 1, 3, 1) == rands(0, 1, 3, 2) => false
    let(r = rands(5, 6, 1000, 7)) [min(r) >= 5, max(r) < 6, len(r)] => [true, true, 1000]
    [version(), version_num()] => [[2021, 1, 0], 20210100]
  )");
}

TEST(Values, ListsAndTexts) {
  expect_values(R"(
    [len([1, 2]), len("aé"), len([])] => [2, 2, 0]
    concat([1], 2, [[3]], "a") => [1, 2, [3], "a"]
    concat() => []
    [for (k = [-1, 0, 0.5, 1, 5]) lookup(k, [[0, 0], [1, 10], [2, 30]])] => [0, 0, 5, 10, 30]
    str("a", 1.5, true, undef, [1, "b"], [0:2]) => "a1.5trueundef[1, "b"][0 : 1 : 2]"
    str() => ""
    str(1e-5, " ", -0, " ", 123456789) => "1e-05 0 123456789"
    chr(65, [66, 67], [68:69], 233) => "ABCDEé"
    [ord("a"), ord("éx"), ord("")] => [97, 233, undef]
    [is_undef(undef), is_bool(true), is_num(1), is_num(0 / 0), is_string(""), is_list([]), is_list([0:1])]
      => [true, true, true, false, true, true, false]
    is_undef(nothing) => true
  )");
}

TEST(Values, Search) {
  expect_values(R"(
    search("a", "abcdabcd") => [0]
    search("e", "abcdabcd") => []
    search("a", "abcdabcd", 0) => [[0, 4]]
    search("ab", [["a", 1], ["b", 2], ["c", 3], ["a", 4]]) => [0, 1]
    search("a", [["a", 1], ["b", 2], ["c", 3], ["a", 4]], num_returns_per_match = 0) => [[0, 3]]
    search(3, [["a", 1], ["b", 2], ["c", 3], ["a", 4]], 1, 1) => [2]
    search(["b", "z"], [["a", 1], ["b", 2], ["c", 3], ["a", 4]]) => [1, []]
    search([2, 4], [["a", 1], ["b", 2], ["c", 3], ["a", 4]], 0, 1) => [[1], [3]]
    search(4, [1, 4, 4], 0) => [1, 2]
  )");
}

TEST(Values, MismatchesAreErrors) {
  expect_errors(R"(
    1 + "a" => cannot compute a number + a string; write str(a, b) to join texts
    undef * 2 => cannot compute undef * a number
    [1, 2] * [1, 2, 3] => cannot compute a list of 2 * a list of 3
    [1, undef] + [1, 2] => cannot compute undef + a number, inside of lists
    1 < "a" => cannot compute a number < a string
    -"a" => "-" needs a number or a list of numbers, found a string
    [1]["a"] => an index needs to be a number, found a string
    undef[0] => only lists, strings and ranges have an index, found undef
    [1].w => a vector has the parts .x, .y and .z only
    [0:0:1] => the step of a range cannot be 0
    [0:"a"] => a range needs a finite number as its end, found a string
    [each 3]
      => "each" needs a range, a list or a string, found a number; a range is written [first : last] or [first : step : last]
    sin("a") => sin() needs a number, found a string
    pow("a", true) => pow() needs a number, found a string
    pow(1, true) => pow() needs a number, found a boolean
    sin() => an argument is missing for sin(); write sin(degrees)
    sin(1, 2) => too many arguments for sin(); write sin(degrees)
    sin(angle = 1) => sin() has no parameter "angle"; write sin(degrees)
    len(3) => len() needs a list or a string, found a number
    norm([1, "a"]) => norm() needs a list of numbers, found a list of 2
    max([]) => max() needs at least one number, found an empty list
    cross([1], [2]) => cross() needs two lists of 2 or of 3 numbers, found a list of 1
    lookup(1, [1, 2])
      => lookup() needs a list of [key, value] pairs, found a list of 2; write lookup(key, [[key, value], [key, value], ...])
    (3)(4) => only a function can be called, found a number
    nosuch(1) => there is no function "nosuch"; define it first: function nosuch(...) = ...;
    lookpu(1) => there is no function "lookpu"; did you mean "lookup"?
    cube(1) => there is no function "cube"; "cube" is a node, and stands in statements only
    bleu => there is no variable "bleu"; did you mean "blue"?
    nothing => there is no variable "nothing"; give it a value first: nothing = ...;
    assert(1 > 2) 3 => the assertion "1 > 2" does not hold
    assert(false, str("no ", 5)) 3 => the assertion does not hold: no 5
  )");
}

}  // namespace
}  // namespace ombre::lang
