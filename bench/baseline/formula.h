// Formulas in strings, compiled and evaluated by ExprTk, as the published method does.
#pragma once

#include <memory>
#include <string>

#include "node.h"

namespace baseline {

class Formula {
 public:
  explicit Formula(const std::string& text);
  ~Formula();

  double at(const Point& p) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace baseline
