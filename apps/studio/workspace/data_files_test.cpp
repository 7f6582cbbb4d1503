// Tests of scans, results and tables beside designs.
#include <cstring>
#include <filesystem>

#include "base/system/test_source_files.h"
#include "base/text/json.h"
#include "studio/test_studio.h"
#include "studio/workspace/data_files.h"

namespace ombre::studio {
namespace {

// A scan of 3 x 2 x 2 voxels whose numbers are 100 k + 10 j + i.
constexpr const char* scan =
    "NRRD0004\ntype: int16\ndimension: 3\nsizes: 3 2 2\nencoding: ascii\nspace: RAS\n"
    "space directions: (0.5,0,0) (0,1,0) (0,0,2)\nspace origin: (10,20,30)\n\n"
    "0 1 2 10 11 12 100 101 102 110 111 112\n";

// The scan is shown as a solid above a level; a design that reads it names it.

// For a loaded beam, the colours span the stresses that ombre info lists, and the beam is moved by its displacement.

TEST_F(StudioTest, ShowsPlanesOfAScan) {
  folder.write("a.nrrd", scan);
  const Data hello = ask("hello").first;
  EXPECT_EQ(*hello.find("data"), Data(DataList{DataMembers{{"name", "a.nrrd"}, {"kind", "scan"}}}));
  const Data found = ask("scan", R"("file": "a.nrrd")").first;
  EXPECT_EQ(*found.find("count"), Data(DataList{3.0, 2.0, 2.0})) << print_json(found);
  EXPECT_EQ(*found.find("steps_mm"), Data(DataList{0.5, 1.0, 2.0}));
  EXPECT_EQ(number_in(found, "greatest"), 112);
  const auto numbers = [&](int axis, int index, size_t count) {
    const auto [plane, bytes] =
        ask("plane", R"("file": "a.nrrd", "axis": )" + std::to_string(axis) + R"(, "index": )" + std::to_string(index));
    EXPECT_EQ(bytes.size(), 4 * count) << print_json(plane);
    std::vector<float> values(bytes.size() / 4);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  };
  EXPECT_EQ(numbers(2, 1, 6), (std::vector<float>{100, 101, 102, 110, 111, 112}));
  EXPECT_EQ(numbers(1, 0, 6), (std::vector<float>{0, 1, 2, 100, 101, 102}));
  EXPECT_EQ(numbers(0, 2, 4), (std::vector<float>{2, 12, 102, 112}));
  const Data voxel = ask("voxel", R"("file": "a.nrrd", "at": [2, 1, 0])").first;
  EXPECT_EQ(number_in(voxel, "value"), 12);
  EXPECT_EQ(*voxel.find("at_mm"), Data(DataList{11.0, 21.0, 30.0}));
  EXPECT_EQ(text(ask("voxel", R"("file": "a.nrrd", "at": [3, 1, 0])").first, "error"), "request");
  EXPECT_EQ(text(ask("plane", R"("file": "a.nrrd", "axis": 2, "index": 2)").first, "error"), "request");
  EXPECT_EQ(text(ask("scan", R"("file": "../a.nrrd")").first, "error"), "name");
  folder.write("b.nrrd", "no scan");
  EXPECT_EQ(text(ask("scan", R"("file": "b.nrrd")").first, "error"), "failed");
}

TEST_F(StudioTest, ShowsAScanByAScript) {
  folder.write("deep/a.nrrd", scan);
  const Data opened = ask("open", R"("file": "deep/a.nrrd")").first;
  EXPECT_EQ(text(opened, "kind"), "scan");
  const Data loaded = ask("load", R"("file": "deep/a.nrrd", "definitions": ["level=60"], "text": )" +
                                      print_json_line(text(opened, "text")))
                          .first;
  ASSERT_EQ(*loaded.find("ok"), Data(true)) << print_json(loaded);
  EXPECT_EQ(*loaded.find("scans"), Data(DataList{"deep/a.nrrd"}));
  const Data& level = loaded.find("variables")->list()->front();
  EXPECT_EQ(number_in(level, "least"), 0);
  EXPECT_EQ(number_in(level, "most"), 112);
}

TEST_F(StudioTest, ShowsResults) {
  std::filesystem::copy_file(source_file("examples/models/bent_beam.vtu"), folder.path / "beam.vtu");
  const Data opened = ask("open", R"("file": "beam.vtu")").first;
  EXPECT_EQ(text(opened, "kind"), "results") << print_json(opened);
  const auto load_deformed = [&](const std::string& factor) {
    return ask("load", R"("file": "beam.vtu", "definitions": ["deform=)" + factor + R"("], "text": )" +
                           print_json_line(text(opened, "text")))
        .first;
  };
  const Data loaded = load_deformed("0");
  if (print_json(loaded).find("pugixml") != std::string::npos) GTEST_SKIP();
  ASSERT_EQ(*loaded.find("ok"), Data(true)) << print_json(loaded);
  const Data picture = ask("render", R"("width": 40, "height": 30, "by": "von_Mises_stress", "design": ")" +
                                         text(loaded, "design") + '"')
                           .first;
  ASSERT_TRUE(picture.find("range")) << print_json(picture);
  EXPECT_NEAR(*picture.find("range")->list()->at(0).number(), 1.1089, 1e-3);
  EXPECT_NEAR(*picture.find("range")->list()->at(1).number(), 13.458, 1e-3);
  const auto lowest = [](const Data& design) {
    return *design.find("bounds_mm")->list()->at(0).list()->at(2).number();
  };
  EXPECT_NEAR(lowest(loaded), -2.5, 1e-6);
  EXPECT_NEAR(lowest(load_deformed("10")), -2.5 - 10 * 0.36225, 0.05);
}

TEST_F(StudioTest, OpensTablesAsTheyAre) {
  folder.write("history.csv", "round,change\n1,\n2,0.5\n");
  const Data opened = ask("open", R"("file": "history.csv")").first;
  EXPECT_EQ(text(opened, "kind"), "table");
  EXPECT_EQ(text(opened, "text"), "round,change\n1,\n2,0.5\n");
  EXPECT_EQ(
      text(ask("save", R"("file": "history.csv", "text": "", "version": ")" + text(opened, "version") + '"').first,
           "error"),
      "name");
}

}  // namespace
TEST(DataKinds, OfVolumesAreThoseThatJobsRead) {
  for (const char* name : {"a.nrrd", "b.NII.gz", "c.vdb", "d.raw", "e.hdr", "f.dcm"})
    EXPECT_EQ(data_kind(name), DataKind::scan) << name;
  for (const char* name : {"a.vcad", "raw", "b.png"}) EXPECT_EQ(data_kind(name), DataKind::none) << name;
}

}  // namespace ombre::studio
