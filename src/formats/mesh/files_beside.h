// Files beside a mesh file that hold parts of it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// The contents of files beside a mesh file, by their paths relative to its folder.
using FilesBeside = std::map<std::string, std::shared_ptr<const std::string>>;

// Returns the relative path that a reference of a file names (RFC 3986), with its percent signs decoded. Null if it is
// no such path: absolute, with a scheme such as http:, empty, with a wrong code, or with control characters.
std::optional<std::string> path_of_uri(std::string_view uri);

// The files beside a glTF file that it needs, as relative paths; each once.
struct GltfFiles {
  std::vector<std::string> buffers;  // numbers, without which it cannot be read
  std::vector<std::string> images;   // of its base colours
};
// Returns no files for a file that read_gltf() refuses.
GltfFiles gltf_files(const std::string& name, std::string_view bytes);
std::vector<std::string> gltf_buffer_files(const std::string& name, std::string_view bytes);
std::vector<std::string> gltf_image_files(const std::string& name, std::string_view bytes);

// Reads glTF as read_gltf() in mesh.h does, with its buffers in files. Images in files are named, and not read.
std::optional<Mesh> read_gltf(const std::string& name, std::string_view bytes, const FilesBeside& files,
                              Diagnostics& diagnostics);

}  // namespace ombre::formats
