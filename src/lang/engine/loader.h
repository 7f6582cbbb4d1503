// Loads a script with the files that it includes and uses.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "lang/engine/run_options.h"
#include "lang/syntax/ast.h"

namespace ombre::lang {

// A file with its included files, which is evaluated in one scope.
struct Unit {
  std::string path;
  ast::Plan plan;
  std::vector<const Unit*> uses;  // files whose functions and modules it may call
  bool has_words = false;         // true if it contains `use <ombre>` (OpenSCAD scripts)
};

struct Program {
  std::shared_ptr<Names> names = std::make_shared<Names>();
  std::deque<ast::File> files;
  std::deque<Unit> units;          // the first is the main file
  std::vector<std::string> fonts;  // paths of font files that OpenSCAD scripts use
};

// Returns the content of a file, or nothing if it is not a regular file of a size that scripts may have.
std::optional<std::string> read_real_file(const std::string& path);

Program load(const SourcePtr& source, const Options& options, Diagnostics& diagnostics);

}  // namespace ombre::lang
