#include "options/members.h"

#include <gtest/gtest.h>

#include "base/text/json.h"
#include "options/option.h"

namespace ombre::options {
namespace {

struct Kettle {
  std::string name;
  int cups = 1;
  std::vector<std::string> notes;
  std::string colour = "red";
  bool is_on = false, is_quiet = false;

  static const Spec<Kettle>& options() {
    static const Spec<Kettle> spec{
        option("name", &Kettle::name, kind::text, "Its name", "NAME").required(),
        option("-c,--cups", &Kettle::cups, kind::whole, "How many", "N").between(1, 9),
        list("--note", &Kettle::notes, kind::text, "May be repeated", "TEXT"),
        choice("--colour", &Kettle::colour, {"red", "green"}, "Its colour", "NAME"),
        flag("--on", &Kettle::is_on, "Boil"),
        flag("--quiet-mode", &Kettle::is_quiet, "Boil quietly").needs("--on").excludes({"--note"}),
    };
    return spec;
  }
};

Kettle read(const DataMembers& members) {
  Kettle kettle;
  read_members(Kettle::options().options(), &kettle, members);
  return kettle;
}

std::string failure(const DataMembers& members) {
  try {
    read(members);
  } catch (const WrongValue& wrong) {
    return wrong.message().text();
  }
  return "";
}

TEST(ReadMembers, TakesTextsNumbersListsAndTruthValues) {
  const Kettle kettle = read(
      {{"name", "tea"}, {"cups", 4.0}, {"note", DataList{Data("a"), Data(2.5)}}, {"colour", "green"}, {"on", true}});
  EXPECT_EQ(kettle.name, "tea");
  EXPECT_EQ(kettle.cups, 4);
  EXPECT_EQ(kettle.notes, (std::vector<std::string>{"a", "2.5"}));
  EXPECT_EQ(kettle.colour, "green");
  EXPECT_TRUE(kettle.is_on);
}

TEST(ReadMembers, LeavesOutWhatIsNotGiven) {
  Kettle kettle;
  const DataMembers given = read_members(Kettle::options().options(), &kettle,
                                         {{"name", "tea"}, {"cups", Data()}, {"colour", ""}, {"on", false}});
  ASSERT_EQ(given.size(), 1U);
  EXPECT_EQ(given[0].first, "name");
  EXPECT_EQ(kettle.cups, 1);
  EXPECT_EQ(kettle.colour, "red");
  EXPECT_FALSE(kettle.is_on);
}

TEST(ReadMembers, SaysWhatIsWrong) {
  EXPECT_NE(failure({}).find("\"name\" is required"), std::string::npos);
  EXPECT_NE(failure({{"name", "tea"}, {"cup", 1.0}}).find("did you mean \"cups\"?"), std::string::npos);
  EXPECT_NE(failure({{"name", "tea"}, {"cups", 10.0}}).find("from 1 to 9"), std::string::npos);
  EXPECT_NE(failure({{"name", "tea"}, {"cups", true}}).find("\"cups\" is a text, a number or a list"),
            std::string::npos);
  EXPECT_NE(failure({{"name", "tea"}, {"on", "yes"}}).find("\"on\" is true or false"), std::string::npos);
  EXPECT_NE(failure({{"name", "tea"}, {"colour", "blue"}}).find("\"colour\": "), std::string::npos);
  EXPECT_NE(failure({{"name", "tea"}, {"quiet-mode", true}}).find("\"quiet-mode\" needs \"on\""), std::string::npos);
  EXPECT_NE(failure({{"name", "tea"}, {"on", true}, {"quiet-mode", true}, {"note", "a"}}).find("exclude each other"),
            std::string::npos);
}

// The options of a job may be members of a JSON object with places.
TEST(FieldsOf, ReadsOptionsAsMembers) {
  const Record<Kettle> record("a kettle", fields_of(Kettle::options()));
  const auto read_text = [&](const std::string& text, Kettle& kettle) {
    Diagnostics diagnostics;
    record.read(*parse_json(make_source("kettle.json", text), diagnostics), kettle, MemberReader(diagnostics));
    return to_text(diagnostics);
  };
  Kettle kettle;
  EXPECT_EQ(read_text(R"({"name": "tea", "cups": 3, "colour": "green", "on": true})", kettle), "");
  EXPECT_EQ(kettle.cups, 3);
  EXPECT_EQ(kettle.colour, "green");
  EXPECT_TRUE(kettle.is_on);
  EXPECT_NE(read_text("{\n  \"cups\": 12}", kettle).find("kettle.json:2:11"), std::string::npos);
  EXPECT_NE(read_text(R"({"cup": 1})", kettle).find("did you mean \"cups\"?"), std::string::npos);
  EXPECT_NE(read_text(R"({"colour": ""})", kettle).find("\"colour\" says nothing"), std::string::npos);
}

TEST(Describe, HasNamesWithoutDashes) {
  const DataList rows = describe(Kettle::options().options());
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(*rows[1].find("name"), Data("cups"));
  EXPECT_EQ(*rows[1].find("least"), Data(1.0));
  EXPECT_EQ(*rows[1].find("most"), Data(9.0));
  EXPECT_EQ(*rows[0].find("is_required"), Data(true));
  EXPECT_EQ(*rows[2].find("takes"), Data("several"));
  EXPECT_EQ(*rows[5].find("needs"), Data(DataList{Data("on")}));
}

}  // namespace
}  // namespace ombre::options
