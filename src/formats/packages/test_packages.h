// 3MF files for tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "formats/containers/file.h"
#include "formats/containers/zip_archive.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_writers.h"
#include "formats/packages/package_readers.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/read_mesh.h"

namespace ombre::formats::test {

// Returns the bytes that a writer writes to a path.
template <class Write>
inline std::string written(const Write& write) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("test_package_" + std::to_string(getpid()))).string();
  write(path);
  std::string bytes = read_file(path);
  std::filesystem::remove(path);
  return bytes;
}

inline std::string package(const MeshDocument& document, SlicerFlavour flavour) {
  return written([&](const std::string& path) { write_3mf(path, document, flavour); });
}

inline std::string zipped(const std::vector<std::pair<std::string, std::string>>& files) {
  std::vector<ZipEntry> entries;
  for (const auto& [name, text] : files) {
    entries.push_back({name, {}});
    entries.back().bytes.add(text);
  }
  return written([&](const std::string& path) { write_zip(path, entries); });
}

inline std::pair<std::string, std::string> relationships(const std::string& target = "/3D/a.model") {
  return {"_rels/.rels",
          "<Relationships><Relationship Id=\"r\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" "
          "Target=\"" +
              target + "\"/></Relationships>"};
}

inline std::string archive(const std::string& model) { return zipped({relationships(), {"3D/a.model", model}}); }

inline std::string object(int id, const std::string& attributes = "", const std::string& triangle = "") {
  return "<object id=\"" + std::to_string(id) + "\" " + attributes +
         "><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"2\" "
         "z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"4\"/></vertices>\n<triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\" " +
         triangle +
         "/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/>"
         "<triangle v1=\"0\" v2=\"3\" v3=\"2\"/></triangles></mesh></object>\n";
}

inline std::string components(int id, const std::string& inner) {
  return "<object id=\"" + std::to_string(id) + "\"><components>" + inner + "</components></object>\n";
}

inline std::string model(const std::string& resources, const std::string& build = "<item objectid=\"1\"/>",
                         const std::string& attributes = "unit=\"millimeter\"") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model " + attributes + ">\n<resources>\n" + resources +
         "</resources>\n<build>" + build + "</build>\n</model>\n";
}

inline Mesh read(const std::string& bytes) {
  Diagnostics diagnostics;
  const auto mesh = read_mesh("a.3mf", bytes, diagnostics);
  EXPECT_TRUE(mesh && diagnostics.list().empty()) << to_text(diagnostics);
  return mesh.value_or(Mesh{});
}

inline void expect_message(const std::string& bytes, const std::string& part) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_3mf("a.3mf", bytes, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 1u);
  EXPECT_NE(to_text(diagnostics).find(part), std::string::npos)
      << "expected: " << part << "\nfound: " << to_text(diagnostics);
}

}  // namespace ombre::formats::test
