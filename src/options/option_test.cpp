#include "options/option.h"

#include <gtest/gtest.h>

namespace ombre::options {
namespace {

enum class Colour { red, green };

struct Light {
  Colour colour = Colour::red;
  uint64_t seed = 0;

  static const Spec<Light>& options() {
    static const Spec<Light> spec{
        choice("--colour", &Light::colour, {"red", "green"}, "Its colour", "NAME"),
        option("--seed", &Light::seed, kind::seed, "Seed", "N"),
    };
    return spec;
  }
};

struct Lamp {
  std::string name;
  Light light;
  int count = 1;
  std::optional<Pitch> height;
  std::vector<std::string> notes;
  bool is_on = false;

  static const Spec<Lamp>& options() {
    static const Spec<Lamp> spec{
        option("name", &Lamp::name, kind::text, "Its name", "NAME").required(),
        group(&Lamp::light),
        option("-c,--count", &Lamp::count, kind::whole, "How many", "N").between(1, 9),
        option("--height", &Lamp::height, kind::layer_height, "Of each; mm", "MM"),
        list("--note", &Lamp::notes, kind::text, "May be repeated", "TEXT"),
        flag("--on", &Lamp::is_on, "Shine").excludes({"--note"}),
    };
    return spec;
  }
};

const Option& row(const std::string& name) {
  for (const Option& option : Lamp::options().options())
    if (option.name() == name) return option;
  ADD_FAILURE() << name;
  return Lamp::options().options().front();
}

}  // namespace

TEST(Options, SetTheMembersOfTheirJob) {
  Lamp lamp;
  row("name").set(&lamp, {"desk"});
  row("--colour").set(&lamp, {"green"});
  row("--seed").set(&lamp, {"18446744073709551615"});
  row("--count").set(&lamp, {"7"});
  row("--height").set(&lamp, {"25.4/600"});
  row("--note").set(&lamp, {"a", "b"});
  row("--on").set(&lamp, {});
  EXPECT_EQ(lamp.name, "desk");
  EXPECT_EQ(lamp.light.colour, Colour::green);
  EXPECT_EQ(lamp.light.seed, 18446744073709551615u);
  EXPECT_EQ(lamp.count, 7);
  EXPECT_EQ(lamp.height, (Pitch{127, 3000}));
  EXPECT_EQ(lamp.notes, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(lamp.is_on);
}

TEST(Options, SayWhatTheyTake) {
  EXPECT_TRUE(row("name").is_required);
  EXPECT_EQ(row("--colour").kind, "word");
  EXPECT_EQ(row("--colour").choices, (std::vector<std::string>{"red", "green"}));
  EXPECT_EQ(row("--count").names, "-c,--count");
  EXPECT_TRUE(row("--count").limits->is_whole);
  EXPECT_EQ(row("--note").takes, Takes::several);
  EXPECT_EQ(row("--on").takes, Takes::nothing);
  EXPECT_EQ(row("--on").excludes, std::vector<std::string>{"--note"});
}

TEST(Options, ThatDecideResultsAreDescribedInOrder) {
  Lamp lamp;
  lamp.light = {Colour::green, 7};
  const DataMembers described = Lamp::options().describe(lamp);
  ASSERT_EQ(described.size(), 2u);
  EXPECT_EQ(described[0].first, "colour");
  EXPECT_EQ(*described[0].second.string(), "green");
  EXPECT_EQ(described[1].first, "seed");
  EXPECT_EQ(*described[1].second.string(), "7");
}

TEST(Options, WrongValuesSayWhatToWrite) {
  const auto message = [](const std::string& name, const std::string& text) -> std::string {
    Lamp lamp;
    try {
      row(name).set(&lamp, {text});
    } catch (const WrongValue& wrong) {
      return wrong.what();
    }
    return "";
  };
  EXPECT_EQ(message("--height", "tall"), "--height tall is not a length; write for example --height 0.027 (mm)");
  EXPECT_EQ(message("--seed", "-1"), "--seed -1 is not a whole number from 0 to 18446744073709551615");
  EXPECT_EQ(message("--count", "many"), "--count many is not a whole number");
  EXPECT_EQ(problem(Limits{1, 9, true}, "2.5"), "\"2.5\" is not a whole number from 1 to 9");
  EXPECT_EQ(problem(Limits{0, 0.5, false}, "0.6"), "\"0.6\" is not a number from 0 to 0.5");
  EXPECT_EQ(problem(Limits{0, 0.5, false}, "0.5"), "");
  EXPECT_EQ(problem({"red", "green"}, "gren"), "there is no \"gren\"; did you mean \"green\"?");
  EXPECT_EQ(problem({"red", "green"}, "red"), "");
}

}  // namespace ombre::options
