#include "load/load.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/system/test_source_files.h"
#include "jobs/check/emit.h"
#include "jobs/probe/probe.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

bool is_inside(const LoadedPtr& loaded, Vec3 p) {
  Diagnostics diagnostics;
  const auto found = probe(*loaded, {p}, diagnostics);
  return found && found->front().inside;
}

}  // namespace

TEST(Load, UnchangedDesignReadsNoFileTwice) {
  const fs::path folder = fs::path(testing::TempDir()) / "ombre_load_twice";
  fs::create_directories(folder);
  const auto write = [&](const char* name, const char* text) {
    std::ofstream(folder / name) << text;
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::hours(1));
  };
  write("lib.vcad", "module ball() { sphere(2, \"red\"); }");
  write("a.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  write("a.vcad", "use <lib.vcad>\nunion() { ball(); mesh(\"a.off\", \"blue\"); text(\"A\", 3, 2, \"red\"); }");
  sources::SourceCache cache;
  LoadOptions options;
  options.cache = &cache;
  Diagnostics diagnostics;
  const std::string path = (folder / "a.vcad").string();
  const LoadedPtr first = load_design(path, options, diagnostics);
  ASSERT_TRUE(first) << to_text(diagnostics);
  const size_t reads = cache.files().reads();
  EXPECT_GE(reads, 4u);  // script, library, materials, mesh; a font, if there is one
  const LoadedPtr second = load_design(path, options, diagnostics);
  ASSERT_TRUE(second) << to_text(diagnostics);
  EXPECT_EQ(cache.files().reads(), reads);
  EXPECT_EQ(design::hash(first->design), design::hash(second->design));
  fs::remove_all(folder);
}

TEST(LoadText, PathsBeginInItsFolder) {
  Diagnostics diagnostics;
  const std::string folder = source_file("tests/cases/meshes/fixtures/");
  const LoadedPtr loaded = load_text("mesh(\"cube.off\", \"red\");", folder + "design.vcad", {}, diagnostics);
  ASSERT_TRUE(loaded) << to_text(diagnostics);
  EXPECT_EQ(loaded->path, folder + "design.vcad");
}

TEST(LoadText, EndingSaysTheLanguage) {
  Diagnostics diagnostics;
  const LoadedPtr script = load_text("sphere(2, \"red\");", "design.vcad", {}, diagnostics);
  ASSERT_TRUE(script) << to_text(diagnostics);
  EXPECT_TRUE(is_inside(script, {1.9, 0, 0}));
  EXPECT_FALSE(is_inside(script, {2.1, 0, 0}));
  const std::string json = emit(*script, "json");
  const LoadedPtr file = load_text(json, "design.json", {}, diagnostics);
  ASSERT_TRUE(file) << to_text(diagnostics);
  EXPECT_EQ(design::hash(file->design), design::hash(script->design));
}

TEST(LoadText, MessagesNameThePath) {
  Diagnostics diagnostics;
  EXPECT_FALSE(load_text("sphere(;", "x/design.vcad", {}, diagnostics));
  EXPECT_TRUE(to_text(diagnostics).starts_with("x/design.vcad:1:")) << to_text(diagnostics);
}

}  // namespace ombre::compile
