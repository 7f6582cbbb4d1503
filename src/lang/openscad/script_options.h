// How an OpenSCAD script is run.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "lang/engine/limits.h"
#include "lang/openscad/words.h"

namespace ombre::lang::openscad {

// The view in which `$vpr`, `$vpt`, `$vpd` and `$vpf` are what scripts read: degrees, mm, mm, degrees.
struct View {
  std::array<double, 3> rotation{0, 0, 0}, target{0, 0, 0};
  double distance = 500, field = 22.5;
};

struct Options {
  // `-D name=expression`; each takes the place of the top-level variable of that name. The text is read as script.
  std::vector<std::string> definitions;
  // Folders where `include` and `use` look after the folder of the file that asks.
  std::vector<std::string> libraries;
  Limits limits = openscad_limits();
  const StopFlag* stop = nullptr;  // checked now and then; Cancelled is thrown
  // What `include` and `use` read: nothing where there is no such file. Empty for the real files.
  std::function<std::optional<std::string>(const std::string& path)> read_file;
  View view;
  double time = 0;                 // $t
  bool is_preview = true;          // $preview: true, as OpenSCAD has it without `--render`
  bool stops_at_warnings = false;  // --hardwarnings
  Words* words = nullptr;          // what `use <ombre>` brings; null: there `use <ombre>` is an error

  // Scripts may call functions inside each other some 10,000 times; the evaluation has a stack of its own for that.
  static Limits openscad_limits();
};

}  // namespace ombre::lang::openscad
