// Texts of messages that spell options, calls and values in the reader's language: a script, a design file, Python or
// OpenSCAD.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ombre {

// The language of a design.
enum class Language : uint8_t { script, json, python, openscad };

// The program that shows messages, which determines how options of a job are spelled.
enum class FrontEnd : uint8_t { command_line, python, studio };

struct Wording {
  Language language = Language::script;
  FrontEnd front_end = FrontEnd::command_line;
};

// Returns the wording for a design file with this name ("part.json"). For a name without a known ending it is that of
// the front end's own language.
Wording wording_of(std::string_view file, FrontEnd front_end);

// A sentence or a part of one. Strings convert to phrases, and + joins phrases.
class Phrase {
 public:
  // Arguments of a call with their names, in the syntax of scripts. A name may be empty.
  using Arguments = std::vector<std::pair<std::string, std::string>>;
  enum class Form : uint8_t { text, call, around, parameter, value, option, assignment, either };

  Phrase() = default;
  Phrase(std::string text) : Phrase(Form::text, std::move(text), {}) {}
  Phrase(std::string_view text) : Phrase(std::string(text)) {}
  Phrase(const char* text) : Phrase(std::string(text)) {}
  // Called by the functions of namespace `spelled`.
  Phrase(Form form, std::string name, Arguments arguments);

  bool empty() const { return pieces_.empty(); }
  std::string in(const Wording& wording) const;
  // Returns the text for people who write scripts at the command line.
  std::string text() const { return in({}); }

  friend Phrase operator+(Phrase first, const Phrase& second);
  bool operator==(const Phrase&) const = default;

 private:
  struct Piece {
    Form form = Form::text;
    std::string name;
    Arguments arguments;
    bool operator==(const Piece&) const = default;
  };
  static std::string in(const Piece& piece, const Wording& wording);

  std::vector<Piece> pieces_;
};

namespace spelled {

// A call of a node: `sphere(radius=5)`, or {"type": "sphere", "parameters": {"radius": 5}}. Unnamed arguments become
// "..." in design files.
inline Phrase call(std::string node, Phrase::Arguments arguments = {}) {
  return {Phrase::Form::call, std::move(node), std::move(arguments)};
}
// A call of a node with solids inside: `tile(...) { ... }` or ombre.tile(solid, ...).
inline Phrase around(std::string node, Phrase::Arguments arguments = {{"", "..."}}) {
  return {Phrase::Form::around, std::move(node), std::move(arguments)};
}
// A parameter with its value: `angle=90` or "angle": 90.
inline Phrase parameter(std::string name, std::string value) {
  return {Phrase::Form::parameter, std::move(name), {{"", std::move(value)}}};
}
// A value in the syntax of scripts (a number, a quoted text, a vector or a list), translated to the language: `(0, 0,
// 1)` or [0, 0, 1].
inline Phrase value(std::string value) { return {Phrase::Form::value, std::move(value), {}}; }
// An option of a job: `--cell`, or `--voxel 1` with a value; `cell` and voxel=1 in Python.
inline Phrase option(std::string name, std::string value = "") {
  return {Phrase::Form::option, std::move(name), {{"", std::move(value)}}};
}
// An assignment to a variable of the design: `width = 1;`.
inline Phrase assignment(std::string name, std::string value) {
  return {Phrase::Form::assignment, std::move(name), {{"", std::move(value)}}};
}
// A text that differs in each language. OpenSCAD uses the script's.
inline Phrase either(std::string script, std::string json, std::string python) {
  return {Phrase::Form::either, std::move(script), {{"", std::move(json)}, {"", std::move(python)}}};
}

}  // namespace spelled
}  // namespace ombre
