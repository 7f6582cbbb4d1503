// Syntax trees of expressions.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/system/not_copied.h"
#include "program/field.h"

namespace ombre::expr {

enum class Kind : uint8_t { number, variable, negate, logical_not, binary, call, conditional, source, input };
enum class Binary : uint8_t {
  add,
  subtract,
  multiply,
  divide,
  mod,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  logical_xor,
  logical_nand,
  logical_nor,
};

// A value that a formula gets from outside, such as an output of a node.
class Input {
 public:
  virtual ~Input() = default;
  virtual program::Field field(const program::Point& p) const = 0;
  virtual std::string name() const = 0;  // name for people
  virtual bool is_same(const Input& other) const = 0;
};
using InputPtr = std::shared_ptr<const Input>;

struct Node : NotCopied {
  Kind kind = Kind::number;
  Binary binary = Binary::add;
  double number = 0;
  std::string name;  // name of a variable or function, in lower case
  std::vector<std::shared_ptr<const Node>> operands;
  program::SourceField source;  // its channel 0 is a value that the host program computes
  InputPtr input;
  uint32_t begin = 0, end = 0;  // range of bytes in the expression's text

  Node() = default;
  ~Node();  // not recursive, since sums may be long
};

using NodePtr = std::shared_ptr<const Node>;

}  // namespace ombre::expr
