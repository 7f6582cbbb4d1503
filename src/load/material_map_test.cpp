#include "load/material_map.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/text/error.h"
#include "base/text/json.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

class MaterialMap : public ::testing::Test {
 protected:
  std::string read(const std::vector<std::string>& texts) {
    diagnostics_ = {};
    Diagnostics wrong;
    const auto data = parse_json(make_source("m.json", R"({"materials": [
        {"name": "white", "r": 255, "g": 255, "b": 255, "a": 255}, {"name": "red", "r": 255, "g": 0, "b": 0, "a": 255}]})"),
                                 wrong);
    const auto materials = design::MaterialTable::read(*data, wrong);
    const auto map = read_material_map(texts, *materials, cache_, diagnostics_);
    return map ? print_json_line(Data(*map)) : to_text(diagnostics_);
  }

  sources::SourceCache cache_;
  Diagnostics diagnostics_;
};

TEST_F(MaterialMap, HasPairs) {
  EXPECT_EQ(read({}), "[]");
  EXPECT_EQ(read({"PLA white = white", "#f00=Red"}), R"([["PLA white","white"],["#f00","Red"]])");
  // Names may have an equals sign; materials have none.
  EXPECT_EQ(read({"k=1=red"}), R"([["k=1","red"]])");
}

TEST_F(MaterialMap, ComesFromAFile) {
  const fs::path file = fs::path(testing::TempDir()) / "ombre_material_map.json";
  std::ofstream(file) << R"({"PLA white": "white"})";
  EXPECT_EQ(read({file.string(), "PLA red=red"}), R"([["PLA white","white"],["PLA red","red"]])");
  std::ofstream(file) << R"({"PLA white": 5})";
  EXPECT_NE(read({file.string()}).find("ombre_material_map.json:1:15: error: a material is expected"),
            std::string::npos)
      << to_text(diagnostics_);
  fs::remove(file);
}

TEST_F(MaterialMap, RefusesWhatItDoesNotKnow) {
  EXPECT_NE(read({"a=rde"}).find("there is no material \"rde\" for \"a\"; did you mean \"red\"?"), std::string::npos)
      << to_text(diagnostics_);
  EXPECT_NE(read({"a=red", "a=white"}).find("\"a\" gets two materials"), std::string::npos) << to_text(diagnostics_);
  EXPECT_NE(read({"a="}).find("a name and a material are expected"), std::string::npos) << to_text(diagnostics_);
  EXPECT_THROW(read({"missing.json"}), Error);
}

}  // namespace
}  // namespace ombre::compile
