// Draws axes, scale bar and legend on a design's pictures.
#pragma once

#include <optional>

#include "jobs/picture/picture_request.h"
#include "load/loaded.h"
#include "render/annotations.h"

namespace ombre::compile {

// Labels that take the same room in all frames.
class PictureLabels {
 public:
  // `box` holds everything that is shown, and `value` is the value of the colours. Returns nothing, and adds
  // diagnostics, if the picture is too small; throws Error if labels cannot be drawn.
  static std::optional<PictureLabels> make(const Loaded& loaded, const PictureRequest& request, const Box& box,
                                           const std::optional<ValueColours>& value, Diagnostics& diagnostics);

  const render::Layout& layout() const { return layout_; }  // has the size of the part's picture
  // Extends the part's picture to the whole one.
  void add_to(Picture& picture, const render::Camera& camera);

 private:
  PictureLabels(const PictureRequest& request, draw::Pen pen) : request_(&request), pen_(std::move(pen)) {}

  const PictureRequest* request_;
  draw::Pen pen_;
  render::Annotations annotations_;
  render::Layout layout_;
};

}  // namespace ombre::compile
