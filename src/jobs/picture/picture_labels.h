// Axes, scale bar and legend of a design's pictures.
#pragma once

#include <optional>

#include "jobs/picture/picture_request.h"
#include "load/loaded.h"
#include "render/annotations.h"

namespace ombre::compile {

// The same room for all frames.
class PictureLabels {
 public:
  // `box` holds what is shown, `value` says what the colours are by. Nothing, and diagnostics, where the picture is too
  // small; throws Error where there is nothing to draw them with.
  static std::optional<PictureLabels> make(const Loaded& loaded, const PictureRequest& request, const Box& box,
                                           const std::optional<ValueColours>& value, Diagnostics& diagnostics);

  const render::Layout& layout() const { return layout_; }  // of which the part's picture has the size
  // Makes the part's picture the whole one.
  void add_to(Picture& picture, const render::Camera& camera);

 private:
  PictureLabels(const PictureRequest& request, draw::Pen pen) : request_(&request), pen_(std::move(pen)) {}

  const PictureRequest* request_;
  draw::Pen pen_;
  render::Annotations annotations_;
  render::Layout layout_;
};

}  // namespace ombre::compile
