// The options of contact sheets.
#pragma once

#include <string>

#include "options/option.h"

namespace ombre::compile {

struct SheetChoices {
  std::string folder, picture = "sheet.png";
  int layers = 12;
  bool force = false;

  static const options::Spec<SheetChoices>& options() {
    using namespace options;
    static const options::Spec<SheetChoices> spec{
        option("folder", &SheetChoices::folder, kind::file, "Folder of a slice job", "DIR").required(),
        option("-o,--output", &SheetChoices::picture, kind::file, "The picture to write (default sheet.png)", "FILE"),
        option("--count", &SheetChoices::layers, kind::whole, "Number of layers, evenly spaced (default 12)", "N")
            .between(1, 200),
        flag("--force", &SheetChoices::force, "Replace an existing picture")};
    return spec;
  }
};

}  // namespace ombre::compile
