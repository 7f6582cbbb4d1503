#include "lang/syntax/declaration.h"

#include <algorithm>
#include <array>

#include "base/text/text.h"

namespace ombre::lang {
namespace {

constexpr std::string_view block_sign = "///";

constexpr std::array<std::string_view, 18> units{"mm",  "mm2", "mm3", "1/mm", "um", "deg", "degrees", "%",     "s",
                                                 "MPa", "GPa", "N",   "K",    "C",  "g",   "kg",      "g/cm3", "dpi"};

bool is_type(std::string_view word) { return std::ranges::find(port_types(), word) != port_types().end(); }
bool is_unit(std::string_view word) { return std::ranges::find(units, word) != units.end(); }

std::string_view text_of(const SourcePtr& source) { return source->text(); }

// Returns the lines of the block that ends just above `begin`, without their signs.
std::vector<std::string> lines_above(std::string_view text, size_t begin) {
  std::vector<std::string> lines;
  size_t start = begin;
  while (start > 0 && text[start - 1] != '\n') --start;
  if (!trim(text.substr(start, begin - start)).empty()) return lines;
  while (start > 0) {
    const size_t end = start - 1;
    start = end;
    while (start > 0 && text[start - 1] != '\n') --start;
    const std::string_view line = trim(text.substr(start, end - start));
    if (!line.starts_with(block_sign)) break;
    lines.emplace_back(trim(line.substr(block_sign.size())));
  }
  std::ranges::reverse(lines);
  return lines;
}

void append(std::string& text, std::string_view more, char between) {
  if (!text.empty() && !more.empty()) text += between;
  text += more;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (const std::string& word : split(text, ' '))
    if (!word.empty()) words.push_back(word);
  return words;
}

// Reads outputs such as "index vector, local vector, edges value mm"; a single output needs no name.
std::vector<DeclaredOutput> read_outputs(std::string_view text) {
  std::vector<DeclaredOutput> outputs;
  for (const std::string& item : split(text, ',')) {
    DeclaredOutput output;
    std::vector<std::string> words = words_of(item);
    const bool has_name = words.size() > 1 ? is_type(words[1]) : !words.empty() && !is_type(words[0]);
    if (has_name) {
      output.name = words.front();
      words.erase(words.begin());
    }
    for (const std::string& word : words) (is_type(word) ? output.type : output.unit) = word;
    if (!has_name && words.empty()) continue;
    outputs.push_back(std::move(output));
  }
  return outputs;
}

// Reads the block: sentences, then lines that begin with a key. Other lines go on with the one before.
void read_block(const std::vector<std::string>& lines, Declaration& into) {
  std::string returns;
  struct Key {
    std::string_view sign;
    std::string* text;
    char between;
  };
  const Key keys[] = {{"Category:", &into.category, ' '},
                      {"Example:", &into.example, '\n'},
                      {"Source:", &into.source, ' '},
                      {"Returns:", &returns, ' '}};
  const Key description{"", &into.sentence, ' '};
  const Key* at = &description;
  for (const std::string& line : lines) {
    const auto key = std::ranges::find_if(keys, [&](const Key& candidate) { return line.starts_with(candidate.sign); });
    if (key != std::end(keys)) at = &*key;
    append(*at->text, trim(std::string_view(line).substr(key != std::end(keys) ? key->sign.size() : 0)), at->between);
  }
  into.outputs = read_outputs(returns);
}

// Returns the comment that follows on the line where a parameter ends. Only a comma or the closing parenthesis may
// stand between, so that the comment belongs to the last parameter of its line.
ast::Span comment_after(const ast::Span& parameter) {
  const std::string_view text = text_of(*parameter.source);
  const size_t at = std::min(text.find_first_not_of(" \t,)", parameter.end), text.size());
  if (!text.substr(at).starts_with("//")) return {};
  const size_t end = std::min(text.find_first_of(line_ends, at), text.size());
  return {parameter.source, static_cast<uint32_t>(at + 2), static_cast<uint32_t>(end)};
}

std::string type_of(const std::optional<Data>& value) {
  if (!value) return "";
  if (value->boolean()) return "truth";
  if (value->string()) return "text";
  return value->list() ? "vector" : "value";
}

class CommentReader {
 public:
  CommentReader(const ast::Span& where, DeclaredParameter& into, Diagnostics& diagnostics)
      : where_(where),
        rest_(trim(text_of(*where.source).substr(where.begin, where.end - where.begin))),
        into_(into),
        diagnostics_(diagnostics) {}

  void run() {
    read_brackets();
    read_words();
    into_.sentence = rest_;
  }

 private:
  void read_brackets() {
    const size_t close = rest_.find(']');
    if (!rest_.starts_with('[') || close == std::string_view::npos) return;
    const std::string_view inside = rest_.substr(1, close - 1);
    const bool is_list = inside.find(',') != std::string_view::npos || (into_.value && into_.value->string());
    if (is_list || !read_range(inside, into_)) read_choices(inside, into_.value && into_.value->string(), into_);
    rest_ = trim(rest_.substr(close + 1));
  }

  // Reads types and units before a colon, or alone.
  void read_words() {
    const size_t colon = rest_.find(':');
    const std::vector<std::string> words = words_of(rest_.substr(0, std::min(colon, rest_.size())));
    const auto unknown = std::ranges::find_if(words, [](const auto& word) { return !is_type(word) && !is_unit(word); });
    constexpr size_t most_words = 2;  // a type and a unit; more are the beginning of a sentence
    if (unknown != words.end()) {
      if (colon != std::string_view::npos && words.size() <= most_words) warn(*unknown);
      return;
    }
    for (const std::string& word : words) (is_type(word) ? into_.type : into_.unit) = word;
    rest_ = colon == std::string_view::npos ? "" : trim(rest_.substr(colon + 1));
  }

  void warn(const std::string& word) {
    diagnostics_.warning(where_.range(), "this comment declares the type or unit \"" + word + "\", which is not known",
                         "types are " + join(port_types(), ", ") + "; units are mm, deg and so on");
  }

  ast::Span where_;
  std::string_view rest_;
  DeclaredParameter& into_;
  Diagnostics& diagnostics_;
};

DeclaredParameter read_parameter(const ast::Parameter& parameter, Diagnostics& diagnostics) {
  DeclaredParameter result;
  result.name = parameter.name.text();
  if (parameter.value) {
    const std::string_view text = text_of(*parameter.whole.source);
    const std::string_view whole = text.substr(parameter.whole.begin, parameter.whole.end - parameter.whole.begin);
    result.default_text = trim(whole.substr(whole.find('=') + 1));
    result.value = plain_value(*parameter.value);
  }
  if (const ast::Span comment = comment_after(parameter.whole); comment.source)
    CommentReader(comment, result, diagnostics).run();
  if (result.type.empty()) result.type = type_of(result.value);
  return result;
}

template <class Definition>
std::optional<Declaration> read(const Definition& definition, bool is_module, Diagnostics& diagnostics) {
  const std::vector<std::string> lines = lines_above(text_of(*definition.span.source), definition.span.begin);
  if (lines.empty()) return std::nullopt;
  Declaration declaration;
  declaration.name = definition.name.text();
  declaration.is_module = is_module;
  read_block(lines, declaration);
  for (const ast::Parameter& parameter : definition.parameters)
    declaration.parameters.push_back(read_parameter(parameter, diagnostics));
  return declaration;
}

}  // namespace

const std::vector<std::string>& port_types() {
  static const std::vector<std::string> types{
      "number", "value",  "vector", "colour",    "mixture", "material", "text",  "solid", "region", "frame",
      "curve",  "points", "point",  "direction", "radius",  "length",   "image", "index", "truth"};
  return types;
}

std::optional<Declaration> read_declaration(const ast::ModuleDef& module, Diagnostics& diagnostics) {
  return read(module, true, diagnostics);
}

std::optional<Declaration> read_declaration(const ast::FunctionDef& function, Diagnostics& diagnostics) {
  return read(function, false, diagnostics);
}

std::vector<Declaration> declarations_of(const ast::File& file) {
  std::vector<Declaration> declarations;
  for (const ast::StatementPtr& statement : file.statements) {
    std::shared_ptr<const Declaration> declaration;
    if (statement->kind == ast::Statement::Kind::module)
      declaration = static_cast<const ast::ModuleDef&>(*statement).declaration;
    if (statement->kind == ast::Statement::Kind::function)
      declaration = static_cast<const ast::FunctionDef&>(*statement).declaration;
    if (declaration) declarations.push_back(*declaration);
  }
  return declarations;
}

}  // namespace ombre::lang
