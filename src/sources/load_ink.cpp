// Loads ICC profiles of inks for designs.
#include <algorithm>

#include "ink/ink_table.h"
#include "sources/loading.h"

namespace ombre::design {

std::shared_ptr<const InkShares> InkRequest::load(sources::Loading& loading) {
  if (!loading.find(profile) || !loading.read_content(profile)) return nullptr;
  using Made = sources::Loading::Made<InkShares>;
  const auto& names = ink::intent_names();
  const auto rule = static_cast<ink::Intent>(std::ranges::find(names, intent.text()) - names.begin());
  sources::Key key("ink");
  key.add(profile.content).add(intent.text()).add(black_point ? 1 : 0);
  return loading.cached<InkShares>(key.hash(), profile.path, [&](const Reader&) {
    const ink::Profile file{profile.path, loading.bytes(profile)};
    ink::InkTable table = ink::make_ink_table(file, {rule, black_point}, loading.threads());
    const size_t inks = table.inks(), bytes = table.values.size() * table.values.front().size() * sizeof(double);
    return Made{std::make_shared<InkShares>(InkShares{inks, ink::facts_of(file).space, std::move(table.values),
                                                      table.most_ink, table.mean_error, table.worst_error}),
                bytes};
  });
}

}  // namespace ombre::design
