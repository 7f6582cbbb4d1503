// Reads glTF 2.0: a scene in JSON, and the numbers and images that lie in its buffers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/math/srgb.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "formats/containers/base64.h"
#include "formats/containers/counted_warnings.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/files_beside.h"
#include "formats/mesh/glb_format.h"
#include "formats/mesh/mesh.h"

namespace ombre::formats {
namespace {

constexpr double mm_per_metre = 1000;
constexpr size_t most_node_levels = 64;
constexpr size_t most_gltf_triangles = 50'000'000;

uint32_t u32_at(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t n = 0; n < 4; ++n) value |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[at + n])) << (8 * n);
  return value;
}

// A kind of numbers in buffers.
struct Component {
  int code;
  size_t bytes;
  double most;  // of normalized numbers
  double (*read)(const char* at);
};

template <class T>
double number_at(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

constexpr Component components[]{{5120, 1, 127, number_at<int8_t>},
                                 {5121, 1, 255, number_at<uint8_t>},
                                 {5122, 2, 32767, number_at<int16_t>},
                                 {5123, 2, 65535, number_at<uint16_t>},
                                 {5125, 4, 4294967295.0, number_at<uint32_t>},
                                 {5126, 4, 1, number_at<float>}};

// The numbers of an accessor: `count` rows of `width` numbers.
struct Numbers {
  size_t count = 0, width = 0;
  std::vector<double> values;
  const double* row(size_t n) const { return values.data() + n * width; }
};

using Colour4 = std::array<float, 4>;

Colour4 colour_of_light(const std::array<double, 4>& linear) {
  Colour4 colour;
  for (size_t n = 0; n < 3; ++n) colour[n] = static_cast<float>(srgb_of_linear(std::clamp(linear[n], 0.0, 1.0)));
  colour[3] = static_cast<float>(std::clamp(linear[3], 0.0, 1.0));
  return colour;
}

class GltfReader {
 public:
  GltfReader(const std::string& name, std::string_view bytes, const FilesBeside& beside, Diagnostics& diagnostics)
      : name_(name), beside_(beside), diagnostics_(diagnostics) {
    is_glb(bytes) ? read_chunks(bytes) : read_json(bytes);
  }

  Mesh read() {
    check_version();
    read_buffers();
    for (const Data& node : nodes_of_scene()) visit(index(node, "nodes"), Affine(), 0);
    warnings_.report(name_, diagnostics_);
    if (mesh_.triangles.empty()) fail_here("this glTF file has no triangles in its scene");
    // y points upwards there.
    for (Vec3& p : mesh_.vertices)
      p = Vec3{p.x * mm_per_metre, -p.z * mm_per_metre, p.y * mm_per_metre} + Vec3{0, 0, 0};
    if (!has_shadings_) mesh_.shadings.clear();
    return std::move(mesh_);
  }

  // Returns what lies in files beside it, without names that read() refuses.
  GltfFiles files() const {
    GltfFiles files;
    const auto add = [&](std::vector<std::string>& to, const Data& owner) {
      const Data* const uri = owner.find("uri");
      if (!uri || !uri->string() || is_data(*uri)) return;
      const auto path = path_of_uri(*uri->string());
      if (path && std::ranges::find(to, *path) == to.end()) to.push_back(*path);
    };
    for (const Data& buffer : list(root_, "buffers")) add(files.buffers, buffer);
    for (const Data& material : list(root_, "materials")) {
      const Data* const pbr = material.find("pbrMetallicRoughness");
      const Data* const texture = pbr ? pbr->find("baseColorTexture") : nullptr;
      const auto which = texture ? index(*texture, "index", "textures") : std::nullopt;
      const auto image = which ? index(entry("textures", *which), "source", "images") : std::nullopt;
      if (image) add(files.images, entry("images", *image));
    }
    return files;
  }

 private:
  [[noreturn]] void fail_here(const std::string& message, const std::string& hint = "") const {
    fail(diagnostics_, name_, message, hint);
  }

  void read_chunks(std::string_view bytes) {
    if (bytes.size() < glb_header_bytes + glb_chunk_header_bytes) fail_here("this binary glTF file ends in its header");
    if (u32_at(bytes, 4) != 2)
      fail_here("this is glTF of version " + std::to_string(u32_at(bytes, 4)) + ", and version 2 is read");
    for (size_t at = glb_header_bytes; at + glb_chunk_header_bytes <= bytes.size();) {
      const size_t length = u32_at(bytes, at), kind = u32_at(bytes, at + 4);
      at += glb_chunk_header_bytes;
      if (length > bytes.size() - at) fail_here("this binary glTF file ends in a chunk", "save it again");
      if (kind == json_chunk && root_.is_null()) read_json(bytes.substr(at, length));
      if (kind == binary_chunk && !binary_) binary_ = std::string(bytes.substr(at, length));
      at += length;
    }
    if (root_.is_null()) fail_here("this binary glTF file has no chunk of JSON");
  }

  void read_json(std::string_view text) {
    Diagnostics problems;
    auto data = parse_json(make_source(name_, std::string(text)), problems);
    if (!data || !data->members()) fail_here("its JSON cannot be read: " + first_line(to_text(problems)));
    root_ = std::move(*data);
  }

  static std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

  void check_version() {
    const Data* const asset = root_.find("asset");
    const Data* const version = asset ? asset->find("version") : nullptr;
    if (!version || !version->string() || !version->string()->starts_with("2."))
      fail_here("it is no glTF of version 2: \"asset\" has no such \"version\"");
    if (const Data* required = root_.find("extensionsRequired"); required && required->list())
      for (const Data& extension : *required->list())
        if (const std::string* text = extension.string(); text && *text != "KHR_materials_unlit")
          fail_here("it needs the extension " + *text + ", which is not read", "save it without compression");
  }

  // Returns a member that is a list; an empty one if it is missing.
  const DataList& list(const Data& owner, const char* member) const {
    static const DataList none;
    const Data* const found = owner.find(member);
    if (!found) return none;
    if (!found->list()) fail_here(std::string("\"") + member + "\" is no list");
    return *found->list();
  }

  std::optional<double> number(const Data& owner, const char* member) const {
    const Data* const found = owner.find(member);
    if (!found) return std::nullopt;
    if (!found->number() || !std::isfinite(*found->number())) fail_here(std::string("\"") + member + "\" is no number");
    return *found->number();
  }

  size_t whole(const Data& owner, const char* member, std::optional<double> usual = std::nullopt) const {
    const double value = number(owner, member).value_or(usual.value_or(-1));
    if (!(value >= 0) || value != std::floor(value) || value > 1e15)
      fail_here(std::string("\"") + member + "\" is no whole number, or is missing");
    return static_cast<size_t>(value);
  }

  // Returns the number of an entry of a list of the file.
  size_t index(const Data& data, const char* of) const {
    const double* const value = data.number();
    const size_t count = list(root_, of).size();
    if (!value || !(*value >= 0) || *value != std::floor(*value) || !(*value < static_cast<double>(count)))
      fail_here(std::string("there is no such entry in \"") + of + "\", which has " + std::to_string(count) +
                ", counted from 0");
    return static_cast<size_t>(*value);
  }
  std::optional<size_t> index(const Data& owner, const char* member, const char* of) const {
    const Data* const found = owner.find(member);
    return found ? std::optional(index(*found, of)) : std::nullopt;
  }
  const Data& entry(const char* of, size_t n) const { return list(root_, of)[n]; }

  void read_buffers() {
    for (const Data& buffer : list(root_, "buffers")) {
      const Data* const uri = buffer.find("uri");
      if (!uri && (!binary_ || !buffers_.empty())) fail_here("a buffer has no content");
      buffers_.push_back(uri ? bytes_of(*uri, "buffers") : std::move(*binary_));
      if (buffers_.back().size() < whole(buffer, "byteLength"))
        fail_here("a buffer is shorter than its \"byteLength\"");
    }
  }

  static bool is_data(const Data& uri) { return uri.string() && uri.string()->starts_with("data:"); }

  // Returns the path of a file beside this one.
  std::string path_of(const Data& uri, const std::string& what) const {
    const std::string text = uri.string() ? *uri.string() : "";
    auto path = path_of_uri(text);
    if (!path)
      fail_here("its " + what + " lie at " + quoted(text) + ", which is no path relative to it",
                "put the files beside it, or save it as one .glb file");
    return std::move(*path);
  }

  // Returns the bytes of a data URI, or of a file beside this one.
  std::string bytes_of(const Data& uri, const std::string& what) const {
    if (!is_data(uri)) {
      const std::string path = path_of(uri, what);
      const auto file = beside_.find(path);
      if (file == beside_.end())
        fail_here("its " + what + " lie in another file, " + quoted(path) + ", which is not read here",
                  "save it as one .glb file");
      return *file->second;
    }
    const std::string& text = *uri.string();
    const size_t comma = text.find(";base64,");
    if (comma == std::string::npos) fail_here("its " + what + " are no base64");
    auto bytes = from_base64(std::string_view(text).substr(comma + 8));
    if (!bytes) fail_here("its " + what + " are no base64");
    return std::move(*bytes);
  }

  std::string_view view(size_t n) const {
    const Data& data = entry("bufferViews", n);
    const auto buffer = index(data, "buffer", "buffers");
    if (!buffer) fail_here("a buffer view has no buffer");
    const size_t offset = whole(data, "byteOffset", 0), length = whole(data, "byteLength");
    const std::string& bytes = buffers_[*buffer];
    if (offset > bytes.size() || length > bytes.size() - offset) fail_here("a buffer view reaches beyond its buffer");
    return std::string_view(bytes).substr(offset, length);
  }

  Numbers numbers(size_t n) const {
    const Data& data = entry("accessors", n);
    if (data.find("sparse")) fail_here("its numbers are sparse, which is not read", "save it without sparse accessors");
    const size_t code = whole(data, "componentType");
    const auto* const component =
        std::ranges::find_if(components, [&](const Component& c) { return static_cast<size_t>(c.code) == code; });
    const Data* const type = data.find("type");
    const std::string kind = type && type->string() ? *type->string() : "";
    const size_t width = kind == "SCALAR" ? 1 : kind == "VEC2" ? 2 : kind == "VEC3" ? 3 : kind == "VEC4" ? 4 : 0;
    if (component == std::end(components) || width == 0) fail_here("an accessor has a type that is not read");
    const bool is_normalized =
        data.find("normalized") && data.find("normalized")->boolean() && *data.find("normalized")->boolean();
    Numbers numbers{whole(data, "count"), width, {}};
    if (numbers.count > UINT32_MAX) fail_here("an accessor has too many rows");
    const auto from = index(data, "bufferView", "bufferViews");
    if (!from) fail_here("an accessor has no numbers");
    const std::string_view bytes = view(*from);
    const size_t row = width * component->bytes, stride = whole(entry("bufferViews", *from), "byteStride", row);
    const size_t offset = whole(data, "byteOffset", 0);
    const bool fits = stride >= row && stride <= 252 + row && offset <= bytes.size() &&
                      (numbers.count == 0 ||
                       (row <= bytes.size() - offset && (numbers.count - 1) <= (bytes.size() - offset - row) / stride));
    if (!fits) fail_here("an accessor reaches beyond its buffer view");
    numbers.values.reserve(numbers.count * width);
    for (size_t n_row = 0; n_row < numbers.count; ++n_row)
      for (size_t part = 0; part < width; ++part) {
        const double value = component->read(bytes.data() + offset + n_row * stride + part * component->bytes);
        numbers.values.push_back(is_normalized && component->most > 1 ? std::max(-1.0, value / component->most)
                                                                      : value);
      }
    return numbers;
  }

  const DataList& nodes_of_scene() {
    const DataList& scenes = list(root_, "scenes");
    if (scenes.empty()) fail_here("this glTF file has no scene");
    return list(scenes[index(root_, "scene", "scenes").value_or(0)], "nodes");
  }

  static Affine affine(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& at) {
    return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, at};
  }

  std::vector<double> list_of(const Data& node, const char* member, std::vector<double> usual) const {
    const DataList& given = list(node, member);
    if (given.empty()) return usual;
    if (given.size() != usual.size()) fail_here(std::string("\"") + member + "\" has a wrong number of numbers");
    for (size_t n = 0; n < usual.size(); ++n) {
      if (!given[n].number() || !std::isfinite(*given[n].number()))
        fail_here(std::string("\"") + member + "\" has something else than numbers");
      usual[n] = *given[n].number();
    }
    return usual;
  }

  Affine transform(const Data& node) const {
    const auto m = list_of(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    if (node.find("matrix"))
      return affine({m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]});
    const auto t = list_of(node, "translation", {0, 0, 0}), s = list_of(node, "scale", {1, 1, 1});
    const auto q = list_of(node, "rotation", {0, 0, 0, 1});
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return affine(s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                  s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                  s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}, {t[0], t[1], t[2]});
  }

  void visit(size_t n, const Affine& parent, size_t level) {
    visited_.resize(list(root_, "nodes").size());
    if (visited_[n]) fail_here("node " + std::to_string(n) + " is placed twice, and glTF allows it one parent");
    visited_[n] = true;
    if (level > most_node_levels) fail_here("its nodes go deeper than " + std::to_string(most_node_levels) + " levels");
    const Data& node = entry("nodes", n);
    const Affine map = parent * transform(node);
    if (node.find("skin")) warnings_.add("a skin is not read", "skins are not read");
    if (const auto mesh = index(node, "mesh", "meshes")) add_mesh(*mesh, map, text(node, "name"));
    for (const Data& child : list(node, "children")) visit(index(child, "nodes"), map, level + 1);
  }

  static std::string text(const Data& owner, const char* member) {
    const Data* const found = owner.find(member);
    return found && found->string() ? *found->string() : "";
  }

  void add_mesh(size_t n, const Affine& map, const std::string& node_name) {
    const Data& mesh = entry("meshes", n);
    const std::string name = text(mesh, "name");
    for (const Data& primitive : list(mesh, "primitives"))
      add_primitive(primitive, map, name.empty() ? node_name : name);
  }

  void add_primitive(const Data& primitive, const Affine& map, const std::string& name) {
    const size_t mode = whole(primitive, "mode", 4);
    if (mode < 4)
      return warnings_.add("points or lines are no part of the surface",
                           "lists of points or lines are no part of the surface");
    if (mode > 6) fail_here("a primitive has the mode " + std::to_string(mode) + ", which glTF does not have");
    if (primitive.find("targets"))
      warnings_.add("a mesh has morph targets, which are not read", "meshes have morph targets, which are not read");
    const Data* const attributes = primitive.find("attributes");
    const auto positions_at = attributes ? index(*attributes, "POSITION", "accessors") : std::nullopt;
    if (!positions_at)
      return warnings_.add("a mesh without positions is left out", "meshes without positions are left out");
    const Numbers positions = numbers(*positions_at);
    if (positions.width != 3) fail_here("positions have three coordinates each");
    const std::vector<std::array<uint32_t, 3>> triangles = triangles_of(primitive, positions.count, mode);
    if (triangles.size() > most_gltf_triangles - mesh_.triangles.size())
      fail_here("there are more than " + format_count(most_gltf_triangles) + " triangles");
    const auto first_vertex = static_cast<uint32_t>(mesh_.vertices.size());
    if (positions.count > UINT32_MAX - first_vertex) fail_here("there are too many vertices");
    for (size_t n = 0; n < positions.count; ++n)
      mesh_.vertices.push_back(usable(map({positions.row(n)[0], positions.row(n)[1], positions.row(n)[2]})));
    start_group(primitive, name, triangles.size());
    const bool is_mirrored = determinant(map) < 0;
    const PrimitiveShading shading(*this, primitive, *attributes, positions.count);
    for (auto [a, b, c] : triangles) {
      if (is_mirrored) std::swap(b, c);
      mesh_.triangles.push_back({first_vertex + a, first_vertex + b, first_vertex + c});
      mesh_.shadings.push_back(shading.of({a, b, c}));
    }
    has_shadings_ = has_shadings_ || shading.is_more_than_a_colour();
  }

  Vec3 usable(Vec3 p) const {
    if (is_finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= greatest_coordinate / mm_per_metre)
      return p;
    fail_here("a corner comes to lie too far away, or nowhere", "coordinates may go up to 1e15 mm");
  }

  void start_group(const Data& primitive, const std::string& name, size_t triangles) {
    if (triangles == 0) return;
    MeshGroup group{name, static_cast<uint32_t>(mesh_.triangles.size()), static_cast<uint32_t>(triangles)};
    if (const auto material = index(primitive, "material", "materials")) {
      group.material = text(entry("materials", *material), "name");
      const Colour4 colour = colour_of_light(factor(*material));
      Rgba bytes;
      for (size_t n = 0; n < 4; ++n) bytes[n] = static_cast<uint8_t>(std::lround(255 * static_cast<double>(colour[n])));
      group.colour = bytes;
    }
    mesh_.groups.push_back(std::move(group));
  }

  const Data* roughness_of(size_t material) const { return entry("materials", material).find("pbrMetallicRoughness"); }

  std::array<double, 4> factor(size_t material) const {
    const Data* const pbr = roughness_of(material);
    if (!pbr) return {1, 1, 1, 1};
    const auto given = list_of(*pbr, "baseColorFactor", {1, 1, 1, 1});
    return {given[0], given[1], given[2], given[3]};
  }

  std::vector<std::array<uint32_t, 3>> triangles_of(const Data& primitive, size_t vertices, size_t mode) const {
    std::vector<uint32_t> corners;
    if (const auto at = index(primitive, "indices", "accessors")) {
      for (const double value : numbers(*at).values) {
        if (!(value >= 0 && value < static_cast<double>(vertices)))
          fail_here("a triangle uses a vertex that its mesh lacks");
        corners.push_back(static_cast<uint32_t>(value));
      }
    } else {
      for (size_t n = 0; n < vertices; ++n) corners.push_back(static_cast<uint32_t>(n));
    }
    std::vector<std::array<uint32_t, 3>> triangles;
    if (mode == 4 && corners.size() % 3 != 0) fail_here("the corners of a mesh are no multiple of three");
    for (size_t n = 2; n < corners.size(); n += mode == 4 ? 3 : 1) {
      if (mode == 4 || (mode == 5 && n % 2 == 0))
        triangles.push_back({corners[n - 2], corners[n - 1], corners[n]});
      else if (mode == 5)
        triangles.push_back({corners[n - 1], corners[n - 2], corners[n]});
      else
        triangles.push_back({corners[0], corners[n - 1], corners[n]});
    }
    return triangles;
  }

  // The colours and the texture of a primitive, for its triangles.
  class PrimitiveShading {
   public:
    PrimitiveShading(GltfReader& reader, const Data& primitive, const Data& attributes, size_t vertices) {
      const auto material = reader.index(primitive, "material", "materials");
      if (material) factor_ = reader.factor(*material);
      if (const auto at = reader.index(attributes, "COLOR_0", "accessors")) colours_ = reader.numbers(*at);
      const Data* const pbr = material ? reader.roughness_of(*material) : nullptr;
      if (const Data* texture = pbr ? pbr->find("baseColorTexture") : nullptr)
        read_texture(reader, *texture, attributes);
      for (const Numbers* numbers : {&colours_, &places_})
        if (!numbers->values.empty() && numbers->count != vertices)
          reader.fail_here("a mesh has fewer colours or texture coordinates than vertices");
      if (!colours_.values.empty() && colours_.width < 3) reader.fail_here("colours have three or four numbers each");
    }

    bool is_more_than_a_colour() const { return image_ >= 0 || !colours_.values.empty(); }

    TriangleShading of(const std::array<uint32_t, 3>& corners) const {
      TriangleShading shading;
      shading.image = image_;
      for (size_t n = 0; n < 3; ++n) {
        std::array<double, 4> linear = factor_;
        if (!colours_.values.empty())
          for (size_t part = 0; part < colours_.width; ++part) linear[part] *= colours_.row(corners[n])[part];
        shading.colours[n] = colour_of_light(linear);
        // v runs downwards there.
        if (image_ >= 0) shading.places[n] = {places_.row(corners[n])[0], 1 - places_.row(corners[n])[1]};
      }
      return shading;
    }

   private:
    void read_texture(GltfReader& reader, const Data& texture, const Data& attributes) {
      if (const Data* extensions = texture.find("extensions"); extensions && extensions->find("KHR_texture_transform"))
        reader.fail_here("it moves its textures by KHR_texture_transform, which is not read",
                         "apply the transform to the texture coordinates");
      const auto which = reader.index(texture, "index", "textures");
      const std::string set = "TEXCOORD_" + std::to_string(reader.whole(texture, "texCoord", 0));
      const auto at = reader.index(attributes, set.c_str(), "accessors");
      if (!which || !at) reader.fail_here("a mesh has a texture, and no texture coordinates " + set);
      places_ = reader.numbers(*at);
      if (places_.width != 2) reader.fail_here("texture coordinates have two numbers each");
      image_ = reader.image_of(*which);
    }

    std::array<double, 4> factor_{1, 1, 1, 1};
    Numbers colours_, places_;
    int32_t image_ = -1;
  };

  static ImageWrap wrap_of(size_t code) {
    return code == 33071 ? ImageWrap::clamp : code == 33648 ? ImageWrap::mirror : ImageWrap::repeat;
  }

  // Returns the number of a texture's image among those of the mesh.
  int32_t image_of(size_t texture) {
    const Data& data = entry("textures", texture);
    const auto source = index(data, "source", "images");
    if (!source) fail_here("a texture has no image that is read", "save its images as PNG");
    const Data& image = entry("images", *source);
    MeshImage made;
    made.name = text(image, "name").empty() ? "image " + std::to_string(*source) : text(image, "name");
    const auto at = index(image, "bufferView", "bufferViews");
    const Data* const uri = image.find("uri");
    if (!at && !uri) fail_here("an image has no content");
    const bool is_file = !at && !is_data(*uri);
    if (is_file)
      made.name = path_of(*uri, "images");
    else
      made.bytes = at ? std::string(view(*at)) : bytes_of(*uri, "images");
    if (const auto sampler = index(data, "sampler", "samplers")) {
      made.wrap_u = wrap_of(whole(entry("samplers", *sampler), "wrapS", 10497));
      made.wrap_v = wrap_of(whole(entry("samplers", *sampler), "wrapT", 10497));
    }
    const auto known = std::ranges::find(mesh_.images, made);
    if (known != mesh_.images.end()) return static_cast<int32_t>(known - mesh_.images.begin());
    mesh_.images.push_back(std::move(made));
    return static_cast<int32_t>(mesh_.images.size() - 1);
  }

  const std::string& name_;
  const FilesBeside& beside_;
  Diagnostics& diagnostics_;
  CountedWarnings warnings_;
  Data root_;
  std::optional<std::string> binary_;
  std::vector<std::string> buffers_;
  std::vector<bool> visited_;  // by the number of the node
  Mesh mesh_;
  bool has_shadings_ = false;  // beside plain colours of groups
};

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.size() >= 4 && u32_at(bytes, 0) == glb_magic; }

std::optional<Mesh> read_gltf(const std::string& name, std::string_view bytes, const FilesBeside& files,
                              Diagnostics& diagnostics) {
  return read_or_null(name, bytes, diagnostics, [&] { return GltfReader(name, bytes, files, diagnostics).read(); });
}

std::optional<Mesh> read_gltf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return read_gltf(name, bytes, {}, diagnostics);
}

GltfFiles gltf_files(const std::string& name, std::string_view bytes) {
  if (bytes.find("\"uri\"") == std::string_view::npos) return {};
  Diagnostics ignored;
  return read_or_null(name, bytes, ignored, [&] { return GltfReader(name, bytes, {}, ignored).files(); })
      .value_or(GltfFiles());
}

std::vector<std::string> gltf_buffer_files(const std::string& name, std::string_view bytes) {
  return gltf_files(name, bytes).buffers;
}

std::vector<std::string> gltf_image_files(const std::string& name, std::string_view bytes) {
  return gltf_files(name, bytes).images;
}

}  // namespace ombre::formats
