#include "sources/loading.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/system/not_copied.h"
#include "formats/containers/hdf5.h"

namespace ombre::sources {
namespace {

namespace fs = std::filesystem;
using design::MeshRequest;
using design::PolygonsRequest;

// A folder that is removed with its files at the end.
class Folder : NotCopied {
 public:
  explicit Folder(const std::string& name) : path_(fs::path(testing::TempDir()) / name) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }

  // Writes a file whose modification time is this many seconds ago.
  std::string write(const std::string& name, const std::string& text, int seconds_ago = 100) const {
    const fs::path path = path_ / name;
    std::ofstream(path, std::ios::binary) << text;
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::seconds(seconds_ago));
    return path.string();
  }

 private:
  fs::path path_;
};

// Returns a tetrahedron with a corner at the origin and edges of this length along the axes.
std::string tetrahedron(int length) {
  const std::string l = std::to_string(length);
  return "OFF\n4 4 0\n0 0 0\n" + l + " 0 0\n0 " + l + " 0\n0 0 " + l + "\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

// Returns a tetrahedron with an overlapping one that faces inward, which causes a warning.
std::string with_inverted_shell() {
  return "OFF\n8 8 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n1 0.5 0.5\n4 0.5 0.5\n1 3.5 0.5\n1 0.5 3.5\n"
         "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 5 6\n3 4 7 5\n3 4 6 7\n3 5 7 6\n";
}

class DesignOfTest : public Loader {
 public:
  explicit DesignOfTest(SourceCache& cache) : Loader(cache) {}
  design::StagePtr support(const design::NodePtr&, const design::SupportUse&, const design::Reader&) override {
    return nullptr;
  }

  auto mesh(const std::string& path, design::MeshUse use = {}) {
    MeshRequest request{{path, {}}, std::move(use)};
    return source(request, reader());
  }
  auto solids(std::vector<design::MadeSolid> list, design::MeshUse use = {}) {
    design::SolidsRequest request{"made", std::make_shared<const std::vector<design::MadeSolid>>(std::move(list)),
                                  std::move(use)};
    return source(request, reader());
  }
  auto volume(const std::string& path) {
    design::VolumeRequest request{{path, {}}};
    return source(request, reader());
  }
  auto volume(design::VolumeRequest request) { return source(request, reader()); }
  auto results(const std::string& path) {
    design::ResultsRequest request;
    request.file.path = path;
    return source(request, reader());
  }
  auto square(double side) {
    PolygonsRequest request{{{{{0, 0}, {side, 0}, {side, side}, {0, side}}}, {}}, false};
    return source(request, reader());
  }

  design::Reader reader() { return {materials_, diagnostics, this, {}, "", ""}; }

  Diagnostics diagnostics;

 private:
  design::MaterialTable materials_;
};

}  // namespace

TEST(SourceCache, SecondDesignReadsNoFile) {
  const Folder folder("ombre_sources_second");
  const std::string path = folder.write("a.off", tetrahedron(3));
  SourceCache cache;
  const auto first = DesignOfTest(cache).mesh(path);
  ASSERT_TRUE(first);
  EXPECT_EQ(cache.files().reads(), 1u);
  EXPECT_EQ(DesignOfTest(cache).mesh(path), first);
  EXPECT_EQ(cache.files().reads(), 1u);
}

TEST(SourceCache, SameContentAndOptionsAreTheSameSource) {
  const Folder folder("ombre_sources_same");
  const std::string a = folder.write("a.off", tetrahedron(3)), b = folder.write("b.off", tetrahedron(3));
  SourceCache cache;
  DesignOfTest one(cache), other(cache);
  EXPECT_EQ(one.mesh(a), other.mesh(b));
  design::MeshUse parity;
  parity.inside = "parity";
  EXPECT_NE(one.mesh(a), one.mesh(a, parity));
  EXPECT_EQ(one.square(3), other.square(3));
  EXPECT_NE(one.square(3), one.square(4));
}

TEST(SourceCache, ReadsAgainWhatHasChanged) {
  const Folder folder("ombre_sources_changed");
  const std::string path = folder.write("a.off", tetrahedron(3));
  SourceCache cache;
  const auto before = DesignOfTest(cache).mesh(path);
  folder.write("a.off", tetrahedron(5), 50);
  const auto after = DesignOfTest(cache).mesh(path);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->front().source->bounds().hi.x, 3);
  EXPECT_EQ(after->front().source->bounds().hi.x, 5);
  // The file is only touched: it is read again and found unchanged.
  const size_t reads = cache.files().reads();
  folder.write("a.off", tetrahedron(5), 20);
  EXPECT_EQ(DesignOfTest(cache).mesh(path), after);
  EXPECT_EQ(cache.files().reads(), reads + 1);
}

TEST(SourceCache, DescriptionsBesideAFileCountToo) {
  const Folder folder("ombre_sources_volume");
  const std::string start = R"({"data_type": "uint8", "dimensions": [2, 2, 1], "spacing_mm": [)";
  const std::string path = folder.write("a.raw", "0123");
  folder.write("a.raw.json", start + "1, 1, 1]}");
  SourceCache cache;
  const auto first = DesignOfTest(cache).volume(path);
  ASSERT_TRUE(first);
  const size_t reads = cache.files().reads();
  EXPECT_EQ(DesignOfTest(cache).volume(path), first);
  EXPECT_EQ(cache.files().reads(), reads);
  folder.write("a.raw.json", start + "1, 2, 1]}", 50);
  const auto second = DesignOfTest(cache).volume(path);
  ASSERT_TRUE(second && second->space_from_index);
  EXPECT_EQ((*second->space_from_index)({0, 1, 0}), (Vec3{0, 2, 0}));
}

// The file of HDF5 has the points of the mesh.
TEST(SourceCache, NumbersBesideAMeshCountToo) {
  const Folder folder("ombre_sources_numbers");
  const std::vector<double> small{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, large{0, 0, 0, 5, 0, 0, 0, 5, 0, 0, 0, 5};
  const auto points = [](const std::vector<double>& list) {
    return formats::hdf5_file({{"/points", formats::Hdf5Array::Kind::float64, {4, 3}, list.data()}});
  };
  if (!has_module(formats::hdf5_library)) GTEST_SKIP() << without(formats::hdf5_library);
  const std::string path = folder.write(
      "a.xdmf",
      "<Xdmf><Domain><Grid><Topology TopologyType=\"Tetrahedron\"><DataItem>0 1 2 3</DataItem></Topology>"
      "<Geometry GeometryType=\"XYZ\"><DataItem Format=\"HDF\">a.h5:/points</DataItem></Geometry>"
      "<Attribute Name=\"t\" Center=\"Node\"><DataItem>1 2 3 4</DataItem></Attribute></Grid></Domain></Xdmf>");
  folder.write("a.h5", points(small));
  SourceCache cache;
  DesignOfTest design(cache);
  const auto first = design.mesh(path);
  const auto values = design.results(path);
  if (!first && to_text(design.diagnostics).find("without libzip and pugixml") != std::string::npos) GTEST_SKIP();
  ASSERT_TRUE(first && values) << to_text(design.diagnostics);
  EXPECT_EQ(DesignOfTest(cache).mesh(path), first);
  EXPECT_EQ(DesignOfTest(cache).results(path)->source, values->source);
  folder.write("a.h5", points(large), 50);
  const auto second = DesignOfTest(cache).mesh(path);
  const auto moved = DesignOfTest(cache).results(path);
  ASSERT_TRUE(second && moved);
  EXPECT_EQ(first->front().source->bounds().hi.x, 1);
  EXPECT_EQ(second->front().source->bounds().hi.x, 5);
  EXPECT_NE(moved->source, values->source);
}

TEST(SourceCache, TrustsNoTimeThatIsTooRecent) {
  const Folder folder("ombre_sources_recent");
  const std::string path = folder.write("a.off", tetrahedron(3), -3600);
  SourceCache cache;
  ASSERT_TRUE(DesignOfTest(cache).mesh(path));
  folder.write("a.off", tetrahedron(5), -3600);
  const auto after = DesignOfTest(cache).mesh(path);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->front().source->bounds().hi.x, 5);
}

TEST(SourceCache, DropsWhatWasUsedLeastRecently) {
  SourceCache cache;
  const auto key = [](int n) { return hash_bytes(std::to_string(n)); };
  const auto add = [&](int n) { cache.add(key(n), {std::make_shared<int>(n), 100, "", {}, {}}); };
  cache.set_most_bytes(250);
  add(1);
  add(2);
  EXPECT_TRUE(cache.find(key(1)));
  add(3);
  EXPECT_TRUE(cache.find(key(1)));
  EXPECT_FALSE(cache.find(key(2)));
  EXPECT_TRUE(cache.find(key(3)));
  EXPECT_EQ(cache.bytes(), 200u);
  cache.set_most_bytes(100);
  EXPECT_EQ(cache.bytes(), 100u);
  EXPECT_TRUE(cache.find(key(3)));
}

TEST(SourceCache, FindsWhatADesignStillUses) {
  SourceCache cache(50);
  const Hash key = hash_bytes("large");
  CacheEntryPtr used = cache.add(key, {std::make_shared<int>(1), 100, "", {}, {}});
  EXPECT_EQ(cache.bytes(), 0u);
  EXPECT_EQ(cache.find(key), used);
  used.reset();
  EXPECT_FALSE(cache.find(key));
}

TEST(SourceCache, SaysAgainToEachDesignWhatThereIsToSay) {
  const Folder folder("ombre_sources_remarks");
  const std::string a = folder.write("a.off", with_inverted_shell()), b = folder.write("b.off", with_inverted_shell());
  SourceCache cache;
  DesignOfTest first(cache), second(cache), third(cache);
  ASSERT_TRUE(first.mesh(a));
  ASSERT_EQ(first.diagnostics.list().size(), 1u);
  const auto known = second.mesh(a);
  ASSERT_EQ(second.diagnostics.list().size(), 1u);
  EXPECT_EQ(second.diagnostics.list()[0], first.diagnostics.list()[0]);
  EXPECT_EQ(second.mesh(a), known);
  EXPECT_EQ(second.diagnostics.list().size(), 1u);
  // The diagnostic uses this design's name of the file.
  ASSERT_TRUE(third.mesh(b));
  ASSERT_EQ(third.diagnostics.list().size(), 1u);
  EXPECT_NE(third.diagnostics.list()[0].message.find("b.off"), std::string::npos);
}

TEST(SourceCache, ThreadsShareWhatTheyLoad) {
  const Folder folder("ombre_sources_threads");
  std::vector<std::string> paths;
  for (int n = 1; n <= 8; ++n) paths.push_back(folder.write(std::to_string(n) + ".off", tetrahedron(n)));
  SourceCache cache;
  using Parts = std::vector<design::MeshPart>;
  std::vector<std::vector<std::shared_ptr<const Parts>>> found(4);
  std::vector<std::thread> threads;
  for (auto& mine : found)
    threads.emplace_back([&] {
      DesignOfTest own(cache);
      for (const std::string& path : paths) mine.push_back(own.mesh(path));
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& others : found) EXPECT_EQ(others, found[0]);
}

// Returns a tetrahedron with its corner at `x` on the x axis.
design::MadeSolid made_tetrahedron(const std::string& material, double x) {
  return {"p",
          material,
          {},
          {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST(MadeSolids, AreMeshesByMaterial) {
  SourceCache cache;
  DesignOfTest own(cache);
  const std::string first = own.reader().materials.first().name;
  design::MeshUse use;
  use.material = {&own.reader().materials.first()};
  const auto one = own.solids({made_tetrahedron("", 0), made_tetrahedron("", 2)}, use);
  ASSERT_TRUE(one);
  ASSERT_EQ(one->size(), 1u);
  const program::FieldSource& source = *one->front().source;
  EXPECT_EQ(source.sample(source.channel("inside"), {2.1, 0.1, 0.1}), 1);
  EXPECT_EQ(source.sample(source.channel("inside"), {1.5, 0.1, 0.1}), 0);
  EXPECT_NEAR(source.sample(source.channel("distance"), {1.5, 0, 0}), 0.5, 1e-6);
  use.materials = "names";
  EXPECT_TRUE(own.solids({made_tetrahedron(first, 0)}, use));
  EXPECT_FALSE(own.diagnostics.has_errors());
  EXPECT_FALSE(own.solids({made_tetrahedron("unobtainium", 0)}, use));
  ASSERT_EQ(own.diagnostics.list().size(), 1u);
  EXPECT_TRUE(own.diagnostics.list()[0].hint.text().starts_with("there are "));
  EXPECT_FALSE(own.solids({}, use));
}

TEST(SourceCache, FailuresAreNotKept) {
  const Folder folder("ombre_sources_failures");
  const std::string path = folder.write("a.off", "OFF\n1 1 0\n0 0 0\n3 0 1 2\n");
  SourceCache cache;
  DesignOfTest first(cache), second(cache);
  EXPECT_FALSE(first.mesh(path));
  EXPECT_FALSE(second.mesh(path));
  EXPECT_TRUE(second.diagnostics.has_errors());
  EXPECT_EQ(cache.bytes(), 0u);
}

namespace {

std::string nrrd_in(const std::string& space) {
  return "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 1\nencoding: raw\nspace: " + space +
         "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n\na";
}

}  // namespace

// A patient's left is positive in one and negative in the other.
TEST(Volumes, OtherAxesAreAWarningOnce) {
  const Folder folder("ombre_sources_axes");
  const std::string lps = folder.write("lps.nrrd", nrrd_in("LPS")), ras = folder.write("ras.nrrd", nrrd_in("RAS"));
  SourceCache cache;
  DesignOfTest design(cache);
  ASSERT_TRUE(design.volume(lps));
  EXPECT_TRUE(design.diagnostics.list().empty());
  ASSERT_TRUE(design.volume(ras));
  ASSERT_TRUE(design.volume(lps));
  ASSERT_EQ(design.diagnostics.list().size(), 1U);
  const std::string& message = design.diagnostics.list()[0].message;
  EXPECT_NE(message.find("ras.nrrd\" has the axes RAS"), std::string::npos) << message;
  EXPECT_NE(message.find("lps.nrrd\" the axes LPS"), std::string::npos) << message;
  DesignOfTest turned(cache);
  ASSERT_TRUE(turned.volume(lps));
  design::VolumeRequest request{{ras, {}}};
  request.has_space = true;
  ASSERT_TRUE(turned.volume(request));
  EXPECT_TRUE(turned.diagnostics.list().empty());
}

// The number in place of NaN belongs to the key of a source.
TEST(Volumes, NanIsReplacedForEachRequest) {
  const Folder folder("ombre_sources_nan");
  const std::string path = folder.write("nan.nrrd",
                                        "NRRD0004\ntype: float\ndimension: 3\nsizes: 1 1 1\nencoding: ascii\n"
                                        "spacings: 1 1 1\n\nnan");
  SourceCache cache;
  DesignOfTest design(cache);
  EXPECT_FALSE(design.volume(path));
  for (const double number : {3.0, 4.0}) {
    design::VolumeRequest request{{path, {}}};
    request.nan = number;
    const auto grid = design.volume(request);
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->source->sample(1, {0, 0, 0}), number);
  }
}

}  // namespace ombre::sources
