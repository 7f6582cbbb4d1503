// Options for running a script.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "base/text/data.h"
#include "lang/engine/limits.h"
#include "lang/syntax/dialect.h"

namespace ombre::lang {

class Object;

// A definition from the command line, which replaces the top-level variable of that name.
struct Definition {
  std::string name;
  Data value;
};

struct Options {
  std::vector<Definition> definitions;
  std::vector<std::string> needed;  // variables that the script must have, since they are set later
  Limits limits;
  int threads = 1;                 // with more than one thread, long lists are read ahead of their evaluation
  const StopFlag* stop = nullptr;  // checked regularly; Cancelled is thrown if it is set
  // Is told what a statement has made, each time that it has run; may be empty.
  std::function<void(const SourceRange& statement, std::span<const std::shared_ptr<const void>> products)> made;
  // Is told the value of a call in an expression, or of a variable, each time that it is computed and is an object. Of
  // a record it is told the first member that is one. May be empty.
  std::function<void(const SourceRange& expression, const Object& value)> computed;
  std::function<void(const std::string&)> echo;  // receives one line without its line ending; may be empty
  // Returns the content of a file for `include` and `use`, or nothing if there is no such file. If empty, the file
  // system is used.
  std::function<std::optional<std::string>(const std::string& path)> read_file;
  Dialect dialect = Dialect::vcad;
  std::vector<std::string> libraries;  // folders that `include` and `use` search last
  // Returns the file of a library, as `use` names it, that has an operator of this name, or "". May be empty.
  std::function<std::string(std::string_view name)> library_of;
};

}  // namespace ombre::lang
