// The types that node parameters may have, and how plain data becomes them.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/math/box.h"
#include "base/system/hash.h"
#include "design/lowered.h"
#include "design/materials.h"
#include "expr/expression.h"

namespace ombre::design {

class Node;
using NodePtr = std::shared_ptr<const Node>;

// All of a design lies within this distance of the origin on each axis; mm.
inline constexpr double design_limit_mm = 1e6;
inline Box design_space() { return Box::centered({design_limit_mm, design_limit_mm, design_limit_mm}); }

// A constant, or a field over space given by an expression, in which outputs of nodes may stand.
class Number {
 public:
  Number(double value = 0) : value_(value) {}           // NOLINT: a double is a Number
  Number(expr::Expression e) : value_(std::move(e)) {}  // NOLINT
  program::Field operator()(const program::Point& p) const { return at(p, nullptr); }
  // With variables besides the coordinates.
  program::Field at(const program::Point& p, const expr::Variables& extra) const;
  // Encloses its values there, with the ranges of variables besides the coordinates.
  Interval range(const Box& where, const std::map<std::string_view, Interval>& extra = {}) const;
  bool uses_cell() const;  // one of ci, cj, ck
  const double* constant() const { return std::get_if<double>(&value_); }
  const expr::Expression* expression() const { return std::get_if<expr::Expression>(&value_); }
  bool operator==(const Number&) const = default;

 private:
  std::variant<double, expr::Expression> value_;
};

struct Numbers3 {
  Number x, y, z;
  Vec3 upper(const Box& where) const { return {x.range(where).hi, y.range(where).hi, z.range(where).hi}; }
  bool operator==(const Numbers3&) const = default;
};

// A material of the design's table, which nodes do not outlive, or a node whose output is a mixture of materials, which
// the node with the parameter holds. Both null: none was given.
struct MaterialName {
  const Material* material = nullptr;
  const Node* mixture = nullptr;
  bool is_given() const { return material || mixture; }
  bool operator==(const MaterialName&) const = default;
};

// What an attribute gives: one number; three, of a vector; four, of a colour; or a mixture of materials.
struct AttributeValue {
  ValueType type = ValueType::number;
  std::array<Number, 4> numbers{};
  MaterialName mixture = {};  // of that type alone
  std::span<const Number> used() const;
  bool operator==(const AttributeValue&) const = default;
};

// A solid that a value is measured on, which the node with the parameter holds; null: none was given.
struct SolidName {
  const Node* node = nullptr;
  bool operator==(const SolidName&) const = default;
};

// A pair of words, such as an attribute and the rule by which it is combined.
struct NamedWord {
  std::string name, word;
  bool operator==(const NamedWord&) const = default;
};

// One of the two; where neither is given, the number 0.
struct NumberOrMaterial {
  Number number;
  MaterialName material;
  bool operator==(const NumberOrMaterial&) const = default;
};

// The design's material for one that a file calls `name`.
struct MaterialForName {
  std::string name;
  MaterialName material;
  bool operator==(const MaterialForName&) const = default;
};

// The material for a number.
struct MaterialStop {
  double at = 0;
  MaterialName material;
  bool operator==(const MaterialStop&) const = default;
};

// A list that does not change. Equal ones made in a row share their memory: loops make millions.
template <class T>
class SharedList {
 public:
  SharedList() = default;
  explicit SharedList(std::vector<T> list) {
    if (list.empty()) return;
    thread_local std::weak_ptr<const std::vector<T>> last;
    list_ = last.lock();
    if (list_ && *list_ == list) return;
    list_ = std::make_shared<const std::vector<T>>(std::move(list));
    last = list_;
  }

  std::span<const T> items() const { return list_ ? std::span<const T>(*list_) : std::span<const T>(); }
  auto begin() const { return items().begin(); }
  auto end() const { return items().end(); }
  size_t size() const { return items().size(); }
  bool empty() const { return items().empty(); }

 private:
  std::shared_ptr<const std::vector<T>> list_;  // null: it is empty
};

// A strut of a lattice, in mm.
struct Edge {
  Vec3 start, end;
  double radius = 0;  // 0: that of the lattice
  bool operator==(const Edge&) const = default;
};

// One of a parameter's choices: the text stands in its domain, or is a literal.
class Choice {
 public:
  constexpr Choice(const char* text) : text_(text) {}  // NOLINT: a literal is a Choice
  std::string_view text() const { return text_; }
  bool operator==(std::string_view other) const { return text() == other; }

 private:
  const char* text_;
};

struct FilePath {
  std::string path;
  Hash content;  // of the file, known once it was loaded
  bool operator==(const FilePath&) const = default;
};

// How many there are along x, y and z.
using Counts3 = std::array<int, 3>;

// Points in a list, all of three numbers, or all of two, with z = 0.
struct Points {
  std::vector<Vec3> at;
  bool are_flat = false;  // of two numbers
  bool operator==(const Points&) const = default;
};

// A font by its name, or by the path of its file.
struct FontName {
  std::string name;
  Hash content;  // of the font that was found
  bool operator==(const FontName&) const = default;
};

// Weights of the voxels around one, in lists along x of lists along y of lists along z.
struct Kernel {
  Counts3 size{};               // from 1 to 1000 each, where it is given
  std::vector<double> weights;  // z fastest, at most 10^6; finite, their sum not negative, not all 0
  bool operator==(const Kernel&) const = default;
};

// Rows of equally many numbers, or the file that holds them.
struct NumberTable {
  std::vector<std::vector<double>> rows;
  FilePath file;  // empty: the rows were written out
  bool operator==(const NumberTable&) const = default;
};

// Values by name for the variables of a script in another language: numbers, texts, truth values, and lists of them.
struct ScriptVariables {
  DataMembers values;
  bool operator==(const ScriptVariables&) const = default;
};

// What a parameter may be, for checks, help and forms.
struct Domain {
  std::string_view unit;  // "mm", "deg", or none
  double least = -std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::infinity();
  bool above_least = false;            // greater than `least`, not equal
  bool required = false;               // has no default
  std::vector<std::string> choices;    // of a Choice
  std::vector<std::string> variables;  // known in expressions besides the coordinates
  bool may_mix = false;                // of a material: may it be a mixture?
  bool one_is_enough = false;          // of three numbers: may one stand for itself and two zeros?
  bool child_attributes = false;       // may expressions call attributes of the inputs by their names?
};

// The coordinates, and what a domain knows besides.
std::vector<std::string> known_variables(const Domain& domain);

inline Domain any(std::string_view unit = "") {
  Domain domain;
  domain.unit = unit;
  return domain;
}
inline Domain positive(std::string_view unit) {
  Domain domain = any(unit);
  domain.least = 0;
  domain.above_least = true;
  return domain;
}
inline Domain not_negative(std::string_view unit) {
  Domain domain = any(unit);
  domain.least = 0;
  return domain;
}
inline Domain from_to(double least, double greatest, std::string_view unit = "") {
  Domain domain = any(unit);
  domain.least = least;
  domain.greatest = greatest;
  return domain;
}
inline Domain one_of(std::vector<std::string> choices) {
  Domain domain;
  domain.choices = std::move(choices);
  return domain;
}
inline Domain required(Domain domain = {}) {
  domain.required = true;
  return domain;
}
// Of three numbers, in whose place one may stand.
inline Domain one_or_three(Domain domain = {}) {
  domain.one_is_enough = true;
  return domain;
}
// Of materials, where mixtures may stand too.
inline Domain mixable(Domain domain = {}) {
  domain.may_mix = true;
  return domain;
}
inline Domain with_variables(std::vector<std::string> variables, Domain domain = {}) {
  domain.variables = std::move(variables);
  return domain;
}
// Of expressions that are evaluated over the node's input: d is its distance, t the place along its struts.
inline Domain over_child(Domain domain = {}) {
  domain = with_variables({"d", "t"}, std::move(domain));
  domain.child_attributes = true;
  return domain;
}

namespace unit {
inline const Domain mm = any("mm"), degrees = any("deg"), none = any();
inline const Domain points = from_to(-design_limit_mm, design_limit_mm, "mm");
inline const Domain positive_mm = positive("mm"), not_negative_mm = not_negative("mm");
}  // namespace unit

class SourceLoader;

// Values by the names that formulas call them; nothing for an unknown name.
using NamedValues = std::function<std::optional<Data>(const std::string& name)>;

// What reading a parameter needs besides the data.
struct Reader {
  const MaterialTable& materials;
  Diagnostics& diagnostics;
  SourceLoader* loader = nullptr;
  SourceRange where;            // of the call, for messages about nothing that was written
  std::string_view node, name;  // whose parameter is read
  const NamedValues* names = nullptr;
  std::vector<NodePtr>* values = nullptr;        // gets the nodes whose outputs the parameter holds
  const std::vector<NodePtr>* inputs = nullptr;  // of the node, whose attributes expressions may call

  void keep(const NodePtr& value) const;
  bool fail(const Data& data, const std::string& expected, const Phrase& hint = {},
            Code code = Code::parameter_type) const;
};

// True when `data` was right; else a diagnostic was added.
bool read(const Data& data, const Domain& domain, double& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::optional<double>& value, const Reader& reader);  // null: none
bool read(const Data& data, const Domain& domain, int& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, Counts3& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, Number& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, Numbers3& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, bool& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::string& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, Choice& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, Vec3& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::optional<Vec3>& value, const Reader& reader);  // null: none
bool read(const Data& data, const Domain& domain, Affine& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, MaterialName& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, NumberOrMaterial& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, FilePath& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, SharedList<Number>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, SharedList<MaterialName>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::vector<MaterialForName>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::vector<MaterialStop>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::optional<std::vector<Edge>>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, Points& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::vector<Points>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, FontName& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, Kernel& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::vector<std::string>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, AttributeValue& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, SolidName& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, std::vector<NamedWord>& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, NumberTable& value, const Reader& reader);
bool read(const Data& data, const Domain& domain, ScriptVariables& value, const Reader& reader);

// The reverse. For hashes, files are named by their content.
Data write(double value, bool for_hash);
Data write(const std::optional<double>& value, bool for_hash);
Data write(int value, bool for_hash);
Data write(const Counts3& value, bool for_hash);
Data write(const Number& value, bool for_hash);
Data write(const Numbers3& value, bool for_hash);
Data write(bool value, bool for_hash);
Data write(const std::string& value, bool for_hash);
Data write(Choice value, bool for_hash);
Data write(const Vec3& value, bool for_hash);
Data write(const std::optional<Vec3>& value, bool for_hash);
Data write(const Affine& value, bool for_hash);
Data write(const MaterialName& value, bool for_hash);
Data write(const NumberOrMaterial& value, bool for_hash);
Data write(const FilePath& value, bool for_hash);
Data write(const SharedList<Number>& value, bool for_hash);
Data write(const SharedList<MaterialName>& value, bool for_hash);
Data write(const std::vector<MaterialForName>& value, bool for_hash);
Data write(const std::vector<MaterialStop>& value, bool for_hash);
Data write(const std::optional<std::vector<Edge>>& value, bool for_hash);
Data write(const Points& value, bool for_hash);
Data write(const std::vector<Points>& value, bool for_hash);
Data write(const FontName& value, bool for_hash);
Data write(const Kernel& value, bool for_hash);
Data write(const std::vector<std::string>& value, bool for_hash);
Data write(const AttributeValue& value, bool for_hash);
Data write(const SolidName& value, bool for_hash);
Data write(const std::vector<NamedWord>& value, bool for_hash);
Data write(const NumberTable& value, bool for_hash);
Data write(const ScriptVariables& value, bool for_hash);

// The kind of the parameter that takes those arguments of a call whose names no other parameter has.
inline constexpr std::string_view variables_kind = "values by name";

// "number or field", "material", ...: for help.
template <class M>
constexpr std::string_view kind_name() {
  if constexpr (std::is_same_v<M, double> || std::is_same_v<M, std::optional<double>>) return "number";
  if constexpr (std::is_same_v<M, int>) return "whole number";
  if constexpr (std::is_same_v<M, Counts3>) return "3 whole numbers";
  if constexpr (std::is_same_v<M, Number>) return "number or field";
  if constexpr (std::is_same_v<M, Numbers3>) return "3 numbers or fields";
  if constexpr (std::is_same_v<M, bool>) return "true or false";
  if constexpr (std::is_same_v<M, std::string> || std::is_same_v<M, Choice>) return "text";
  if constexpr (std::is_same_v<M, Vec3> || std::is_same_v<M, std::optional<Vec3>>) return "3 numbers";
  if constexpr (std::is_same_v<M, Affine>) return "matrix";
  if constexpr (std::is_same_v<M, MaterialName>) return "material";
  if constexpr (std::is_same_v<M, NumberOrMaterial>) return "number, field, material or mixture";
  if constexpr (std::is_same_v<M, FilePath>) return "file";
  if constexpr (std::is_same_v<M, SharedList<Number>>) return "list of numbers or fields";
  if constexpr (std::is_same_v<M, SharedList<MaterialName>>) return "list of materials";
  if constexpr (std::is_same_v<M, std::vector<MaterialForName>>) return "list of names with materials";
  if constexpr (std::is_same_v<M, std::vector<MaterialStop>>) return "list of numbers with materials";
  if constexpr (std::is_same_v<M, std::optional<std::vector<Edge>>>) return "list of edges";
  if constexpr (std::is_same_v<M, Points>) return "list of points";
  if constexpr (std::is_same_v<M, std::vector<Points>>) return "lists of points";
  if constexpr (std::is_same_v<M, FontName>) return "font";
  if constexpr (std::is_same_v<M, Kernel>) return "lists of lists of numbers";
  if constexpr (std::is_same_v<M, std::vector<std::string>>) return "list of texts";
  if constexpr (std::is_same_v<M, AttributeValue>) return "number, field, vector, colour or mixture";
  if constexpr (std::is_same_v<M, SolidName>) return "solid";
  if constexpr (std::is_same_v<M, std::vector<NamedWord>>) return "list of pairs of words";
  if constexpr (std::is_same_v<M, NumberTable>) return "rows of numbers, or a CSV file";
  if constexpr (std::is_same_v<M, ScriptVariables>) return variables_kind;
}

}  // namespace ombre::design
