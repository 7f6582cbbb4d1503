// A function that takes the bytes of a file, piece by piece.
#pragma once

#include <functional>
#include <string_view>

namespace ombre::fea {

using Sink = std::function<void(std::string_view bytes)>;

}  // namespace ombre::fea
