// The options of `ombre tray`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options/option.h"

namespace ombre::compile {

struct TrayChoices {
  std::vector<std::string> designs;
  std::string materials, printer, count = "1", output = "tray.json";
  std::optional<double> gap_mm;
  bool force = false;

  static const options::Spec<TrayChoices>& options() {
    using namespace options;
    static const options::Spec<TrayChoices> spec{
        list("designs", &TrayChoices::designs, kind::file, "The designs: .vcad, .scad, .json, .ombre or .py files",
             "FILE")
            .required(),
        option("--printer", &TrayChoices::printer, kind::text,
               "Printer profile with a build box: a name, or the path of a .json file", "NAME")
            .required(),
        option("--count", &TrayChoices::count, kind::text,
               "Copies of each design: one number for all, or one for each, such as 12,3 (default 1)", "N"),
        option("--gap", &TrayChoices::gap_mm, kind::number,
               "Distance between the boxes of parts (default: what the printer's profile says); mm", "MM")
            .between(0, 1000),
        option("--materials", &TrayChoices::materials, kind::file, "Materials file of all designs", "FILE"),
        option("-o,--output", &TrayChoices::output, kind::file, "The design file to write (default tray.json)", "FILE"),
        flag("--force", &TrayChoices::force, "Replace an existing file")};
    return spec;
  }
};

}  // namespace ombre::compile
