// Reads decks of Abaqus and CalculiX (.inp) as cards: a keyword line, and the lines of data below it.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/containers/text_scanner.h"
#include "formats/results/results.h"

namespace ombre::formats {

// A line of a deck or of a file that it includes.
struct DeckLine {
  const TextScanner* file = nullptr;  // reports errors of the file
  std::string_view text;              // without blanks at its ends
  size_t begin = 0, end = 0;          // where it stands in the file

  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const {
    file->fail_at(begin, end, message, hint);
  }
  // Returns the fields between commas without blanks at their ends. An empty field at the end is left out.
  std::vector<std::string_view> fields() const;
  // Returns the fields as numbers, where an empty field is 0. FORTRAN's forms of numbers (1.5D+2, 1.5+2) are accepted.
  std::vector<double> numbers() const;
};

// Returns the number of a node or element, which is whole and above 0. Reports an error at the line otherwise.
uint64_t deck_number(const DeckLine& line, double number);

struct Keyword {
  std::string name;                                            // "*end part": in lower case, with single blanks
  std::map<std::string, std::string, std::less<>> parameters;  // names in lower case, values as they are
  DeckLine line;

  bool has(std::string_view parameter) const { return parameters.contains(parameter); }
  // Returns the value; empty if it is not there.
  const std::string& value(std::string_view parameter) const;
  // Returns the value in lower case, by which names of sets and parts are compared.
  std::string name_of(std::string_view parameter) const;
};

// Takes the lines of a deck one by one. Lines may be kept until end() returns.
class DeckListener {
 public:
  virtual ~DeckListener() = default;
  virtual void keyword(const Keyword& keyword) = 0;
  virtual void data(const DeckLine& line) = 0;
  virtual void end() = 0;
};

// Reads the deck and the files that it includes or names as data (INPUT=), which must be in `beside`. Errors are
// reported, and DesignError is thrown.
void read_cards(const std::string& name, std::string_view bytes, const std::vector<ResultsFile>& beside,
                DeckListener& listener, Diagnostics& diagnostics);

// Returns the names of files in a deck, as they are written there.
std::vector<std::string> files_named_in_deck(std::string_view bytes, uint64_t step = 0);

}  // namespace ombre::formats
