// The files of the page, which the build embeds into the program.
#pragma once

#include <span>
#include <string_view>

namespace ombre::studio {

struct Asset {
  std::string_view path;  // such as "/app.js"
  std::string_view type;  // such as "text/javascript; charset=utf-8"
  std::string_view bytes;
};

// Returns the asset at a path, or null.
const Asset* find_asset(std::span<const Asset> assets, std::string_view path);

}  // namespace ombre::studio
