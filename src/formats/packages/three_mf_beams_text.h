// Beams as text of a 3MF model (3MF Beam Lattice Extension 1.2).
#pragma once

#include <cstdint>
#include <optional>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// What a model that has beams says of the extension.
inline constexpr std::string_view beam_lattice_space =
    " xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" requiredextensions=\"b\"";

// The element of a mesh behind its vertices. `clip` is the number of the clipping object where there is clipping,
// `materials` that of the group of materials. What the bytes are made from must live as long.
LazyBytes beam_lattice_text(const WrittenBeams& written, std::optional<uint64_t> clip, uint64_t materials);

}  // namespace ombre::formats
