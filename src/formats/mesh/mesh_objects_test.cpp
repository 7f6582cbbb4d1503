#include "formats/mesh/mesh_objects.h"

#include <gtest/gtest.h>

#include "formats/mesh/mesh_writers.h"
#include "formats/mesh/test_documents.h"

namespace ombre::formats {
namespace {

using namespace test;

Mesh three() {
  MeshDocument document = pair();
  document.bodies.push_back(tetrahedron("left", {0, 0, 20}));
  Diagnostics diagnostics;
  return *read_obj("a.obj", whole(obj_bytes(document, "")), diagnostics);
}

TEST(MeshObjects, AreListedOnce) { EXPECT_EQ(object_names(three()), (std::vector<std::string>{"left", "right"})); }

TEST(MeshObjects, AreKeptWithTheirVertices) {
  Mesh mesh = three();
  ASSERT_TRUE(keep_object(mesh, "left"));
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_NEAR(volume(mesh), 2 * tetrahedron_mm3, 1e-12);
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[1].first_triangle, 4u);
}

TEST(MeshObjects, UnknownNamesChangeNothing) {
  Mesh mesh = three();
  EXPECT_FALSE(keep_object(mesh, "Left"));
  EXPECT_EQ(mesh.triangles.size(), 12u);
}

TEST(MeshObjects, WholePartsAreObjectsToo) {
  Mesh mesh = three();
  mesh.groups[0].object = mesh.groups[1].object = "part";
  ASSERT_TRUE(keep_object(mesh, "part"));
  EXPECT_EQ(mesh.triangles.size(), 8u);
}

}  // namespace
}  // namespace ombre::formats
