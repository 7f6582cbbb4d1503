// Bundles: a design with the files that it reads, in one .ombre file, which is a zip with a note of what is in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "load/loaded.h"

namespace ombre::compile {

inline constexpr std::string_view bundle_ending = ".ombre";
bool is_bundle(const std::string& path);  // by its ending

// What went into a bundle, by its names there.
struct BundleContents {
  std::string design;
  std::vector<std::string> files;         // the design among them, sorted
  std::vector<std::string> left_outside;  // files of the system, such as fonts, which every machine has its own of
};

// The design at `path` with the files that it reads, placed to each other as they are now. Of `options` the materials
// file counts, and is in the bundle too. Nothing, and diagnostics, when the design is wrong, or reads a file by a name
// that would not lead to the one in the bundle. Throws Error.
std::optional<BundleContents> write_bundle(const std::string& path, const std::string& output,
                                           const LoadOptions& options, Diagnostics& diagnostics);

// Where the design of a bundle is, once it lies in a folder; `materials` is empty where the usual ones hold.
struct UnpackedBundle {
  std::filesystem::path design, materials;
};
// Writes the files of a bundle into a folder, which is made; nothing beside it is touched. `name` is for messages.
// Nothing, and diagnostics, for what is no bundle, or one with names that lead out of it, links, or more than
// formats::ZipReader::most_bytes. Throws Error.
std::optional<UnpackedBundle> unpack_bundle(const std::string& name, std::string_view bytes,
                                            const std::filesystem::path& folder, Diagnostics& diagnostics);

// The bundle that was unpacked into this folder before; nothing where there is none.
std::optional<UnpackedBundle> find_unpacked(const std::filesystem::path& folder);

// The design of a bundle, unpacked into a folder that lasts as long as the design does.
LoadedPtr load_bundle(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::compile
