// Types of node parameters, and their conversion from and to plain data.
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

// All of a design lies within this distance (mm) of the origin on each axis.
inline constexpr double design_limit_mm = 1e6;
inline Box design_space() { return Box::centered({design_limit_mm, design_limit_mm, design_limit_mm}); }

// A constant, or a field over space given by an expression, which may contain outputs of nodes.
class Number {
 public:
  Number(double value = 0) : value_(value) {}           // NOLINT: implicit conversion from double
  Number(expr::Expression e) : value_(std::move(e)) {}  // NOLINT: implicit conversion from an expression
  program::Field operator()(const program::Point& p) const { return at(p, nullptr); }
  // Evaluates with variables besides the coordinates.
  program::Field at(const program::Point& p, const expr::Variables& extra) const;
  // Returns an interval that encloses its values in `where`, given the ranges of variables besides the coordinates.
  Interval range(const Box& where, const std::map<std::string_view, Interval>& extra = {}) const;
  bool uses_cell() const;  // true if it uses ci, cj or ck
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

// A material of the design's table, which outlives the nodes, or a node whose output is a mixture and which the node
// with the parameter owns. Both are null if no material is given.
struct MaterialName {
  const Material* material = nullptr;
  const Node* mixture = nullptr;
  bool is_given() const { return material || mixture; }
  bool operator==(const MaterialName&) const = default;
};

// The value of an attribute: one number, three numbers of a vector, four numbers of a colour, or a mixture of
// materials.
struct AttributeValue {
  ValueType type = ValueType::number;
  std::array<Number, 4> numbers{};
  MaterialName mixture = {};  // mixture of materials, for the type mixture
  std::span<const Number> used() const;
  bool operator==(const AttributeValue&) const = default;
};

// A solid on which a value is measured. The node with the parameter owns it. Null if none is given.
struct SolidName {
  const Node* node = nullptr;
  bool operator==(const SolidName&) const = default;
};

// A pair of words, such as an attribute and its overlap rule.
struct NamedWord {
  std::string name, word;
  bool operator==(const NamedWord&) const = default;
};

// A number or a material. If neither is given, it is the number 0.
struct NumberOrMaterial {
  Number number;
  MaterialName material;
  bool operator==(const NumberOrMaterial&) const = default;
};

// The design's material for the name `name` in a file.
struct MaterialForName {
  std::string name;
  MaterialName material;
  bool operator==(const MaterialForName&) const = default;
};

// The material at a number.
struct MaterialStop {
  double at = 0;
  MaterialName material;
  bool operator==(const MaterialStop&) const = default;
};

// An immutable list. Consecutive equal lists share memory, since loops make millions of them.
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
  std::shared_ptr<const std::vector<T>> list_;  // null if empty
};

// A strut of a lattice; lengths in mm.
struct Edge {
  Vec3 start, end;
  double radius = 0;  // 0 for the lattice's radius
  bool operator==(const Edge&) const = default;
};

// A word from a parameter's choices. Its text is part of the domain, or a literal.
class Choice {
 public:
  constexpr Choice(const char* text) : text_(text) {}  // NOLINT: implicit conversion from a literal
  std::string_view text() const { return text_; }
  bool operator==(std::string_view other) const { return text() == other; }

 private:
  const char* text_;
};

struct FilePath {
  std::string path;
  Hash content;  // hash of the file's content, set when it is loaded
  bool operator==(const FilePath&) const = default;
};

// Numbers of items along x, y and z.
using Counts3 = std::array<int, 3>;

// A list of points, all given by three numbers, or all by two with z = 0.
struct Points {
  std::vector<Vec3> at;
  bool are_flat = false;  // given by two numbers
  bool operator==(const Points&) const = default;
};

// A font, by its name or the path of its file.
struct FontName {
  std::string name;
  Hash content;  // hash of the font that was found
  bool operator==(const FontName&) const = default;
};

// Weights of the voxels around one, as lists along x of lists along y of lists along z.
struct Kernel {
  Counts3 size{};               // numbers of weights, 1 to 1000 each, if given
  std::vector<double> weights;  // z varies fastest; at most 10^6 finite weights, with a sum >= 0 and not all 0
  bool operator==(const Kernel&) const = default;
};

// Rows with the same number of values each, or the file that holds them.
struct NumberTable {
  std::vector<std::vector<double>> rows;
  FilePath file;  // empty if the rows were given directly
  bool operator==(const NumberTable&) const = default;
};

// Values for the variables of a script in another language, by name: numbers, texts, truth values, and lists of them.
struct ScriptVariables {
  DataMembers values;
  bool operator==(const ScriptVariables&) const = default;
};

// The values that a parameter may have, for checks, help and forms.
struct Domain {
  std::string_view unit;  // "mm", "deg", or empty
  double least = -std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::infinity();
  bool above_least = false;            // must be greater than `least`, not equal
  bool required = false;               // has no default
  std::vector<std::string> choices;    // words of a Choice
  std::vector<std::string> variables;  // known in expressions besides the coordinates
  bool may_mix = false;                // a material may be a mixture
  bool one_is_enough = false;     // of three numbers, a single one may be given, which stands for itself and two zeros
  bool child_attributes = false;  // expressions may use attributes of the inputs by name
};

// Returns the coordinates and the domain's additional variables.
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
// Domain of three numbers, in whose place a single one may be given.
inline Domain one_or_three(Domain domain = {}) {
  domain.one_is_enough = true;
  return domain;
}
// Domain of materials that may be mixtures.
inline Domain mixable(Domain domain = {}) {
  domain.may_mix = true;
  return domain;
}
inline Domain with_variables(std::vector<std::string> variables, Domain domain = {}) {
  domain.variables = std::move(variables);
  return domain;
}
// Domain of expressions that are evaluated over the node's input: d is its distance, t the position along its struts.
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

// Returns the value that formulas know by this name, or nothing.
using NamedValues = std::function<std::optional<Data>(const std::string& name)>;

// The context in which a parameter is read.
struct Reader {
  const MaterialTable& materials;
  Diagnostics& diagnostics;
  SourceLoader* loader = nullptr;
  SourceRange where;            // position of the call, for messages about missing values
  std::string_view node, name;  // node and parameter that are read
  const NamedValues* names = nullptr;
  std::vector<NodePtr>* values = nullptr;        // collects the nodes whose outputs the parameter holds
  const std::vector<NodePtr>* inputs = nullptr;  // the node's inputs, whose attributes expressions may use

  void keep(const NodePtr& value) const;
  bool fail(const Data& data, const std::string& expected, const Phrase& hint = {},
            Code code = Code::parameter_type) const;
};

// The functions `read` return true if `data` is valid; otherwise they add a diagnostic.
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
bool read(const Data& data, const Domain& domain, std::optional<Vec3>& value, const Reader& reader);  // null means none
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

// The functions `write` convert values back to data. For hashes, files are identified by their content.
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

// The kind of the parameter that collects the arguments of a call whose names match no other parameter.
inline constexpr std::string_view variables_kind = "values by name";

// Returns the kind's name for help: "number or field", "material", ...
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
