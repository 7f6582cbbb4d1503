// Formats of files as data. Each family of formats has one table of them; readers, writers, messages, help, the studio
// and `ombre formats` go by it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/module_loader.h"

namespace ombre {

// The kind of content of a file.
enum class Content : uint8_t { mesh, cad, volume, image, drawing, outlines, elements, results, table, last = table };

// "surface meshes", in the plural.
std::string_view name_of(Content content);

struct FileFormat {
  std::string_view name;                  // "Wavefront OBJ"
  std::vector<std::string_view> endings;  // in small letters, with the dot; the first is the usual one
  Content content = Content::mesh;
  bool is_read = false, is_written = false;
  const Module* module = nullptr;  // an optional module that reading or writing needs
  std::string_view refused = {};   // what a file may hold that is an error: "complex numbers; colours"
  std::string_view left_out = {};  // what a file may hold that is not read, with a warning where it could matter
};

// True if the name ends like that of a file of the format, in capital or small letters.
bool has_ending(const std::string& name, const FileFormat& format);

// The endings of the formats: ".nii", ".nii.gz", ...
std::vector<std::string> endings_of(std::span<const FileFormat> formats);

}  // namespace ombre
