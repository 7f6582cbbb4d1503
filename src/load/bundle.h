// Bundles: a design with the files that it reads, in one .ombre file. This is a zip archive with a note of its
// contents.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "load/loaded.h"

namespace ombre::compile {

inline constexpr std::string_view bundle_ending = ".ombre";
bool is_bundle(const std::string& path);  // decided by the ending

// The files of a bundle, by their names in it.
struct BundleContents {
  std::string design;
  std::vector<std::string> files;         // all files with the design, sorted
  std::vector<std::string> left_outside;  // files of the system, such as fonts, which every machine has of its own
};

// Writes the design at `path` with the files that it reads, which keep their relative places. Of `options` the
// materials file is used, and is put into the bundle. Returns nothing, and adds diagnostics, if the design is wrong, or
// reads a file by a name that would not lead to the one in the bundle. Throws Error.
std::optional<BundleContents> write_bundle(const std::string& path, const std::string& output,
                                           const LoadOptions& options, Diagnostics& diagnostics);

// The paths of a bundle's design and materials after unpacking; `materials` is empty for the default set.
struct UnpackedBundle {
  std::filesystem::path design, materials;
};
// Writes the files of a bundle into a folder, which is made; nothing beside it is touched. `name` is for messages.
// Returns nothing, and adds diagnostics, if the bytes are not a bundle, or hold links, names that lead out of it, or
// more than formats::ZipReader::most_bytes. Throws Error.
std::optional<UnpackedBundle> unpack_bundle(const std::string& name, std::string_view bytes,
                                            const std::filesystem::path& folder, Diagnostics& diagnostics);

// Returns the bundle that was unpacked into this folder before, if there is one.
std::optional<UnpackedBundle> find_unpacked(const std::filesystem::path& folder);

// Loads the design of a bundle, unpacked into a folder that exists as long as the design does.
LoadedPtr load_bundle(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::compile
