// Edits of a script's graph, each of which is an edit of its text. Comments and layout of the rest stay.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lang/edit/replacement.h"
#include "lang/edit/script_graph.h"

namespace ombre::lang {

// Items are named by their numbers in the graph.

// Gives a parameter a value: the argument at `index`, or a new one with a name. An empty value removes the argument.
struct SetArgument {
  size_t item = 0;
  std::optional<size_t> index;
  std::string name, value;
};

// Adds a call: at the end of the script, as the last child of an item, after an item, or around it.
struct InsertCall {
  enum class Where : uint8_t { end, inside, after, around };
  Where where = Where::end;
  size_t item = 0;
  std::string call;  // such as sphere(5) or translate([1, 0, 0])
};

// Adds a variable behind those at the top level.
struct AddVariable {
  std::string name, value;
};

// Removes a call or a variable. Its children go with it, or take its place.
struct RemoveItem {
  size_t item = 0;
  bool keeps_children = false;
};

// Gives a parameter the value of a variable, or of one of its members. A call in an expression becomes a variable
// first.
struct ConnectItems {
  size_t from = 0;
  std::string output;
  SetArgument to;  // its value is not used
};

// Gives a variable another name, also where it is used.
struct RenameVariable {
  size_t item = 0;
  std::string name;
};

// Makes a call the last child of another one, or puts it at the end of the script.
struct MoveCall {
  size_t item = 0;
  std::optional<size_t> into;
};

// Makes a module of calls that follow each other, and calls it in their place. Some arguments become its parameters,
// with their values as defaults.
struct GroupCalls {
  struct Parameter {
    size_t item = 0, argument = 0;
    std::string name;
  };
  std::vector<size_t> items;
  std::string name, sentence;
  std::vector<Parameter> parameters;
};

// Names a library of operators by a line use <...>, unless there is one.
struct UseLibrary {
  std::string path;
};

// Moves a module that stands outside of braces, with the comments above it, into a library, which the script then
// uses. A module without a declaration gets the sentence as one.
struct MoveToLibrary {
  std::string module, path, sentence;
};

using GraphEdit = std::variant<SetArgument, InsertCall, AddVariable, RemoveItem, ConnectItems, RenameVariable, MoveCall,
                               GroupCalls, UseLibrary, MoveToLibrary>;

struct EditedScript {
  std::vector<Replacements> steps;  // each of the text that the one before it has made
  SourcePtr text;                   // after all steps
  std::optional<size_t> made;       // the place in it of what an edit has added
  std::string library = {};         // the text of a library that the edit has made; the caller writes it
};

// Returns nothing, with the reason in the diagnostics, if the script has mistakes, or the edit cannot be made.
std::optional<EditedScript> edit(const SourcePtr& script, Dialect dialect, const GraphEdit& edit,
                                 Diagnostics& diagnostics);

}  // namespace ombre::lang
