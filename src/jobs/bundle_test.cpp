#include "load/bundle.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/system/temporary_folder.h"
#include "formats/containers/file.h"
#include "formats/containers/zip_archive.h"
#include "formats/packages/package_writers.h"
#include "load/load.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

class Bundle : public testing::Test {
 protected:
  void SetUp() override {
    if (!formats::can_write_3mf()) GTEST_SKIP() << "this build has no zip archives";
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  std::optional<BundleContents> bundle(const std::string& script) {
    write(file("project/designs/part.vcad"), script);
    return write_bundle(file("project/designs/part.vcad"), file("part.ombre"), {}, diagnostics_);
  }
  // Returns the message about an archive with these entries.
  std::string refusal(const std::vector<std::pair<std::string, std::string>>& entries) {
    std::vector<formats::ZipEntry> zip;
    for (const auto& [name, bytes] : entries) {
      formats::LazyBytes lazy;
      lazy.add(bytes);
      zip.push_back({name, std::move(lazy)});
    }
    formats::write_zip(file("made.ombre"), zip);
    return refusal_of(formats::read_file(file("made.ombre")));
  }
  std::string refusal_of(const std::string& bytes) {
    Diagnostics diagnostics;
    const auto unpacked = unpack_bundle("made.ombre", bytes, file("out/here"), diagnostics);
    fs::remove_all(file("out/here"));
    EXPECT_TRUE(!fs::exists(file("out")) || fs::is_empty(file("out")));
    if (unpacked || diagnostics.list().empty()) return "";
    return diagnostics.list().front().message;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

constexpr const char* script =
    "include <../shared/sizes.vcad>\n"
    "translate(0, 0, radius) mesh(\"../shared/models/a.off\");\n";

constexpr const char* tetrahedron = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

TEST_F(Bundle, HoldsTheFilesThatADesignReads) {
  write(file("project/shared/sizes.vcad"), "radius = 5;\n");
  write(file("project/shared/models/a.off"), tetrahedron);
  write(file("project/secret.txt"), "not read");
  const auto contents = bundle(script);
  ASSERT_TRUE(contents) << diagnostics_.list().front().message;
  EXPECT_EQ(contents->design, "designs/part.vcad");
  EXPECT_EQ(contents->files,
            (std::vector<std::string>{"designs/part.vcad", "shared/models/a.off", "shared/sizes.vcad"}));
  fs::rename(file("project"), file("elsewhere"));
  const LoadedPtr loaded = load_design(file("part.ombre"), {}, diagnostics_);
  ASSERT_TRUE(loaded) << diagnostics_.list().front().message;
  EXPECT_EQ(loaded->design.parts.size(), 1U);
  EXPECT_TRUE(loaded->path.ends_with("part.ombre/designs/part.vcad"));
  fs::rename(file("elsewhere"), file("project"));
  const std::string first = formats::read_file(file("part.ombre"));
  ASSERT_TRUE(bundle(script));
  EXPECT_EQ(formats::read_file(file("part.ombre")), first);  // the same input gives the same bytes
}

TEST_F(Bundle, HoldsTheMaterials) {
  write(file("mine.json"), R"({"materials": [{"name": "jelly", "r": 1, "g": 2, "b": 3, "a": 255}]})");
  write(file("project/designs/part.vcad"), "sphere(3, jelly);\n");
  LoadOptions options;
  options.materials = file("mine.json");
  const auto contents = write_bundle(file("project/designs/part.vcad"), file("part.ombre"), options, diagnostics_);
  ASSERT_TRUE(contents) << diagnostics_.list().front().message;
  fs::remove(file("mine.json"));
  EXPECT_TRUE(load_design(file("part.ombre"), {}, diagnostics_)) << diagnostics_.list().front().message;
}

TEST_F(Bundle, RefusesFilesThatItWouldNotFindAgain) {
  write(file("project/designs/a.off"), tetrahedron);
  EXPECT_FALSE(bundle("mesh(\"" + file("project/designs/a.off") + "\");\n"));
  ASSERT_TRUE(diagnostics_.has_errors());
  EXPECT_NE(diagnostics_.list().front().message.find("which it would not find in a bundle"), std::string::npos);
  EXPECT_FALSE(fs::exists(file("part.ombre")));
  EXPECT_FALSE(fs::exists(file("part.ombre.part")));
}

TEST_F(Bundle, RefusesWhatIsNone) {
  EXPECT_NE(refusal_of("no archive").find("this is no bundle"), std::string::npos);
  EXPECT_NE(refusal_of("").find("this is no bundle"), std::string::npos);
  EXPECT_NE(refusal_of("PK\x03\x04 cut short").find("damaged"), std::string::npos);
  EXPECT_NE(refusal({{"a.vcad", "sphere(1);"}}).find("has no bundle.json"), std::string::npos);
  EXPECT_NE(refusal({{"bundle.json", "[1, 2"}}), "");
  EXPECT_EQ(refusal({{"bundle.json", "{}"}}), "the note of a bundle needs \"design\"");
  EXPECT_EQ(refusal({{"bundle.json", R"({"design": "a.vcad", "material": "m.json"})"}}),
            "the note of a bundle has no \"material\"");
  EXPECT_EQ(refusal({{"bundle.json", R"({"design": "../a.vcad"})"}}),
            "this names no file of the bundle, but the text \"../a.vcad\"");
  EXPECT_EQ(refusal({{"bundle.json", R"({"design": "a.vcad", "materials": 3})"}}),
            "this names no file of the bundle, but the number 3");
  EXPECT_NE(refusal({{"bundle.json", R"({"design": "a.vcad"})"}}).find("lacks its file a.vcad"), std::string::npos);
}

TEST_F(Bundle, RefusesNamesThatLeadOutOfIt) {
  const std::pair<std::string, std::string> note{"bundle.json", R"({"design": "a.vcad"})"}, design{"a.vcad", ""};
  EXPECT_EQ(refusal({note, design}), "");
  for (const char* name : {"../b.vcad", "/tmp/b.vcad", "c/../../b.vcad", "./b.vcad", "c//b.vcad", "c\\..\\b.vcad",
                           "C:b.vcad", "..", "a\nb.vcad"})
    EXPECT_NE(refusal({note, design, {name, "x"}}).find("leads out of it"), std::string::npos) << name;
}

// The archive has a link that points out of the folder, as zip archives of Unix may have.
TEST_F(Bundle, RefusesLinks) {
  refusal({{"bundle.json", R"({"design": "a.vcad"})"}, {"a.vcad", "/etc/passwd"}});
  std::string bytes = formats::read_file(file("made.ombre"));
  // An entry of the archive's directory has the system that made it, and above the low half the mode of its file.
  const size_t entry = bytes.rfind("PK\x01\x02");
  bytes[entry + 5] = 3;
  bytes[entry + 40] = '\xFF';
  bytes[entry + 41] = '\xA1';
  EXPECT_NE(refusal_of(bytes).find("is a link"), std::string::npos);
}

TEST_F(Bundle, RefusesMoreThanItMayHold) {
  refusal({{"bundle.json", R"({"design": "a.vcad"})"}, {"a.vcad", std::string(10'000'000, ' ')}});
  std::string bytes = formats::read_file(file("made.ombre"));
  // The archive's directory promises 2 GiB.
  const size_t size = bytes.rfind("PK\x01\x02") + 24;
  bytes.replace(size, 4, std::string("\0\0\0\x80", 4));
  EXPECT_NE(refusal_of(bytes).find("at most 1,073,741,824 bytes"), std::string::npos);
}

}  // namespace
}  // namespace ombre::compile
