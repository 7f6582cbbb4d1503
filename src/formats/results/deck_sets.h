// The sets and surfaces of a deck with how many members they have, for people who look for their names.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/results/deck_part.h"

namespace ombre::formats {

class DeckSets {
 public:
  // Remembers how the deck writes the names of sets, which it compares in lower case.
  void note_names(const Keyword& keyword);
  // Adds a line of data below *SURFACE, of the part with that index.
  void add_to_surface(const Keyword& surface, const DeckLine& line, size_t part);
  // Takes a line of *NSET or *ELSET for an instance, whose numbers are its own.
  void add_to_set_of_instance(const Keyword& set, const DeckLine& line);

  // Counts the sets and surfaces of a part once more, as each of its instances has them.
  void count(const DeckPart& mesh, size_t part);
  void add(ResultSet::Of of, const std::string& name, uint64_t count) { counts_[{of, name}] += count; }
  // Counts those of the assembly and returns all: nodes, elements, surfaces.
  std::vector<ResultSet> take();

 private:
  struct SideEntry {
    size_t part = 0;
    std::string surface, member;  // the name of a set, or a number
    ResultSet::Of of = ResultSet::Of::elements;
  };

  std::map<std::string, std::string> spellings_;  // by names in lower case
  std::map<std::string, DeckPart> of_instances_;  // sets of the assembly, by instance
  std::vector<SideEntry> sides_;
  std::map<std::pair<ResultSet::Of, std::string>, uint64_t> counts_;
};

}  // namespace ombre::formats
