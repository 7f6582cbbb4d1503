#include "formats/results/deck_sets.h"

#include "base/text/text.h"

namespace ombre::formats {

void DeckSets::note_names(const Keyword& keyword) {
  for (const char* parameter : {"nset", "elset", "new set"})
    if (keyword.has(parameter)) spellings_.try_emplace(keyword.name_of(parameter), keyword.value(parameter));
  if (keyword.name == "*surface") spellings_.try_emplace(keyword.name_of("name"), keyword.value("name"));
}

void DeckSets::add_to_surface(const Keyword& surface, const DeckLine& line, size_t part) {
  const auto fields = line.fields();
  if (fields.empty()) return;
  const auto of = surface.name_of("type") == "node" ? ResultSet::Of::nodes : ResultSet::Of::elements;
  sides_.push_back({part, surface.name_of("name"), std::string(fields.front()), of});
}

void DeckSets::add_to_set_of_instance(const Keyword& set, const DeckLine& line) {
  DeckPart& sets = of_instances_[set.name_of("instance")];
  if (set.name == "*nset")
    sets.add_to_node_set(set, line);
  else
    sets.add_to_element_set(set, line);
}

void DeckSets::count(const DeckPart& mesh, size_t part) {
  for (const ResultSet& set : mesh.sets()) add(set.of, set.name, set.count);
  for (const SideEntry& side : sides_)
    if (side.part == part) add(ResultSet::Of::sides, side.surface, mesh.size_of(side.of, side.member));
}

std::vector<ResultSet> DeckSets::take() {
  for (const auto& [instance, sets] : of_instances_) {
    for (const ResultSet& set : sets.sets()) add(set.of, set.name, set.count);
    for (const SideEntry& side : sides_)
      if (side.part == 0 && !parse_number(side.member))
        add(ResultSet::Of::sides, side.surface, sets.size_of(side.of, side.member));
  }
  std::vector<ResultSet> list;
  for (const auto& [key, count] : counts_) {
    const auto spelling = spellings_.find(key.second);
    list.push_back({spelling == spellings_.end() ? key.second : spelling->second, key.first, count});
  }
  return list;
}

}  // namespace ombre::formats
