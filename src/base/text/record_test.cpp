#include "base/text/record.h"

#include <gtest/gtest.h>

#include <array>

#include "base/text/json.h"
#include "base/text/test_cases.h"

namespace ombre {
namespace {

enum class Finish { matte, glossy };

struct Screw {
  double pitch_mm = 1;
  std::optional<int> head;
};

struct Tray {
  std::string label;
  double depth_mm = 10;
  int count = 1;
  bool is_open = false, is_lidded = true;
  Finish finish = Finish::matte;
  std::array<uint8_t, 3> colour{};
  std::vector<Screw> screws;
  std::optional<Screw> spare;
  SourceRange where;
};

Record<Screw> screw_record() {
  return Record<Screw>(
      "a screw", {field::number("pitch_mm", &Screw::pitch_mm, above_zero), field::whole("head", &Screw::head, 2, 8)});
}

Record<Tray> tray_record() {
  return Record<Tray>("a tray", {field::text("label", &Tray::label).required("write \"label\": \"bolts\""),
                                 field::number("depth_mm", &Tray::depth_mm, {0, 90, false, true}),
                                 field::whole("count", &Tray::count, 1, 255),
                                 field::flag("open", &Tray::is_open).sets(&Tray::is_lidded, false),
                                 field::choice("finish", &Tray::finish, {"matte", "glossy"}),
                                 field::numbers("colour", &Tray::colour, "[r, g, b]", {0, 255, true}),
                                 field::objects("screws", &Tray::screws, screw_record()),
                                 field::object("spare", &Tray::spare, screw_record())})
      .checked([](Tray& tray, const Data& data, const MemberReader& reader) {
        if (tray.is_open && tray.depth_mm < 5) reader.fail(*data.find("depth_mm"), "an open tray is deeper");
      });
}

template <class T>
T read_text(const std::string& text, const Record<T>& record, Diagnostics& diagnostics) {
  const auto data = parse_json(make_source("tray.json", text), diagnostics);
  T value;
  const bool is_right = data && record.read(*data, value, MemberReader(diagnostics, Code::study));
  EXPECT_EQ(is_right, !diagnostics.has_errors());
  return value;
}

// The first message, after its place, with its hint.
template <class T = Tray>
std::string complaint(const std::string& text, const Record<T>& record = tray_record(), Code code = Code::study) {
  Diagnostics diagnostics;
  read_text(text, record, diagnostics);
  if (!diagnostics.has_errors()) return "";
  EXPECT_EQ(diagnostics.list()[0].code, code);
  const std::string whole = to_text(diagnostics.list()[0]);
  return whole.substr(0, whole.find('\n')).substr(std::string("tray.json:").size());
}

TEST(Record, SetsWhatTheObjectHas) {
  Diagnostics diagnostics;
  const Tray tray = read_text(R"({"label": "nuts", "count": 3, "open": true, "finish": "glossy", "colour": [1, 2, 255],
                                  "screws": [{"pitch_mm": 0.5}, {"head": 6}], "spare": {"head": 4}})",
                              tray_record(), diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  EXPECT_EQ(tray.label, "nuts");
  EXPECT_EQ(tray.count, 3);
  EXPECT_TRUE(tray.is_open);
  EXPECT_FALSE(tray.is_lidded);
  EXPECT_EQ(tray.finish, Finish::glossy);
  EXPECT_EQ(tray.colour, (std::array<uint8_t, 3>{1, 2, 255}));
  EXPECT_EQ(tray.depth_mm, 10);
  ASSERT_EQ(tray.screws.size(), 2U);
  EXPECT_EQ(tray.screws[0].pitch_mm, 0.5);
  EXPECT_FALSE(tray.screws[0].head);
  EXPECT_EQ(tray.screws[1].head, 6);
  EXPECT_EQ(tray.spare->head, 4);
  EXPECT_TRUE(tray.where.source);
}

TEST(Record, ReportsMistakesWithPlaceAndRemedy) {
  for_cases(R"(
    [1]
      => 1:1: error: expected a tray in braces, not a list of 1; its members are label, depth_mm, count, open, finish, colour, screws, spare
    {} => 1:1: error: a tray needs "label"; write "label": "bolts"
    {"label": " "} => 1:12: error: expected a text for "label", not the text " "
    {"label": "a", "count": 300} => 1:25: error: expected a whole number from 1 to 255 for "count", not 300
    {"label": "a", "count": 1.5} => 1:25: error: expected a whole number from 1 to 255 for "count", not 1.5
    {"label": "a", "depth_mm": 0} => 1:28: error: expected a number above 0, up to 90 for "depth_mm", not 0
    {"label": "a", "open": 1} => 1:24: error: expected true or false for "open", not 1
    {"label": "a", "finish": "glosy"} => 1:27: error: there is no finish "glosy"; did you mean "glossy"?
    {"label": "a", "finish": "rough"} => 1:27: error: there is no finish "rough"; write one of "matte", "glossy"
    {"label": "a", "finish": null} => 1:26: error: expected one of "matte", "glossy" for "finish", not nothing
    {"label": "a", "colour": [1, 2]} => 1:26: error: expected 3 numbers for "colour", not a list of 2; write [r, g, b]
    {"label": "a", "colour": [1, 2, 256]} => 1:33: error: expected a whole number from 0 to 255 for "colour", not 256
    {"label": "a", "screws": {}} => 1:26: error: expected a list for "screws", in square brackets, not an object
    {"label": "a", "screws": [{}, {"pitch_mm": -1}]} => 1:44: error: expected a number above 0 for "pitch_mm", not -1
    {"label": "a", "spare": 3} => 1:25: error: expected a screw in braces, not 3; its members are pitch_mm, head
    {"label": "a", "open": true, "depth_mm": 4} => 1:42: error: an open tray is deeper
  )",
            [](const std::string& text, const std::string& expected) { EXPECT_EQ(complaint(text), expected) << text; });
  EXPECT_EQ(complaint(R"({"lable": "a", "label": "b"})", tray_record(), Code::unknown_key),
            R"(1:12: error: a tray has no "lable"; did you mean "label"?)");
}

TEST(Record, ReportsSeveralAtOnceAndChecksOnlyWhatIsRight) {
  Diagnostics diagnostics;
  read_text(R"({"labl": 1, "count": 0, "open": true, "depth_mm": 4})", tray_record(), diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 3U) << to_text(diagnostics);
}

struct Box {
  Tray tray;
  std::optional<Screw> screw;
  double width = 0, length = 0;
};

TEST(Record, PartsStandAmongTheMembersOfTheWhole) {
  const Record<Box> record =
      Record<Box>("a box", {field::number("width", &Box::width), field::number("length", &Box::length)})
          .with(&Box::tray, tray_record())
          .with(&Box::screw, screw_record())
          .knows({"made_by"})
          .one_of({"width", "length"}, "write \"width\": 1");
  Diagnostics diagnostics;
  const Box box =
      read_text(R"({"label": "a", "count": 7, "pitch_mm": 2, "width": 3, "made_by": 0})", record, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  EXPECT_EQ(box.tray.count, 7);
  EXPECT_EQ(box.screw->pitch_mm, 2);
  EXPECT_EQ(box.width, 3);
  EXPECT_EQ(complaint(R"({"label": "a", "width": 1, "length": 1})", record),
            R"(1:1: error: a box has either "width" or "length", no two of them; write "width": 1)");
  EXPECT_EQ(complaint(R"({"label": "a"})", record),
            R"(1:1: error: a box has either "width" or "length"; write "width": 1)");
  EXPECT_EQ(complaint(R"({"width": 1})", record), R"(1:1: error: a tray needs "label"; write "label": "bolts")");
}

TEST(Record, OpenObjectsMayHaveOtherMembersButNoSlips) {
  const Record<Tray> record =
      Record<Tray>("a tray", {field::text("label", &Tray::label), field::flag("open", &Tray::is_open),
                              field::number("d", &Tray::depth_mm)})
          .open();
  Diagnostics diagnostics;
  const Tray tray = read_text(R"({"label": "a", "labels": ["a", "b"], "made_by": "us", "dx": 3})", record, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  EXPECT_EQ(tray.label, "a");
  EXPECT_EQ(complaint(R"({"opne": true})", record, Code::unknown_key),
            R"(1:10: error: a tray has no "opne"; did you mean "open"?)");
  EXPECT_EQ(complaint("3", record), "1:1: error: expected a tray in braces, not 3; its members are label, open, d");
}

}  // namespace
}  // namespace ombre
