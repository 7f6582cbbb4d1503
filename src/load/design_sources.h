// A loader that answers the requests of a design's nodes.
#pragma once

#include "load/support_stage.h"
#include "sources/loading.h"

namespace ombre::compile {

class DesignSources final : public sources::Loader {
 public:
  using Loader::Loader;
  design::StagePtr support(const design::NodePtr& solid, const design::SupportUse& use,
                           const design::Reader& reader) override {
    return make_support_stage(solid, use, reader);
  }
};

}  // namespace ombre::compile
