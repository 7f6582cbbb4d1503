// Tests of requests about the folder, about scripts and about their errors.
#include <sys/stat.h>

#include "base/text/json.h"
#include "studio/test_studio.h"

namespace ombre::studio {
namespace {

// A rotated design has the bounds and slices of one rotated by the script.

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

// A page that has stayed open takes no other design for its own.
TEST_F(StudioTest, HandlesOfDesignsAreNotThoseOfAnotherStart) {
  FreshStudio other;
  EXPECT_NE(load(ball), other.load(ball));
}

TEST_F(StudioTest, TellsMistakesWithTheirPlaces) {
  const Data loaded = ask("load", R"("file": "a.vcad", "text": "// µ\nsphere(rad=3, gray);")").first;
  EXPECT_EQ(*loaded.find("ok"), Data(false));
  ASSERT_FALSE(loaded.find("diagnostics")->list()->empty());
  const Data& first = loaded.find("diagnostics")->list()->front();
  EXPECT_EQ(text(first, "severity"), "error");
  EXPECT_EQ(number_in(first, "line"), 2);
  EXPECT_EQ(number_in(first, "from"), 12);  // position of "rad", after 4 units, a line end and "sphere("
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
  EXPECT_EQ(number_in(variable, "value"), 3);  // value in the text
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
  const Data message = client->wait([](const Data& data) { return data.find("event") != nullptr; }).first;
  EXPECT_EQ(text(message, "event") + text(message, "file"), "presetsa.vcad");
  EXPECT_EQ(*message.find("presets"), expected);
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
  EXPECT_NEAR(number_in(measured, "volume_mm3"), 65, 1);  // within half a voxel at its faces
  const Data& red = measured.find("materials")->list()->front();
  EXPECT_EQ(text(red, "name"), "red");
  EXPECT_NEAR(number_in(red, "volume_mm3"), 64, 1);

  const Data wrong = load_script("cube(4);\n  sphere(nothing());\n");
  ASSERT_FALSE(wrong.find("diagnostics")->list()->empty());
  EXPECT_EQ(number_in(wrong.find("diagnostics")->list()->front(), "line"), 2);
  EXPECT_EQ(*load_script("cube(").find("ok"), Data(false));
}

TEST_F(StudioTest, ShowsOpenScadScriptsWithoutColours) {
  const Data loaded = ask("load", R"("file": "a.scad", "text": "cube(4); translate([6, 0, 0]) cube(1);")").first;
  if (print_json(loaded).find("built without CGAL") != std::string::npos) GTEST_SKIP();
  ASSERT_EQ(*loaded.find("ok"), Data(true)) << print_json(loaded);
  const Data measured = ask("measure", R"("design": ")" + text(loaded, "design") + '"').first;
  EXPECT_NEAR(number_in(measured, "volume_mm3"), 65, 1);
}

// 100 echoes of 2 MiB each; what is left out is counted.
TEST_F(StudioTest, BoundsWhatScriptsSay) {
  const std::string giant = "function twice(s, n) = n == 0 ? s : twice(str(s, s), n - 1);\n";
  const Data loaded =
      ask("load", R"("file": "a.scad", "text": )" +
                      print_json_line(giant + "s = twice(\"x\", 21); for (n = [1:300]) echo(s);\ncube(1);"))
          .first;
  const DataList& echo = *loaded.find("echo")->list();
  EXPECT_LE(echo.size(), 201U);
  size_t bytes = 0;
  for (const Data& line : echo) bytes += line.string()->size();
  EXPECT_LT(bytes, 200U << 10);
  EXPECT_NE(echo.back().string()->find("more lines"), std::string::npos) << *echo.back().string();
}

TEST_F(StudioTest, ImportsWhatPeopleHave) {
  const std::string solid = "OFF\n4 4 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const auto piece = [&](const std::string& file, const std::string& bytes, const std::string& more) {
    return ask("upload", R"("upload": "u1", "at": 0, "last": true, "file": ")" + file + R"(", "bytes": ")" +
                             to_base64(bytes) + '"' + more)
        .first;
  };
  ASSERT_FALSE(piece("models/part.off", solid, "").find("error"));
  EXPECT_EQ(text(piece("models/part.off", "other", ""), "error"), "exists");
  EXPECT_EQ(folder.read("models/part.off"), solid);
  EXPECT_EQ(*ask("is_there", R"("files": ["models/part.off", "b.off"])").first.find("files"),
            Data(DataList{"models/part.off"}));
  const Data listed = ask("list").first;
  EXPECT_EQ(*listed.find("data"), Data(DataList{DataMembers{{"name", "models/part.off"}, {"kind", "model"}}}));
  for (const char* name : {"models/part.vcad", "models/part_2.vcad"}) {
    EXPECT_EQ(text(ask("import", R"("file": "models/part.off")").first, "file"), name);
    const std::string script = folder.read(name);
    const Data loaded = ask("load", R"("file": "models/part.vcad", "text": )" + print_json_line(script)).first;
    ASSERT_EQ(*loaded.find("ok"), Data(true)) << print_json(loaded);
    EXPECT_EQ(*loaded.find("bounds_mm"), Data(DataList{DataList{0.0, 0.0, 0.0}, DataList{4.0, 4.0, 4.0}}));
  }
  EXPECT_EQ(text(ask("open", R"("file": "models/part.off")").first, "text"), folder.read("models/part.vcad"));
  EXPECT_EQ(text(ask("import", R"("file": "none.off")").first, "error"), "gone");
  folder.write("notes.txt", "");
  EXPECT_EQ(text(ask("import", R"("file": "notes.txt")").first, "error"), "unsupported");
}

TEST_F(StudioTest, RefusesPipes) {
  ASSERT_EQ(::mkfifo((folder.path / "pipe.vcad").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder.path / "pipe.nrrd").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder.path / "pipe.off").c_str(), 0600), 0);
  for (const char* name : {"pipe.vcad", "pipe.nrrd", "pipe.off"}) {
    EXPECT_EQ(text(ask("open", R"("file": ")" + std::string(name) + '"').first, "error"), "name") << name;
    EXPECT_EQ(text(ask("download", R"("file": ")" + std::string(name) + '"').first, "error"), "name") << name;
  }
  EXPECT_EQ(*ask("load", R"("file": "a.vcad", "text": "mesh(\"pipe.off\", red);")").first.find("ok"), Data(false));
  EXPECT_EQ(*ask("load", R"("file": "a.vcad", "text": "volume_solid(\"pipe.nrrd\");")").first.find("ok"), Data(false));
}

TEST_F(StudioTest, FilesAreRenamedDuplicatedAndDeleted) {
  folder.write("a.vcad", "text");
  ask("rename", R"("file": "a.vcad", "to": "b.vcad")");
  const Data event = client->wait([](const Data& data) { return text(data, "event") == "list"; }).first;
  EXPECT_EQ(*event.find("files"), Data(DataList{"b.vcad"}));
  ask("duplicate", R"("file": "b.vcad", "to": "c.vcad")");
  EXPECT_EQ(*ask("list").first.find("files"), Data(DataList{"b.vcad", "c.vcad"}));
  const Data deleted = ask("delete", R"("file": "b.vcad")").first;
  EXPECT_EQ(*ask("list").first.find("files"), Data(DataList{"c.vcad"}));
  EXPECT_TRUE(std::filesystem::exists(text(deleted, "trash")));
  ask("make_folder", R"("name": "parts")");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path / "parts"));
}

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

TEST_F(StudioTest, TellsOfChangesOnTheDisk) {
  folder.write("a.vcad", "one");
  const std::string version = text(ask("open", R"("file": "a.vcad")").first, "version");
  folder.write("a.vcad", "three");
  studio.check_disk();
  const Data event = client->wait([](const Data& data) { return data.find("event") != nullptr; }).first;
  EXPECT_EQ(text(event, "file"), "a.vcad");
  const Data saved = ask("save", R"("file": "a.vcad", "text": "mine", "version": ")" + version + '"').first;
  EXPECT_EQ(*saved.find("saved"), Data(false));
  EXPECT_EQ(text(saved, "text"), "three");
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

}  // namespace
}  // namespace ombre::studio
