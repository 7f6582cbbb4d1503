// Values of expressions.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/system/not_copied.h"
#include "base/text/data.h"
#include "lang/engine/meter.h"
#include "lang/syntax/ast.h"

namespace ombre::lang {

struct Text;
struct List;
struct Range;
struct Closure;
struct Record;
class Object;
struct Undef {};
// The value of a variable whose assignment failed and was reported. Reading it fails without a diagnostic.
struct Broken {};

using TextPtr = std::shared_ptr<const Text>;
using ListPtr = std::shared_ptr<const List>;
using RangePtr = std::shared_ptr<const Range>;
using ClosurePtr = std::shared_ptr<const Closure>;
using RecordPtr = std::shared_ptr<const Record>;
using ObjectPtr = std::shared_ptr<const Object>;

class Value {
 public:
  Value() = default;
  Value(bool v) : value_(v) {}                   // NOLINT
  Value(double v) : value_(v) {}                 // NOLINT
  Value(TextPtr v) : value_(std::move(v)) {}     // NOLINT
  Value(ListPtr v) : value_(std::move(v)) {}     // NOLINT
  Value(RangePtr v) : value_(std::move(v)) {}    // NOLINT
  Value(ClosurePtr v) : value_(std::move(v)) {}  // NOLINT
  Value(RecordPtr v) : value_(std::move(v)) {}   // NOLINT
  Value(ObjectPtr v) : value_(std::move(v)) {}   // NOLINT
  Value(Broken v) : value_(v) {}                 // NOLINT

  bool is_undef() const { return std::holds_alternative<Undef>(value_); }
  bool is_broken() const { return std::holds_alternative<Broken>(value_); }
  const bool* boolean() const { return std::get_if<bool>(&value_); }
  const double* number() const { return std::get_if<double>(&value_); }
  const Text* text() const { return pointee<TextPtr>(); }
  const List* list() const { return pointee<ListPtr>(); }
  const Range* range() const { return pointee<RangePtr>(); }
  const Closure* closure() const { return pointee<ClosurePtr>(); }
  const Record* record() const { return pointee<RecordPtr>(); }
  const Object* object() const { return pointee<ObjectPtr>(); }
  const ClosurePtr& closure_ptr() const { return std::get<ClosurePtr>(value_); }

 private:
  template <class Pointer>
  const typename Pointer::element_type* pointee() const {
    const Pointer* pointer = std::get_if<Pointer>(&value_);
    return pointer ? pointer->get() : nullptr;
  }

  std::variant<Undef, bool, double, TextPtr, ListPtr, RangePtr, ClosurePtr, RecordPtr, ObjectPtr, Broken> value_;
};

// A value that only a vocabulary understands, such as a number that varies in space.
class Object {
 public:
  enum class Form : uint8_t { value, mixture, solid, values };

  virtual ~Object() = default;
  virtual Form form() const = 0;             // `values` is a node with several outputs
  virtual std::string describe() const = 0;  // description for messages: "a value that varies in space"
  virtual std::string text() const = 0;      // text that echo prints
  virtual Data data() const = 0;             // data for a parameter of a node
  // Returns a part by name. If there is none, returns nothing and sets `names` to the names of all parts.
  virtual std::optional<Value> part(const std::string& name, std::string& names, Meter& meter) const = 0;
  // Applies an operator or builtin function, given by its name in scripts ("?:" for a condition with two values).
  // Returns nothing if it is not defined for the operands.
  virtual std::optional<Value> apply(std::string_view function, std::span<const Value> operands,
                                     Meter& meter) const = 0;
};

// Returns the first of the values that is an object, or null.
const Object* first_object(std::span<const Value> values);
bool holds_object(const Value& value);  // the value itself, or an element of a list
// Suggests what to write in place of a value that cannot be used.
std::string_view hint_for(const Value& found);

struct Text : NotCopied {
  static constexpr uint64_t overhead = 32;  // added for each string, so that the number of short ones is limited, too

  Text(std::string t, const ast::String* o, Meter& m) : text(std::move(t)), origin(o), meter(m) {
    meter.claim_text(text.size() + overhead);
  }
  ~Text() { meter.release_text(text.size() + overhead); }

  std::string text;
  const ast::String* origin;  // the literal, or null
  Meter& meter;
};

struct List : NotCopied {
  List(std::vector<Value> i, const ast::List* o, Meter& m);  // its elements were counted by the meter before
  ~List() { meter.release_elements(items.size()); }

  std::vector<Value> items;
  const ast::List* origin;  // the literal whose elements are those of the list, one by one, or null
  uint64_t weight;          // number of elements, nested ones included; shared ones are counted each time
  int depth;                // 1 for a list without inner lists
  Meter& meter;
};

// Returns the number of elements that a value holds, and the levels of lists and records; 0 for other values.
uint64_t weight_of(const Value& value);
int depth_of(const Value& value);
// Throws LimitReached if a list or a record is too large or too deep.
void check_nesting(uint64_t weight, int depth, const Meter& meter);

struct Range {
  double begin, step, end;

  // Returns the number of elements. The end counts as an element if it is within rounding of one.
  double count() const;
  double at(double index) const { return index == 0 ? begin : begin + index * step; }  // steps may be infinite
};

// Collects the elements of a list within the limits.
class ListBuilder : NotCopied {
 public:
  explicit ListBuilder(Meter& meter) : meter_(meter) {}
  ~ListBuilder() { meter_.release_elements(items_.size()); }

  void reserve(size_t size) { items_.reserve(size); }
  void push(Value value) {
    meter_.claim_element();
    items_.push_back(std::move(value));
  }
  Value finish(const ast::List* origin = nullptr);

 private:
  Meter& meter_;
  std::vector<Value> items_;
};

// A value with named members, which OpenSCAD calls an object. Its builder sees to it that each name occurs once.
struct Record : NotCopied {
  using Members = std::vector<std::pair<std::string, Value>>;  // in the order in which they were set first

  Record(Members m, uint64_t bytes, Meter& counter);
  ~Record();

  const Value* find(const std::string& name) const;  // null if there is none

  Members members;
  std::map<std::string, size_t> places;  // of the members
  uint64_t weight;                       // as that of a list
  int depth;
  uint64_t name_bytes;
  Meter& meter;
};

// Collects members within the limits.
class RecordBuilder : NotCopied {
 public:
  explicit RecordBuilder(Meter& meter) : meter_(meter) {}
  ~RecordBuilder();

  void set(const std::string& name, Value value);  // an older value of the name is replaced in its place
  void set_all(const Record& other);
  void remove(const std::string& name);
  Value finish();

 private:
  Meter& meter_;
  Record::Members members_;
  std::map<std::string, size_t> places_;
  uint64_t name_bytes_ = 0;
};

Value make_text(std::string text, Meter& meter);
Value make_list(const std::vector<double>& numbers, Meter& meter);

bool is_true(const Value& value);
bool equal(const Value& a, const Value& b, Meter& meter);
// Returns a description for messages: "a number", "a list of 3".
std::string describe(const Value& value);
std::string number_text(double number);  // up to 15 digits
// How a language writes numbers and functions.
struct TextStyle {
  std::string (*number)(double) = number_text;
  std::string (*function)(const Closure&) = [](const Closure&) -> std::string { return "function"; };
};
// Appends the text that str() and echo() print. `quoted` is set for strings in lists.
void append_text(std::string& text, const Value& value, bool quoted, Meter& meter, const TextStyle& style = {});

bool is_number_list(const List& list);

Value from_data(const Data& data, Meter& meter);

}  // namespace ombre::lang
