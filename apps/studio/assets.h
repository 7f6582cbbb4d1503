// The files of the page, which the build puts into the program.
#pragma once

#include <span>
#include <string_view>

namespace ombre::studio {

struct Asset {
  std::string_view path;  // "/app.js"
  std::string_view type;  // "text/javascript; charset=utf-8"
  std::string_view bytes;
};

// Returns null if there is none.
const Asset* find_asset(std::span<const Asset> assets, std::string_view path);

}  // namespace ombre::studio
