// Readers of files under fuzzing: any bytes are read, or a message says why not.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/text/diagnostic.h"
#include "import/surfaces/exercise_mesh.h"

namespace ombre::fuzz {

inline std::string_view bytes_of(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Calls read(bytes, diagnostics), and use(result) with what it returns. Aborts if it returns something and reports an
// error, or neither. Returns 0, as fuzz targets do.
template <class Read, class Use>
int reads_or_reports(const uint8_t* data, size_t size, const Read& read, const Use& use) {
  Diagnostics diagnostics;
  auto result = read(bytes_of(data, size), diagnostics);
  if (result.has_value() == diagnostics.has_errors()) std::abort();
  (void)to_text(diagnostics);
  if (result) use(std::move(*result));
  return 0;
}

// Reads a drawing.
template <class Read>
int reads_drawing(const uint8_t* data, size_t size, const std::string& name, const Read& read) {
  return reads_or_reports(
      data, size, [&](std::string_view bytes, Diagnostics& diagnostics) { return read(name, bytes, {}, diagnostics); },
      [](const auto&) {});
}

// Reads a mesh, and uses it as designs do.
template <class Read>
int reads_mesh(const uint8_t* data, size_t size, const std::string& name, const Read& read) {
  return reads_or_reports(
      data, size, [&](std::string_view bytes, Diagnostics& diagnostics) { return read(name, bytes, diagnostics); },
      [](formats::Mesh mesh) { importing::test::exercise(std::move(mesh)); });
}

}  // namespace ombre::fuzz
