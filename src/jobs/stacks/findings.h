// Findings of a check of a stack.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ombre::compile {

// Something that does not hold.
struct Finding {
  std::string kind;  // a word for programs: "hash", "colour", "voxels"
  std::string text;
  std::optional<int64_t> layer = {};
};

using Findings = std::vector<Finding>;

// A picture of where something differs.
struct FindingPicture {
  std::string title;
  std::string png;
};

}  // namespace ombre::compile
