// How elements get their properties: options of `ombre fea` and `ombre homogenise`, and members of studies of
// optimisation.
#pragma once

#include <string>

#include "jobs/fea/fea_sections.h"
#include "options/option.h"

namespace ombre::compile {

struct SectionOptions {
  FeaRequest::Fill fill = FeaRequest::Fill::exact;
  FeaRequest::Assign assign = FeaRequest::Assign::draw;
  std::string modulus = {}, conductivity = {};  // attributes; "" for the properties of the materials
  int sections = 64;

  static const options::Spec<SectionOptions>& options();
  FeaRequest request(int threads) const;
};

}  // namespace ombre::compile
