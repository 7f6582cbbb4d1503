// The options of bundles.
#pragma once

#include <string>

#include "options/option.h"

namespace ombre::compile {

struct BundleChoices {
  std::string design, materials, output;
  bool force = false;

  static const options::Spec<BundleChoices>& options() {
    using namespace options;
    static const options::Spec<BundleChoices> spec{
        option("design", &BundleChoices::design, kind::file, "The design: a .vcad, .scad or .json file", "FILE")
            .required(),
        option("--materials", &BundleChoices::materials, kind::file, "Materials file, which goes into the bundle too",
               "FILE"),
        option("-o,--output", &BundleChoices::output, kind::file,
               "The bundle to write (default: the design's name with .ombre)", "FILE"),
        flag("--force", &BundleChoices::force, "Replace an existing bundle")};
    return spec;
  }
};

}  // namespace ombre::compile
