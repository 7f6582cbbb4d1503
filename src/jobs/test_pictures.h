// Makes pictures in memory from the text of a design, for tests.
#pragma once

#include "jobs/picture/picture.h"
#include "jobs/test_designs.h"

namespace ombre::compile {

// Returns the picture; null, with the reason in the diagnostics, if there is none.
inline std::optional<Picture> picture_of(const std::string& text, const PictureRequest& request,
                                         Diagnostics& diagnostics) {
  const LoadedPtr loaded = load_text(text, diagnostics);
  EXPECT_TRUE(loaded) << to_text(diagnostics);
  std::optional<Picture> picture;
  const auto take = [&](int, const Picture& taken) { picture = taken; };
  take_pictures(*loaded, request, StopFlag(), take, diagnostics);
  return picture;
}

inline Picture picture_of(const std::string& text, const PictureRequest& request) {
  Diagnostics diagnostics;
  const std::optional<Picture> picture = picture_of(text, request, diagnostics);
  EXPECT_TRUE(picture) << to_text(diagnostics);
  return picture.value_or(Picture{});
}

}  // namespace ombre::compile
