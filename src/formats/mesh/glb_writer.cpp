// Writes binary glTF 2.0: a chunk of JSON that describes the following chunk of numbers.
#include <algorithm>
#include <limits>

#include "base/math/srgb.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "formats/containers/append_numbers.h"
#include "formats/mesh/glb_format.h"
#include "formats/mesh/mesh_writers.h"

namespace ombre::formats {
namespace {

constexpr double float_type = 5126, uint16_type = 5123, uint32_type = 5125;
constexpr double vertex_buffer = 34962, index_buffer = 34963;
constexpr size_t point_bytes = 12, colour_bytes = 8, triangle_bytes = 12;

double linear(uint8_t srgb) { return linear_of_srgb(srgb / 255.0); }

Data material_of(const MeshMaterial& material, bool is_translucent) {
  const auto& [red, green, blue, alpha] = material.colour;
  DataMembers members{
      {"name", material.name},
      {"pbrMetallicRoughness",
       DataMembers{{"baseColorFactor", DataList{linear(red), linear(green), linear(blue), alpha / 255.0}},
                   {"metallicFactor", 0.0},
                   {"roughnessFactor", 0.7}}}};
  if (is_translucent) members.emplace_back("alphaMode", "BLEND");
  return members;
}

Vec3 rounded_to_float(Vec3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }

// Returns the least and greatest of each coordinate, rounded as in the file.
std::pair<Vec3, Vec3> extent(const std::vector<Vec3>& points) {
  Vec3 least = rounded_to_float(points.front()), greatest = least;
  for (const Vec3& point : points) {
    const Vec3 p = rounded_to_float(point);
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], p[axis]);
      greatest[axis] = std::max(greatest[axis], p[axis]);
    }
  }
  return {least, greatest};
}

Data list(Vec3 p) { return DataList{p.x, p.y, p.z}; }

bool has_translucent_vertices(const MeshDocument& document) {
  const auto is_translucent = [](const Rgba& colour) { return colour[3] < 255; };
  return std::any_of(document.bodies.begin(), document.bodies.end(), [&](const MeshBody& body) {
    return std::any_of(body.vertex_colours.begin(), body.vertex_colours.end(), is_translucent);
  });
}

// Returns the document's materials. Colours of vertices are multiplied by their material's colour, so bodies with such
// colours share a white material after the others.
DataList materials_of(const MeshDocument& document) {
  DataList materials;
  for (const MeshMaterial& material : document.materials)
    materials.push_back(material_of(material, material.colour[3] < 255));
  if (std::any_of(document.bodies.begin(), document.bodies.end(),
                  [](const MeshBody& body) { return !body.vertex_colours.empty(); }))
    materials.push_back(material_of({"colours of vertices", {255, 255, 255, 255}}, has_translucent_vertices(document)));
  return materials;
}

// Describes bodies one after another: their nodes, meshes and the positions of their numbers.
class Scene {
 public:
  explicit Scene(const MeshDocument& document) : material_count_(document.materials.size()) {}

  void add(const MeshBody& body) {
    DataMembers attributes{{"POSITION", add_positions(body)}};
    if (!body.vertex_colours.empty()) attributes.emplace_back("COLOR_0", add_colours(body));
    DataMembers primitive{{"attributes", attributes}, {"indices", add_indices(body)}};
    if (!body.vertex_colours.empty())
      primitive.emplace_back("material", number(material_count_));
    else if (body.material)
      primitive.emplace_back("material", number(*body.material));
    nodes_.push_back(DataMembers{{"name", body.name}, {"mesh", number(meshes_.size())}});
    meshes_.push_back(DataMembers{{"name", body.name}, {"primitives", DataList{primitive}}});
  }

  uint64_t binary_bytes() const { return bytes_; }

  std::string json(const MeshDocument& document) const {
    const DataList materials = materials_of(document);
    DataMembers members{{"asset", DataMembers{{"version", "2.0"}, {"generator", "ombre"}}},
                        {"scene", 0.0},
                        {"scenes", DataList{DataMembers{{"nodes", DataList{number(nodes_.size())}}}}},
                        {"nodes", nodes(document)},
                        {"meshes", meshes_}};
    if (!materials.empty()) members.emplace_back("materials", materials);
    members.emplace_back("accessors", accessors_);
    members.emplace_back("bufferViews", views_);
    members.emplace_back("buffers", DataList{DataMembers{{"byteLength", number(bytes_)}}});
    return print_json_line(members);
  }

 private:
  // Returns the nodes: the bodies, then their parent, which converts mm to metres and z to the upward axis y.
  DataList nodes(const MeshDocument& document) const {
    constexpr double metre = 0.001;
    DataList all = nodes_, children;
    for (size_t i = 0; i < nodes_.size(); ++i) children.push_back(number(i));
    all.push_back(
        DataMembers{{"name", document.title},
                    {"matrix", DataList{metre, 0., 0., 0., 0., 0., -metre, 0., 0., metre, 0., 0., 0., 0., 0., 1.}},
                    {"children", children}});
    return all;
  }

  // Adds an accessor with its own buffer view, and returns its number.
  Data add_accessor(size_t bytes, double target, DataMembers accessor) {
    accessor.insert(accessor.begin(), {"bufferView", number(views_.size())});
    accessors_.push_back(std::move(accessor));
    views_.push_back(DataMembers{
        {"buffer", 0.0}, {"byteOffset", number(bytes_)}, {"byteLength", number(bytes)}, {"target", target}});
    bytes_ += bytes;
    return number(accessors_.size() - 1);
  }

  Data add_positions(const MeshBody& body) {
    const auto [least, greatest] = extent(body.vertices);
    return add_accessor(point_bytes * body.vertices.size(), vertex_buffer,
                        {{"componentType", float_type},
                         {"count", number(body.vertices.size())},
                         {"type", "VEC3"},
                         {"min", list(least)},
                         {"max", list(greatest)}});
  }

  Data add_colours(const MeshBody& body) {
    return add_accessor(colour_bytes * body.vertices.size(), vertex_buffer,
                        {{"componentType", uint16_type},
                         {"normalized", true},
                         {"count", number(body.vertices.size())},
                         {"type", "VEC4"}});
  }

  Data add_indices(const MeshBody& body) {
    return add_accessor(
        triangle_bytes * body.triangles.size(), index_buffer,
        {{"componentType", uint32_type}, {"count", number(3 * body.triangles.size())}, {"type", "SCALAR"}});
  }

  DataList nodes_, meshes_, accessors_, views_;
  size_t material_count_;
  uint64_t bytes_ = 0;
};

void append_colour(std::string& bytes, const Rgba& colour, const std::array<uint16_t, 256>& linear_of) {
  for (const uint16_t part :
       {linear_of[colour[0]], linear_of[colour[1]], linear_of[colour[2]], static_cast<uint16_t>(257 * colour[3])}) {
    bytes += static_cast<char>(part & 0xFF);
    bytes += static_cast<char>(part >> 8);
  }
}

std::array<uint16_t, 256> linear_table() {
  std::array<uint16_t, 256> table{};
  for (size_t i = 0; i < table.size(); ++i)
    table[i] = static_cast<uint16_t>(math::round(65535 * linear(static_cast<uint8_t>(i))));
  return table;
}

// Adds the numbers of a body in the order of Scene.
void add_numbers(LazyBytes& bytes, const MeshBody& body) {
  bytes.add_rows(body.vertices.size(),
                 [&body](std::string& out, size_t index) { append_point_f32(out, body.vertices[index]); });
  bytes.add_rows(body.vertex_colours.size(), [&body, table = linear_table()](std::string& out, size_t index) {
    append_colour(out, body.vertex_colours[index], table);
  });
  bytes.add_rows(body.triangles.size(), [&body](std::string& out, size_t index) {
    for (const uint32_t corner : body.triangles[index]) append_u32(out, corner);
  });
}

std::string words(std::initializer_list<uint64_t> values) {
  std::string bytes;
  for (const uint64_t value : values) append_u32(bytes, static_cast<uint32_t>(value));
  return bytes;
}

}  // namespace

LazyBytes glb_bytes(const MeshDocument& document) {
  Scene scene(document);
  LazyBytes numbers;
  for (const MeshBody& body : document.bodies) {
    if (body.triangles.empty()) continue;
    scene.add(body);
    add_numbers(numbers, body);
  }
  std::string json = scene.json(document);
  json.append((4 - json.size() % 4) % 4, ' ');
  const uint64_t size = glb_header_bytes + 2 * glb_chunk_header_bytes + json.size() + scene.binary_bytes();
  if (size > UINT32_MAX)
    throw Error(Code::too_large, "a .glb file holds at most 4 GiB; write a .ply file, or a coarser mesh");
  LazyBytes bytes;
  bytes.add(words({glb_magic, 2, size, json.size(), json_chunk}) + json + words({scene.binary_bytes(), binary_chunk}));
  bytes.add(numbers);
  return bytes;
}

}  // namespace ombre::formats
