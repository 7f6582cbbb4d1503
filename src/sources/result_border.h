// The border of a mesh of results as triangles.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "formats/mesh.h"

namespace ombre::sources {

// Does a file of this name hold a mesh of elements: .vtu, .frd, .inp?
bool has_elements(const std::string& path);

// The outer sides of a mesh of results, moved by its displacement times `deform`; closed where elements share nodes.
// Nothing, and diagnostics, where the file is wrong or has no elements.
std::optional<formats::Mesh> result_border(const std::string& name, std::string_view bytes, double deform,
                                           Diagnostics& diagnostics);

}  // namespace ombre::sources
