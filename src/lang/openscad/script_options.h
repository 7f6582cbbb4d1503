// Options for running an OpenSCAD script.
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

// The view that scripts read from `$vpr`, `$vpt`, `$vpd` and `$vpf`, in degrees, mm, mm and degrees.
struct View {
  std::array<double, 3> rotation{0, 0, 0}, target{0, 0, 0};
  double distance = 500, field = 22.5;
};

struct Options {
  // Definitions `-D name=expression`, each of which replaces the top-level variable of that name. They are parsed as
  // script text.
  std::vector<std::string> definitions;
  // Folders that `include` and `use` search after the folder of the including file.
  std::vector<std::string> libraries;
  Limits limits = openscad_limits();
  const StopFlag* stop = nullptr;  // checked regularly; Cancelled is thrown if it is set
  // Returns the content of a file for `include` and `use`, or nothing if there is no such file. If empty, the file
  // system is used.
  std::function<std::optional<std::string>(const std::string& path)> read_file;
  View view;
  double time = 0;                 // $t
  bool is_preview = true;          // $preview: true as in OpenSCAD without `--render`
  bool stops_at_warnings = false;  // --hardwarnings
  Words* words = nullptr;          // the words of `use <ombre>`; if null, `use <ombre>` is an error

  // Functions may be nested about 10,000 deep, for which the evaluation has its own stack.
  static Limits openscad_limits();
};

}  // namespace ombre::lang::openscad
