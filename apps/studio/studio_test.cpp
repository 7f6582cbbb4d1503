#include "studio/studio.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <map>
#include <mutex>

#include "base/json.h"
#include "base/stopwatch.h"
#include "formats/png.h"
#include "studio/test_folder.h"

namespace ombre::studio {
namespace {

constexpr const char* ball =
    "radius = 3;  // [1:5]\n"
    "fgrade([\"0.5 + x / 6\", \"0.5 - x / 6\"], [red, blue]) sphere(radius);\n";

std::string to_base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t n = 0; n < bytes.size(); n += 3) {
    unsigned group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (n + k < bytes.size() ? static_cast<unsigned char>(bytes[n + k]) : 0);
    for (size_t k = 0; k < 4; ++k) text += n + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// Remembers what it was sent.
class Listener : public Client {
 public:
  void send(Frame frame) override {
    const std::lock_guard lock(mutex_);
    Data data;
    std::string bytes;
    Diagnostics none;
    if (frame.is_binary) {
      size_t length = 0;
      for (size_t n = 0; n < 4; ++n) length |= static_cast<size_t>(static_cast<unsigned char>(frame.data[n])) << 8 * n;
      bytes = frame.data.substr(4 + length);
      data = *parse_json(make_source("frame", frame.data.substr(4, length)), none);
    } else {
      data = *parse_json(make_source("frame", frame.data), none);
    }
    frames_.emplace_back(std::move(data), std::move(bytes));
    news_.notify_all();
  }

  // The first frame, and only it, for which the question holds; a null value after half a minute.
  template <class Question>
  std::pair<Data, std::string> wait(const Question& is_it) {
    std::unique_lock lock(mutex_);
    const auto found = [&] { return std::ranges::find_if(frames_, [&](const auto& f) { return is_it(f.first); }); };
    news_.wait_for(lock, std::chrono::seconds(30), [&] { return found() != frames_.end(); });
    const auto frame = found();
    if (frame == frames_.end()) return {};
    auto taken = *frame;
    frames_.erase(frame);
    return taken;
  }

 private:
  std::mutex mutex_;
  std::condition_variable news_;
  std::vector<std::pair<Data, std::string>> frames_;
};

class StudioTest : public testing::Test {
 protected:
  StudioTest() { studio.add(client); }

  std::pair<Data, std::string> ask(const std::string& what, const std::string& members = "") {
    const int id = ++last_;
    studio.take(client, R"({"id": )" + std::to_string(id) + R"(, "do": ")" + what + '"' +
                            (members.empty() ? "" : ", " + members) + "}");
    return answer(id);
  }
  std::pair<Data, std::string> answer(int id) {
    return client->wait([&](const Data& data) {
      const Data* found = data.find("id");
      return found && *found->number() == id;
    });
  }
  static std::string text(const Data& data, const char* name) {
    const Data* found = data.find(name);
    return found && found->string() ? *found->string() : "";
  }
  static double number_in(const Data& data, const char* name) {
    const Data* found = data.find(name);
    return found && found->number() ? *found->number() : std::nan("");
  }
  std::string load(const std::string& script, const std::string& more = "") {
    const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script) + more).first;
    EXPECT_TRUE(loaded.find("design")) << print_json(loaded);
    return text(loaded, "design");
  }
  // The job when it is in that state.
  Data job_in(const std::string& state) {
    const auto event = client->wait([&](const Data& data) {
      const Data* job = data.find("job");
      return data.find("event") && job && text(*job, "state") == state;
    });
    return event.first.is_null() ? Data() : *event.first.find("job");
  }

  TestFolder folder;
  std::vector<std::string> opened;  // folders that were to be shown
  sources::SourceCache cache;
  Studio studio{folder.path,
                {"ombre test", {}, "", 60, [this](const std::string& shown) { return opened.push_back(shown), true; }},
                cache};
  std::shared_ptr<Listener> client = std::make_shared<Listener>();
  int last_ = 0;
};

TEST_F(StudioTest, SaysWhatThereIs) {
  folder.write("b.vcad", ball);
  const Data hello = ask("hello").first;
  EXPECT_EQ(*hello.find("files"), Data(DataList{"b.vcad"}));
  EXPECT_GT(hello.find("nodes")->list()->size(), 50U);
  EXPECT_GT(hello.find("functions")->list()->size(), 20U);
  EXPECT_GT(hello.find("printers")->list()->size(), 2U);
}

TEST_F(StudioTest, AnswersWhatItDoesNotKnow) {
  EXPECT_EQ(text(ask("dance").first, "error"), "request");
  studio.take(client, "no JSON");
  EXPECT_EQ(text(answer(-1).first, "error"), "request");
  EXPECT_EQ(text(ask("render", R"("design": "d99", "width": 10, "height": 10)").first, "error"), "gone");
  EXPECT_EQ(text(ask("open", R"("file": "../a.vcad")").first, "error"), "name");
  EXPECT_EQ(text(ask("load", R"("file": "a.py", "text": "")").first, "error"), "unsupported");
}

TEST_F(StudioTest, TellsMistakesWithTheirPlaces) {
  const Data loaded = ask("load", R"("file": "a.vcad", "text": "// µ\nsphere(rad=3, gray);")").first;
  EXPECT_EQ(*loaded.find("ok"), Data(false));
  ASSERT_FALSE(loaded.find("diagnostics")->list()->empty());
  const Data& first = loaded.find("diagnostics")->list()->front();
  EXPECT_EQ(text(first, "severity"), "error");
  EXPECT_EQ(number_in(first, "line"), 2);
  EXPECT_EQ(number_in(first, "from"), 12);  // "rad", after 4 units, a line's end, and "sphere("
}

TEST_F(StudioTest, LoadsWithVariables) {
  const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(std::string(ball)) +
                                      R"(, "definitions": ["radius=4"])")
                          .first;
  const DataList& bounds = *loaded.find("bounds_mm")->list();
  EXPECT_NEAR(*bounds[1].list()->at(2).number(), 4, 1e-9);
  ASSERT_EQ(loaded.find("variables")->list()->size(), 1U);
  const Data& variable = loaded.find("variables")->list()->front();
  EXPECT_EQ(number_in(variable, "most"), 5);
  EXPECT_EQ(number_in(variable, "value"), 3);  // of the text
  EXPECT_EQ(number_in(variable, "from"), 9);
  EXPECT_EQ(number_in(variable, "to"), 10);
  const DataList& nodes = *loaded.find("nodes")->list();
  EXPECT_EQ(text(nodes.front(), "type"), "fgrade");
  EXPECT_EQ(number_in(nodes.front(), "line"), 2);
}

TEST_F(StudioTest, ListsFilesAsAScriptNamesThem) {
  for (const char* name : {"a.stl", "parts/b.STL", "parts/deep/c.obj", "other/d.stl", "parts/.hidden.stl", "e.png"})
    folder.write(name, "");
  const auto names = [&](const std::string& members) { return *ask("files_ending_in", members).first.find("files"); };
  EXPECT_EQ(names(R"("file": "a.vcad", "endings": [".stl"])"), Data(DataList{"a.stl", "other/d.stl", "parts/b.STL"}));
  EXPECT_EQ(names(R"("file": "parts/a.vcad", "endings": [".STL", ".obj"])"),
            Data(DataList{"../a.stl", "../other/d.stl", "b.STL", "deep/c.obj"}));
  EXPECT_EQ(names(R"("file": "a.vcad", "endings": [])"), Data(DataList{}));
  EXPECT_EQ(text(ask("files_ending_in", R"("file": "a.vcad", "endings": ["stl"])").first, "error"), "request");
  EXPECT_EQ(text(ask("files_ending_in", R"("file": "../a.vcad", "endings": [".stl"])").first, "error"), "name");
}

TEST_F(StudioTest, KeepsPresets) {
  const Data saved = ask("save_preset", R"("file": "a.vcad", "name": "large", "values": {"radius": 4.5})").first;
  const Data expected(DataList{DataMembers{{"name", "large"}, {"values", DataMembers{{"radius", "4.5"}}}}});
  EXPECT_EQ(*saved.find("presets"), expected);
  const Data told = client->wait([](const Data& data) { return data.find("event") != nullptr; }).first;
  EXPECT_EQ(text(told, "event") + text(told, "file"), "presetsa.vcad");
  EXPECT_EQ(*told.find("presets"), expected);
  EXPECT_EQ(*ask("presets", R"("file": "a.vcad")").first.find("presets"), expected);
  EXPECT_EQ(text(ask("save_preset", R"("file": "a.vcad", "name": "large", "values": {})").first, "error"), "exists");
  EXPECT_EQ(text(ask("save_preset", R"("file": "a.vcad", "name": "large")").first, "error"), "request");
  EXPECT_EQ(*ask("delete_preset", R"("file": "a.vcad", "name": "large")").first.find("presets"), Data(DataList{}));
  EXPECT_EQ(text(ask("presets", R"("file": "../a.vcad")").first, "error"), "name");
}

TEST_F(StudioTest, ShowsOpenScadScripts) {
  const auto load_script = [&](const std::string& script) {
    return ask("load", R"("file": "a.scad", "definitions": ["size=4"], "text": )" + print_json_line(script)).first;
  };
  const Data loaded =
      load_script("size = 2; // [1:9]\necho(size);\ncolor(\"red\") cube(size);\ntranslate([size, 0, 0]) cube(1);\n");
  if (print_json(loaded).find("built without CGAL") != std::string::npos) GTEST_SKIP();
  ASSERT_EQ(*loaded.find("ok"), Data(true)) << print_json(loaded);
  EXPECT_EQ(*loaded.find("echo"), Data(DataList{"ECHO: 4"}));
  ASSERT_EQ(loaded.find("variables")->list()->size(), 1U);
  const Data measured = ask("measure", R"("design": ")" + text(loaded, "design") + '"').first;
  EXPECT_NEAR(number_in(measured, "volume_mm3"), 65, 1);  // within half a voxel of its faces
  const Data& red = measured.find("materials")->list()->front();
  EXPECT_EQ(text(red, "name"), "red");
  EXPECT_NEAR(number_in(red, "volume_mm3"), 64, 1);

  const Data wrong = load_script("cube(4);\n  sphere(nothing());\n");
  ASSERT_FALSE(wrong.find("diagnostics")->list()->empty());
  EXPECT_EQ(number_in(wrong.find("diagnostics")->list()->front(), "line"), 2);
  EXPECT_EQ(*load_script("cube(").find("ok"), Data(false));
}

TEST_F(StudioTest, MeasuresABall) {
  const Data measured = ask("measure", R"("design": ")" + load(ball) + '"').first;
  const double volume = 4.0 / 3 * 3.14159265358979 * 27;
  EXPECT_NEAR(number_in(measured, "volume_mm3"), volume, 1e-3 * volume);
  ASSERT_EQ(measured.find("materials")->list()->size(), 2U);
  for (const Data& material : *measured.find("materials")->list())  // by symmetry
    EXPECT_NEAR(number_in(material, "volume_mm3"), volume / 2, 1e-3 * volume);
}

// A cube of 8 mm grows to 10 along x, loses 1 along z, and half of what stays (x < 4) is of another material.
TEST_F(StudioTest, ComparesTwoVersions) {
  const std::string before = load("translate(4, 4, 4) rectprism((8, 8, 8), red);");
  const std::string after = load(
      "translate(2, 4, 3.5) rectprism((4, 8, 7), blue);\n"
      "translate(7, 4, 3.5) rectprism((6, 8, 7), red);");
  const auto compare = [&](const std::string& old, const std::string& now) {
    return ask("compare", R"("before": ")" + old + R"(", "design": ")" + now + '"').first;
  };
  const Data found = compare(before, after);
  const double within = 0.02 * 448;  // half a voxel of 0.086 mm at a face
  EXPECT_NEAR(number_in(found, "gained_mm3"), 2 * 8 * 7, within) << print_json(found);
  EXPECT_NEAR(number_in(found, "lost_mm3"), 8 * 8 * 1, within);
  EXPECT_NEAR(number_in(found, "changed_mm3"), 4 * 8 * 7, within);
  EXPECT_NEAR(number_in(found, "unchanged_mm3"), 4 * 8 * 7, within);
  const Data back = compare(after, before);
  EXPECT_EQ(number_in(back, "lost_mm3"), number_in(found, "gained_mm3"));
  EXPECT_EQ(number_in(back, "gained_mm3"), number_in(found, "lost_mm3"));
  EXPECT_EQ(number_in(back, "changed_mm3"), number_in(found, "changed_mm3"));
  const Data same = compare(after, after);
  EXPECT_EQ(number_in(same, "gained_mm3") + number_in(same, "lost_mm3") + number_in(same, "changed_mm3"), 0);
  EXPECT_EQ(text(compare("d99", after), "error"), "gone");
}

// A scan of 3 x 2 x 2 voxels whose numbers are 100 k + 10 j + i.
constexpr const char* scan =
    "NRRD0004\ntype: int16\ndimension: 3\nsizes: 3 2 2\nencoding: ascii\nspace: RAS\n"
    "space directions: (0.5,0,0) (0,1,0) (0,0,2)\nspace origin: (10,20,30)\n\n"
    "0 1 2 10 11 12 100 101 102 110 111 112\n";

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

// The scan is a solid from its level on; a design that reads it names it.
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

// A beam under load: the colours span its stresses, which ombre info lists, and it is moved by its displacement.
TEST_F(StudioTest, ShowsResults) {
  std::filesystem::copy_file(std::filesystem::path(OMBRE_SOURCE_DIR) / "examples/models/bent_beam.vtu",
                             folder.path / "beam.vtu");
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

TEST_F(StudioTest, OpensFoldersOfItsOwn) {
  folder.write("a_slices/job.json", "{}");
  EXPECT_EQ(*ask("hello").first.find("opens_folders"), Data(true));
  ask("open_folder", R"("folder": "a_slices")");
  EXPECT_EQ(opened, std::vector<std::string>{(folder.path / "a_slices").string()});
  EXPECT_EQ(text(ask("open_folder", R"("folder": "gone")").first, "error"), "gone");
  EXPECT_EQ(text(ask("open_folder", R"("folder": "../a")").first, "error"), "name");
  EXPECT_EQ(opened.size(), 1U);
}

// A turned design is the one that the script would turn, in its bounds and in what is sliced.
TEST_F(StudioTest, TurnsDesigns) {
  const Data loaded =
      ask("load", R"("file": "a.vcad", "rotate": [90, 0, 0], "text": "rectprism((2, 4, 6), red);")").first;
  ASSERT_EQ(*loaded.find("ok"), Data(true)) << print_json(loaded);
  EXPECT_EQ(*loaded.find("bounds_mm"), Data(DataList{DataList{-1.0, -3.0, -2.0}, DataList{1.0, 3.0, 2.0}}));
  const std::string turned = R"("printer": "generic", "design": ")" + text(loaded, "design") + '"';
  const std::string written =
      R"("printer": "generic", "design": ")" + load("rotate((90, 0, 0)) rectprism((2, 4, 6), red);") + '"';
  EXPECT_EQ(*ask("plan", turned).first.find("count"), *ask("plan", written).first.find("count"));
  const std::string tile = R"(, "layer": 10, "x": 0, "y": 0, "width": 64, "height": 64)";
  EXPECT_EQ(ask("tile", turned + tile).second, ask("tile", written + tile).second);
}

TEST_F(StudioTest, MakesAndOpensBundles) {
  folder.write("shapes/a.vcad", "include <b.vcad>\nsphere(r);\n");
  folder.write("shapes/b.vcad", "r = 2;\n");
  const auto [made, bytes] = ask("bundle", R"("file": "shapes/a.vcad")");
  if (print_json(made).find("-DOMBRE_3MF=ON") != std::string::npos) GTEST_SKIP();
  EXPECT_EQ(*made.find("files"), Data(DataList{"a.vcad", "b.vcad"})) << print_json(made);
  const auto open = [&](const std::string& bundle) {
    return ask("unbundle", R"("name": "gift.ombre", "bytes": ")" + to_base64(bundle) + '"').first;
  };
  EXPECT_EQ(text(open(bytes), "file"), "gift/a.vcad");
  EXPECT_EQ(text(open(bytes), "file"), "gift_2/a.vcad");
  EXPECT_EQ(folder.read("gift_2/b.vcad"), "r = 2;\n");
  EXPECT_EQ(text(open(bytes.substr(0, bytes.size() / 2)), "error"), "design");
  EXPECT_FALSE(std::filesystem::exists(folder.path / "gift_3"));
  EXPECT_EQ(text(ask("unbundle", R"("name": "../../x.ombre", "bytes": "!")").first, "error"), "request");
  EXPECT_EQ(text(ask("bundle", R"("file": "../a.vcad")").first, "error"), "name");
}

// The gear is a mesh in a folder beside the example.
TEST_F(StudioTest, OpensCopiesOfExamples) {
  const Data examples = ask("examples").first;
  ASSERT_TRUE(examples.find("examples")) << print_json(examples);
  const DataList& list = *examples.find("examples")->list();
  EXPECT_TRUE(std::ranges::any_of(list, [](const Data& e) {
    return text(e, "name") == "gear" && text(e, "sentence").starts_with("A gear from a mesh");
  }));
  const Data opened = ask("open_example", R"("name": "gear")").first;
  if (print_json(opened).find("-DOMBRE_3MF=ON") != std::string::npos) GTEST_SKIP();
  EXPECT_EQ(text(opened, "file"), "gear/gear.vcad") << print_json(opened);
  EXPECT_TRUE(std::filesystem::exists(folder.path / "gear/models/gear.stl"));
  EXPECT_EQ(text(ask("open_example", R"("name": "../gear")").first, "error"), "name");
  EXPECT_EQ(text(ask("open_example", R"("name": "nothing")").first, "error"), "name");
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

// Half red and half blue everywhere becomes three quarters red: a quarter of it is of another material.
TEST_F(StudioTest, ComparesMixtures) {
  const auto mixed = [&](const std::string& red) {
    return load("fgrade([\"" + red + "\", \"1 - " + red + "\"], [red, blue]) rectprism((8, 8, 8));");
  };
  const std::string before = mixed("0.5"), after = mixed("0.75");
  const Data found = ask("compare", R"("before": ")" + before + R"(", "design": ")" + after + '"').first;
  EXPECT_NEAR(number_in(found, "changed_mm3"), 128, 3) << print_json(found);
  EXPECT_NEAR(number_in(found, "unchanged_mm3"), 384, 8);
  EXPECT_NEAR(number_in(found, "gained_mm3") + number_in(found, "lost_mm3"), 0, 1e-3);
}

TEST_F(StudioTest, PicturesStayWhereTheirCameraIs) {
  const std::string design = load("sphere(1, red);");
  const auto picture = [&](const std::string& target) {
    return ask("render", R"("design": ")" + design + R"(", "width": 40, "height": 40, "azimuth": 0, "elevation": 0, )" +
                             R"("height_mm": 8, "target": )" + target);
  };
  // Ten pixels a ball, in the middle; and 10 pixels to the left of it.
  const auto middle = formats::decode_png(picture("[0, 0, 0]").second, "middle");
  EXPECT_EQ(middle.colour(20, 20)[3], 255);
  EXPECT_EQ(middle.colour(20, 13)[3], 0);
  EXPECT_EQ(middle.colour(13, 20)[3], 0);
  const auto left = formats::decode_png(picture("[2, 0, 0]").second, "left");
  EXPECT_EQ(left.colour(10, 20)[3], 255);
  EXPECT_EQ(left.colour(20, 20)[3], 0);
  EXPECT_EQ(text(ask("render", R"("design": ")" + design + R"(", "width": 40, "height": 40, "cuts": ["q=1"])").first,
                 "error"),
            "request");
}

TEST_F(StudioTest, PicturesAreCutByWedgesAndBoxes) {
  const std::string design = load("sphere(1, red);");
  const auto alpha = [&](const std::string& how, uint32_t column, uint32_t row) {
    const std::string request = R"("design": ")" + design + R"(", "width": 40, "height": 40, "azimuth": 0, )" +
                                R"("elevation": 0, "height_mm": 2.4, "target": [0, 0, 0], )" + how;
    return static_cast<int>(formats::decode_png(ask("render", request).second, "cut").colour(column, row)[3]);
  };
  const std::string quarter = R"("cuts": ["x>0,z>0"])", box = R"("box": [-1, -1, -1, 0, 1, 0])";
  EXPECT_EQ(alpha(quarter, 27, 12), 0);
  EXPECT_EQ(alpha(quarter, 12, 12), 255);
  EXPECT_EQ(alpha(quarter, 27, 27), 255);
  EXPECT_EQ(alpha(box, 12, 27), 255);
  EXPECT_EQ(alpha(box, 27, 27), 0);
  EXPECT_EQ(alpha(box, 12, 12), 0);
  const std::string wrong = R"("design": ")" + design + R"(", "width": 40, "height": 40, "box": [0, 0, 0, 1, 1, -1])";
  EXPECT_EQ(text(ask("render", wrong).first, "error"), "request");
}

TEST_F(StudioTest, SaysWhichCallsMadeAPoint) {
  const std::string script =
      "translate(10, 0, 0) union() {\n"
      "  material(red) rotate(0, 0, 90) rectprism((2, 8, 2));\n"  // |x - 10| < 4, |y| < 1
      "  difference() {\n"
      "    sphere(3, blue);\n"
      "    sphere(1, red);\n"
      "  }\n"
      "  array_linear(3, (0, 5, 0)) sphere(1, green);\n"
      "}\n"
      "offset(1) union() { cube(2, red); translate(1, 0, 0) cube(2, red); }\n";
  const std::string design = load(script);
  const auto calls = [&](const std::string& at) {
    const Data probed = ask("probe", R"("at": )" + at + R"(, "design": ")" + design + '"').first;
    std::string path;
    for (const Data& node : *probed.find("nodes")->list()) {
      path += " " + text(node, "type");
      if (!node.find("from")) continue;
      const auto from = static_cast<size_t>(number_in(node, "from"));
      EXPECT_EQ(script.substr(from, text(node, "type").size()), text(node, "type")) << print_json(node);
      path += std::to_string(static_cast<int>(number_in(node, "line")));
    }
    return path;
  };
  EXPECT_EQ(calls("[13.5, 0.5, 0]"), " union translate1 union1 material2 rotate2 rectprism2");
  EXPECT_EQ(calls("[10, 2.5, 0]"), " union translate1 union1 difference3 sphere4");
  EXPECT_EQ(calls("[10, 10.5, 0]"), " union translate1 union1 array_linear7 sphere7");
  EXPECT_EQ(calls("[-1.5, 0, 0]"), " union offset9");
  EXPECT_EQ(calls("[30, 0, 0]"), "");
}

// What tiles and probes show is what the job writes.
TEST_F(StudioTest, TilesAndProbesAreTheJobsPixels) {
  const std::string design = load(ball), job = R"("design": ")" + design + R"(", "printer": "j750")";
  const Data plan = ask("plan", job).first;
  const auto count = [&](size_t axis) { return static_cast<int64_t>(*plan.find("count")->list()->at(axis).number()); };
  const auto mm = [&](const char* what, size_t axis) { return *plan.find(what)->list()->at(axis).number(); };
  ASSERT_EQ(count(0), 142);  // 6 mm at 600 dpi
  ASSERT_EQ(count(1), 71);
  const int64_t layer = count(2) / 2;
  ASSERT_FALSE(ask("export", job + R"(, "folder": "a_slices")").first.find("error"));
  ASSERT_FALSE(job_in("done").is_null());
  const std::string number = std::to_string(layer);
  const auto written = formats::decode_png(
      folder.read("a_slices/slice_" + std::string(5 - number.size(), '0') + number + ".png"), "layer");
  const auto tile = formats::decode_png(
      ask("tile", job + R"(, "layer": )" + number + R"(, "x": 32, "y": 8, "width": 64, "height": 48)").second, "tile");
  ASSERT_EQ(tile.width, 64U);
  ASSERT_EQ(tile.height, 48U);
  for (uint32_t row = 0; row < 48; ++row)
    for (uint32_t column = 0; column < 64; ++column) {
      const auto y = static_cast<uint32_t>(count(1)) - (8 + 48) + row;  // from the top
      ASSERT_EQ(tile.colour(column, row), written.colour(32 + column, y)) << column << ' ' << row;
    }

  const std::map<std::string, formats::Rgba> colours{
      {"red", {255, 0, 0, 255}}, {"blue", {0, 80, 255, 255}}, {"void", {0, 0, 0, 0}}};
  for (int64_t n = 0; n < 20; ++n) {
    const int64_t i = (37 * n) % count(0), j = (29 * n) % count(1);
    const auto at = [&](size_t axis, int64_t index) {
      return std::to_string(mm("origin_mm", axis) + mm("pitch_mm", axis) * (static_cast<double>(index) + 0.5));
    };
    const Data probed = ask("probe", job + R"(, "at": [)" + at(0, i) + "," + at(1, j) + "," + at(2, layer) + "]").first;
    const Data& voxel = *probed.find("voxel");
    EXPECT_EQ(*voxel.find("index"), Data(DataList{ombre::number(i), ombre::number(j), ombre::number(layer)}));
    EXPECT_EQ(colours.at(text(voxel, "material")),
              written.colour(static_cast<uint32_t>(i), static_cast<uint32_t>(count(1) - 1 - j)));
  }
}

TEST_F(StudioTest, JobsCoverTheDesignOrTheTray) {
  const std::string job = R"("design": ")" + load(ball) + R"(", "printer": "j750", "place": )";
  const Data middle = ask("plan", job + R"("center")").first;
  // 490 x 390 mm, at 600 and 300 dpi; above the ball are no layers.
  EXPECT_EQ(*middle.find("count"), Data(DataList{number(11575), number(4606), number(223)}));
  EXPECT_NEAR(*middle.find("origin_mm")->list()->front().number(), -245, 0.05);
  // The ball stands around the tray's corner.
  EXPECT_EQ(text(ask("plan", job + R"("tray")").first, "error"), "design");
  EXPECT_EQ(*ask("plan", job + R"("design")").first.find("count")->list()->front().number(), 142);
  EXPECT_EQ(text(ask("plan", job + R"("moon")").first, "error"), "request");
}

TEST_F(StudioTest, EstimatesWhatAJobTakes) {
  const std::string job = R"("printer": "j750", "design": ")" + load(ball) + '"';
  const Data estimate = ask("estimate", job).first;
  ASSERT_FALSE(estimate.find("error")) << print_json(estimate);
  ask("export", job + R"(, "folder": "a_slices")");
  ASSERT_FALSE(job_in("done").is_null());
  double bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path / "a_slices"))
    if (file.path().extension() == ".png") bytes += static_cast<double>(file.file_size());
  EXPECT_EQ(*estimate.find("is_least"), Data(false));
  EXPECT_GT(number_in(estimate, "bytes"), 0.5 * bytes);
  EXPECT_LT(number_in(estimate, "bytes"), 2 * bytes);
  EXPECT_GT(number_in(estimate, "seconds"), 0);
  EXPECT_GT(number_in(estimate, "memory_bytes"), 0);
  EXPECT_GT(number_in(estimate, "free_bytes"), 0);
}

TEST_F(StudioTest, VolumesHoldFractions) {
  const auto [header, bytes] = ask("volume", R"("side": 16, "design": ")" + load("rectprism((4, 4, 4), red);") + '"');
  ASSERT_TRUE(header.find("count")) << print_json(header);
  const DataList& count = *header.find("count")->list();
  const size_t voxels = static_cast<size_t>(*count[0].number() * *count[1].number() * *count[2].number());
  ASSERT_EQ(bytes.size(), 4 * voxels) << print_json(header);
  for (size_t n = 0; n < voxels; ++n) {
    ASSERT_EQ(bytes[4 * n], '\xff');
    ASSERT_EQ(bytes[4 * n + 1], '\0');
  }
}

TEST_F(StudioTest, NewerRequestsOfALaneCancelOlder) {
  const std::string script = "function f(n) = n < 2 ? 1 : f(n - 1) + f(n - 2);\nsphere(f(60));";
  const std::string request = R"(, "do": "load", "lane": "load", "file": "a.vcad", "text": )";
  const Stopwatch watch;
  studio.take(client, R"({"id": 101)" + request + print_json_line(script) + "}");
  studio.take(client, R"({"id": 102)" + request + R"("sphere(1);"})");
  EXPECT_EQ(text(answer(101).first, "error"), "cancelled");
  EXPECT_EQ(*answer(102).first.find("ok"), Data(true));
  studio.take(client, R"({"id": 103)" + request + print_json_line(script) + "}");
  studio.take(client, R"({"id": 103, "do": "cancel"})");
  EXPECT_EQ(text(answer(103).first, "error"), "cancelled");
  EXPECT_LT(watch.seconds(), 20);
}

// A job of some seconds.
constexpr const char* gyroid =
    "gyroid_block(20);\nmodule gyroid_block(s) intersection() { rectprism((s, s, s)); "
    "function(\"sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)\", red); }";

TEST_F(StudioTest, JobsPauseAndGoOn) {
  const std::string job = R"("printer": "j750", "folder": "a_slices", "design": ")" + load(gyroid) + '"';
  const Data started = ask("export", job).first;
  ASSERT_FALSE(started.find("error")) << text(started, "message");
  const std::string id = std::to_string(static_cast<int>(number_in(*started.find("job"), "id")));
  ASSERT_FALSE(job_in("working").is_null());
  EXPECT_EQ(text(ask("export", job).first, "error"), "busy");
  ask("change_export", R"("to": "pause", "job": )" + id);
  ASSERT_FALSE(job_in("paused").is_null());
  ASSERT_TRUE(std::filesystem::exists(folder.path / "a_slices/job.json"));
  ask("change_export", R"("to": "resume", "job": )" + id);
  const Data done = job_in("done");
  ASSERT_FALSE(done.is_null());
  EXPECT_EQ(number_in(done, "layers"), std::ceil(20 / 0.027 - 1e-6));
  EXPECT_EQ(text(ask("change_export", R"("to": "pause", "job": )" + id).first, "error"), "state");
  EXPECT_EQ(text(ask("change_export", R"("to": "pause", "job": 77)").first, "error"), "gone");
  EXPECT_EQ(text(ask("export", R"("printer": "j750", "folder": "../x", "design": ")" + load("sphere(1);") + '"').first,
                 "error"),
            "name");
}

// Files of this process end after so many bytes, as on a disk without space.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &usual_);
    const rlimit few{bytes, usual_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &few);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &usual_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit usual_{};
  void (*handler_)(int);
};

TEST_F(StudioTest, JobsGoOnWhenAFullDiskHasSpaceAgain) {
  const std::string job = R"("printer": "j750", "folder": "a_slices", "design": ")" + load(gyroid) + '"';
  const Data started = ask("export", job).first;
  const std::string id = std::to_string(static_cast<int>(number_in(*started.find("job"), "id")));
  ASSERT_FALSE(job_in("working").is_null());
  ask("change_export", R"("to": "pause", "job": )" + id);
  ASSERT_FALSE(job_in("paused").is_null());
  const std::filesystem::path last = folder.path / "a_slices/slice_00740.png";
  ASSERT_FALSE(std::filesystem::exists(last));
  {
    const FullDisk full(1000);
    ask("change_export", R"("to": "resume", "job": )" + id);
    const Data failed = job_in("failed");
    ASSERT_FALSE(failed.is_null());
    EXPECT_NE(text(failed, "message").find("cannot write"), std::string::npos) << text(failed, "message");
    EXPECT_FALSE(std::filesystem::exists(last));
  }
  ask("change_export", R"("to": "resume", "job": )" + id);
  ASSERT_FALSE(job_in("done").is_null());
  EXPECT_TRUE(std::filesystem::exists(last));
  for (const auto& file : std::filesystem::directory_iterator(folder.path / "a_slices"))
    EXPECT_NE(file.path().extension(), ".part") << file.path();
}

TEST_F(StudioTest, StopsScriptsWithoutEnd) {
  Studio impatient(folder.path, {"ombre test", {}, "", 0.3}, cache);
  impatient.add(client);
  const auto ask_impatient = [&](const std::string& script) {
    const int id = ++last_;
    impatient.take(client, R"({"do": "load", "file": "a.vcad", "id": )" + std::to_string(id) + R"(, "text": )" +
                               print_json_line(script) + "}");
    return answer(id).first;
  };
  const Stopwatch watch;
  const Data endless = ask_impatient("function f(n) = n < 2 ? 1 : f(n - 1) + f(n - 2);\nsphere(f(90));");
  EXPECT_EQ(text(endless, "error"), "time") << print_json(endless);
  EXPECT_NE(text(endless, "message").find("0.3 s"), std::string::npos);
  EXPECT_LT(watch.seconds(), 10);
  EXPECT_EQ(*ask_impatient("sphere(1);").find("ok"), Data(true));  // the next is answered
  impatient.remove(client);
}

TEST_F(StudioTest, SaysWhereScriptsCallThemselvesWithoutEnd) {
  for (const char* script : {"function f(n) = f(n + 1) + 1;\nsphere(f(0));", "module m() { m(); }\nm();"}) {
    const Data loaded = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(std::string(script))).first;
    EXPECT_EQ(*loaded.find("ok"), Data(false));
    ASSERT_FALSE(loaded.find("diagnostics")->list()->empty());
  }
}

// The limits are those of the language: 400 nodes inside each other, and 200 levels of text.
TEST_F(StudioTest, ShowsDeepDesignsAndRefusesDeeperOnes) {
  const auto nested = [](int depth) {
    return "module nest(n) { if (n > 0) translate(0, 0, 0.01) nest(n - 1); else sphere(1, red); }\nnest(" +
           std::to_string(depth) + ");";
  };
  const std::string design = load(nested(390));
  const Data probed = ask("probe", R"("at": [0, 0, 3.9], "design": ")" + design + '"').first;
  EXPECT_NEAR(number_in(probed, "distance_mm"), -1, 1e-6) << print_json(probed);
  EXPECT_FALSE(ask("render", R"("width": 20, "height": 20, "design": ")" + design + '"').second.empty());
  EXPECT_NEAR(number_in(ask("measure", R"("design": ")" + design + '"').first, "volume_mm3"), 4.18879, 0.01);
  std::string long_text;
  for (int n = 0; n < 100'000; ++n) long_text += "translate(0, 0, 0.01) ";
  for (const auto& [script, why] : {std::pair{nested(500), "deeper than 400"}, {long_text, "deeper than 200"}}) {
    const Data refused = ask("load", R"("file": "a.vcad", "text": )" + print_json_line(script)).first;
    EXPECT_EQ(*refused.find("ok"), Data(false));
    ASSERT_FALSE(refused.find("diagnostics")->list()->empty());
    const std::string told = text(refused.find("diagnostics")->list()->front(), "message");
    EXPECT_NE(told.find(why), std::string::npos) << told;
  }
  studio.take(client, R"({"id": 900, "do": "load", "x": )" + std::string(100'000, '[') + "}");
  EXPECT_EQ(text(answer(-1).first, "error"), "request");
}

TEST_F(StudioTest, TellsOfChangesOnTheDisk) {
  folder.write("a.vcad", "one");
  const std::string version = text(ask("open", R"("file": "a.vcad")").first, "version");
  folder.write("a.vcad", "three");
  studio.look_around();
  const Data event = client->wait([](const Data& data) { return data.find("event") != nullptr; }).first;
  EXPECT_EQ(text(event, "file"), "a.vcad");
  const Data saved = ask("save", R"("file": "a.vcad", "text": "mine", "version": ")" + version + '"').first;
  EXPECT_EQ(*saved.find("saved"), Data(false));
  EXPECT_EQ(text(saved, "text"), "three");
}

}  // namespace
}  // namespace ombre::studio
