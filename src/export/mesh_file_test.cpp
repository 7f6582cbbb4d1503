#include "export/mesh_file.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>

#include "export/test_folder.h"
#include "formats/containers/file.h"
#include "formats/packages/package_writers.h"

namespace ombre::exporting {
namespace {

formats::MeshDocument triangle() {
  return {"t", {{"red", {255, 0, 0, 255}}}, {{"t", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, 0}}};
}

using MeshFile = FolderTest;

std::string failure(const std::string& path, const formats::MeshDocument& document, const MeshFormat& format) {
  return failure_of([&] { write_mesh_file(path, document, format); });
}

TEST_F(MeshFile, HasItsNameAndNoOther) {
  std::vector<std::string> written{"a.amf", "a.glb", "a.off", "a.ply", "a.stl"};
  if (formats::can_write_3mf()) written.insert(written.begin(), "a.3mf");
  for (const std::string& name : written) write_mesh_file(path(name), triangle(), *formats::find_mesh_format(name));
  EXPECT_EQ(names(), written);
}

TEST_F(MeshFile, ObjHasItsMaterialsBeside) {
  write_mesh_file(path("a.b.obj"), triangle(), *formats::find_mesh_format("a.obj"));
  EXPECT_EQ(names(), (std::vector<std::string>{"a.b.mtl", "a.b.obj"}));
  EXPECT_NE(formats::read_file(path("a.b.obj")).find("mtllib a.b.mtl\n"), std::string::npos);
  formats::MeshDocument plain = triangle();
  plain.materials.clear();
  plain.bodies[0].material.reset();
  write_mesh_file(path("plain.obj"), plain, *formats::find_mesh_format("a.obj"));
  EXPECT_EQ(names().size(), 3u);
}

TEST_F(MeshFile, FailuresNameThePathAndLeaveWhatWasThere) {
  for (const std::string name : {"a.3mf", "a.obj", "a.stl"}) {
    if (name == "a.3mf" && !formats::can_write_3mf()) continue;
    const std::string missing = path("none/" + name);
    EXPECT_EQ(failure(missing, triangle(), *formats::find_mesh_format(name)),
              "cannot write " + (name == "a.obj" ? path("none/a.mtl") : missing) +
                  ": No such file or directory; the folder is missing");
    put(name, "mine");
    EXPECT_NE(failure(path(name), {}, *formats::find_mesh_format(name)).find("there are no triangles"),
              std::string::npos);
    EXPECT_EQ(formats::read_file(path(name)), "mine");
  }
}

TEST_F(MeshFile, FullDisksAreReported) {
  for (const char* name : {"a.stl", "a.amf", "a.obj"}) {
    fill_disk_of(name);
    EXPECT_NE(failure(path(name), triangle(), *formats::find_mesh_format(name))
                  .find("No space left on device; free some space"),
              std::string::npos)
        << name;
  }
  EXPECT_TRUE(names().empty());
}

// The process's limit on file sizes is lowered to a few bytes.
TEST_F(MeshFile, FullDisksLeaveNoArchive) {
  if (!formats::can_write_3mf()) GTEST_SKIP() << "no 3MF in this build";
  rlimit usual{};
  getrlimit(RLIMIT_FSIZE, &usual);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit few{100, usual.rlim_max};
  setrlimit(RLIMIT_FSIZE, &few);
  const std::string message = failure(path("a.3mf"), triangle(), *formats::find_mesh_format("a.3mf"));
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, "cannot write " + path("a.3mf") + ": File too large");
  EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace ombre::exporting
