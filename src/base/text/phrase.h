// Texts of messages in which names of options, calls and values are spelled as the reader's language spells them: a
// script's, a design file's, Python's, OpenSCAD's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ombre {

// What a design is written in.
enum class Language : uint8_t { script, json, python, openscad };

// Who shows messages: it says how the options of a job are given.
enum class FrontEnd : uint8_t { command_line, python, studio };

struct Wording {
  Language language = Language::script;
  FrontEnd front_end = FrontEnd::command_line;
};

// That of a design with this name, "part.json"; names without a known ending are in the front end's own language.
Wording wording_of(std::string_view file, FrontEnd front_end);

// A sentence, or a part of one. Texts turn into phrases, which are put together by +.
class Phrase {
 public:
  // Arguments of a call by their names, in a script's syntax; a name may be empty.
  using Arguments = std::vector<std::pair<std::string, std::string>>;
  enum class Form : uint8_t { text, call, around, parameter, value, option, assignment, either };

  Phrase() = default;
  Phrase(std::string text) : Phrase(Form::text, std::move(text), {}) {}
  Phrase(std::string_view text) : Phrase(std::string(text)) {}
  Phrase(const char* text) : Phrase(std::string(text)) {}
  // As the functions of `spelled` make them.
  Phrase(Form form, std::string name, Arguments arguments);

  bool empty() const { return pieces_.empty(); }
  std::string in(const Wording& wording) const;
  // For people who write scripts at the command line.
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

// A call of a node: `sphere(radius=5)`, or {"type": "sphere", "parameters": {"radius": 5}}. Arguments without a name
// are "..." in design files.
inline Phrase call(std::string node, Phrase::Arguments arguments = {}) {
  return {Phrase::Form::call, std::move(node), std::move(arguments)};
}
// A node around solids: `tile(...) { ... }`, ombre.tile(solid, ...).
inline Phrase around(std::string node, Phrase::Arguments arguments = {{"", "..."}}) {
  return {Phrase::Form::around, std::move(node), std::move(arguments)};
}
// `angle=90`, "angle": 90.
inline Phrase parameter(std::string name, std::string value) {
  return {Phrase::Form::parameter, std::move(name), {{"", std::move(value)}}};
}
// A number, a text in quotes, a vector or a list in a script's syntax: `(0, 0, 1)`, [0, 0, 1].
inline Phrase value(std::string value) { return {Phrase::Form::value, std::move(value), {}}; }
// An option of a job: --cell, `--voxel 1` with a value; `cell` and voxel=1 in Python.
inline Phrase option(std::string name, std::string value = "") {
  return {Phrase::Form::option, std::move(name), {{"", std::move(value)}}};
}
// A variable of the design: `width = 1;`.
inline Phrase assignment(std::string name, std::string value) {
  return {Phrase::Form::assignment, std::move(name), {{"", std::move(value)}}};
}
// What has nothing in common from language to language. OpenSCAD's is the script's.
inline Phrase either(std::string script, std::string json, std::string python) {
  return {Phrase::Form::either, std::move(script), {{"", std::move(json)}, {"", std::move(python)}}};
}

}  // namespace spelled
}  // namespace ombre
