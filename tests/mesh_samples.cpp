// Writes small meshes in every format, for tests by other programs: mesh_samples FOLDER
#include <cstdio>
#include <filesystem>

#include "export/mesh_file.h"
#include "formats/packages/package_writers.h"

namespace {

using namespace ombre;
using namespace ombre::formats;

// Corner number 4z + 2y + x; faces counter-clockwise from outside.
constexpr std::array<std::array<uint32_t, 3>, 12> box_faces{{{0, 2, 1},
                                                             {1, 2, 3},
                                                             {4, 5, 6},
                                                             {5, 7, 6},
                                                             {0, 1, 4},
                                                             {1, 5, 4},
                                                             {2, 6, 3},
                                                             {3, 6, 7},
                                                             {0, 4, 2},
                                                             {2, 4, 6},
                                                             {1, 3, 5},
                                                             {3, 7, 5}}};

MeshBody box(const std::string& name, Vec3 lo, Vec3 size, uint32_t material) {
  MeshBody body{name, {}, {box_faces.begin(), box_faces.end()}, material};
  for (const double z : {0.0, size.z})
    for (const double y : {0.0, size.y})
      for (const double x : {0.0, size.x}) body.vertices.push_back(lo + Vec3{x, y, z});
  return body;
}

const std::vector<MeshMaterial> materials{{"hard", {255, 0, 0, 255}}, {"soft & <clear>", {0, 128, 255, 128}}};

// Two boxes side by side, the second three times the first.
MeshDocument two_boxes() {
  return {"two boxes", materials, {box("small", {0, 0, 0}, {5, 20, 10}, 0), box("large", {5, 0, 0}, {15, 20, 10}, 1)}};
}

// A row of equal boxes of one material with more and more infill.
MeshDocument four_fills() {
  MeshDocument document{"four fills", materials, {}};
  for (const int percent : {10, 20, 40, 80}) {
    const auto place = static_cast<double>(document.bodies.size());
    document.bodies.push_back(box("fill " + std::to_string(percent), {20 * place, 0, 0}, {20, 20, 10}, 0));
    document.bodies.back().settings = {{"fill_density", std::to_string(percent) + "%"}};
  }
  return document;
}

MeshDocument coloured_box() {
  MeshDocument document{"coloured", materials, {box("box", {-1, -2, -3}, {2, 4, 6}, 1)}};
  for (uint8_t i = 0; i < 8; ++i)
    document.bodies[0].vertex_colours.push_back({static_cast<uint8_t>(30 * i), 0, 255, 255});
  return document;
}

void write_all(const std::string& folder, const std::string& name, const MeshDocument& document) {
  const formats::MeshFormat& three_mf = *formats::find_mesh_format("a.3mf");
  for (const char* ending : {".stl", ".obj", ".ply", ".off", ".amf", ".glb", ".3mf"}) {
    const std::string path = (std::filesystem::path(folder) / (name + ending)).string();
    exporting::write_mesh_file(path, document, *formats::find_mesh_format(path));
  }
  for (const SlicerFlavour flavour :
       {SlicerFlavour::prusa, SlicerFlavour::bambu, SlicerFlavour::orca, SlicerFlavour::snapmaker})
    exporting::write_mesh_file(folder + '/' + name + '_' + flavour_word(flavour) + ".3mf", document, three_mf, flavour);
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 2) throw std::runtime_error("write one folder");
  std::filesystem::create_directories(arguments[1]);
  write_all(arguments[1], "two_boxes", two_boxes());
  write_all(arguments[1], "four_fills", four_fills());
  write_all(arguments[1], "coloured", coloured_box());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
