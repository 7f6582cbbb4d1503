#include "jobs/stacks/diff_report.h"

#include <algorithm>

#include "base/text/text.h"
#include "jobs/common/remarks.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/stacks/report_page.h"

namespace ombre::jobs {
namespace {

using compile::LayerChanges;
using compile::MaterialChanges;
using compile::ValueChange;
using compile::ValueChanges;

constexpr size_t worst_layers = 6;

std::string volume_text(uint64_t voxels, const voxel::Lattice& lattice) {
  return format_rounded(static_cast<double>(voxels) * compile::voxel_mm3(lattice), 6) + " mm3 (" +
         format_count(voxels) + " voxels)";
}

std::string corner_text(const voxel::Lattice& lattice, const std::array<int64_t, 3>& corner) {
  std::vector<std::string> numbers;
  for (size_t axis = 0; axis < 3; ++axis)
    numbers.push_back(
        mm_text(lattice.origin[static_cast<int>(axis)] + lattice.pitch[axis].times(static_cast<double>(corner[axis]))));
  return "(" + join(numbers, ", ") + ")";
}

std::string layer_text(const LayerChanges& changed, const voxel::Lattice& lattice) {
  return "layer " + std::to_string(changed.layer) + " at z = " + mm_text(lattice.center(2, changed.layer)) +
         " mm: " + format_count(changed.voxels) + " voxels";
}

// The functions that take any changes are for both kinds of them, which have the layers in common.
template <class Changes>
size_t shown_layers(const Changes& changes) {
  return std::min(changes.layers.size(), worst_layers);
}

// Returns what changes, a line each.
std::vector<std::string> change_lines(const MaterialChanges& changes, const voxel::Lattice& lattice) {
  std::vector<std::string> lines{"the first one has " + volume_text(changes.inside[0], lattice) + ", the second one " +
                                 volume_text(changes.inside[1], lattice)};
  if (changes.layers.empty()) return lines;
  lines.push_back("lost " + volume_text(changes.lost(), lattice));
  lines.push_back("gained " + volume_text(changes.gained(), lattice));
  lines.push_back("of another material " + volume_text(changes.changed(), lattice));
  for (const auto& [pair, count] : changes.voxels)
    lines.push_back(changes.names[pair.first] + " to " + changes.names[pair.second] + "  " +
                    volume_text(count, lattice));
  lines.push_back("all within " + corner_text(lattice, changes.box.lo) + " to " + corner_text(lattice, changes.box.hi) +
                  " mm, in " + format_count(changes.layers.size()) + " layers");
  return lines;
}

std::string centre_text(const voxel::Lattice& lattice, const std::array<int64_t, 3>& at) {
  std::vector<std::string> numbers;
  for (size_t axis = 0; axis < 3; ++axis) numbers.push_back(mm_text(lattice.center(axis, at[axis])));
  return "(" + join(numbers, ", ") + ") mm";
}

// Returns "12.5 mJ/cm2".
std::string difference_text(double difference, const ValueChange& change) {
  const std::string unit = change.channel.type == voxel::ChannelType::colour ? "of 255" : change.channel.unit;
  return format_rounded(difference, 4) + (unit.empty() ? "" : " " + unit);
}

std::vector<std::string> change_lines(const ValueChanges& changes, const voxel::Lattice& lattice) {
  std::vector<std::string> lines;
  for (const ValueChange& change : changes.channels) {
    if (change.voxels == 0) {
      lines.push_back(change.channel.name + " is the same");
      continue;
    }
    lines.push_back(change.channel.name + " differs in " + volume_text(change.voxels, lattice) + ", by at most " +
                    difference_text(change.greatest, change) + ", at " + centre_text(lattice, change.where) +
                    ", and by " + difference_text(change.mean(), change) + " in the mean of these");
    lines.push_back("all within " + corner_text(lattice, change.box.lo) + " to " + corner_text(lattice, change.box.hi) +
                    " mm, in " + format_count(static_cast<uint64_t>(changes.layers.size())) + " layers");
  }
  return lines;
}

template <class Changes>
std::vector<std::string> layer_lines(const Changes& changes, const voxel::Lattice& lattice) {
  std::vector<std::string> lines;
  for (size_t n = 0; n < shown_layers(changes); ++n) lines.push_back(layer_text(changes.layers[n], lattice));
  return lines;
}

template <class Changes>
std::string verdict(const Changes& changes) {
  return changes.layers.empty() ? "there is no difference" : "they differ";
}

Data corner_data(const voxel::Lattice& lattice, const std::array<int64_t, 3>& corner) {
  DataList list;
  for (size_t axis = 0; axis < 3; ++axis)
    list.emplace_back(lattice.origin[static_cast<int>(axis)] +
                      lattice.pitch[axis].times(static_cast<double>(corner[axis])));
  return list;
}

template <class Changes>
DataList layers_of(const Changes& changes) {
  DataList layers;
  for (size_t n = 0; n < shown_layers(changes); ++n)
    layers.emplace_back(
        DataMembers{{"layer", number(changes.layers[n].layer)}, {"voxels", number(changes.layers[n].voxels)}});
  return layers;
}

DataList pitch_of(const voxel::Lattice& lattice) {
  DataList pitch;
  for (const Pitch& size : lattice.pitch) pitch.emplace_back(size.mm());
  return pitch;
}

DataMembers members_of(const ValueChanges& changes, const voxel::Lattice& lattice) {
  DataList channels;
  for (const ValueChange& change : changes.channels) {
    DataMembers members{{"name", change.channel.name},
                        {"voxels", number(change.voxels)},
                        {"mm3", static_cast<double>(change.voxels) * compile::voxel_mm3(lattice)},
                        {"greatest", change.greatest},
                        {"mean", change.mean()}};
    if (change.voxels > 0) {
      DataList where;
      for (size_t axis = 0; axis < 3; ++axis) where.emplace_back(lattice.center(axis, change.where[axis]));
      members.emplace_back("at_mm", std::move(where));
      members.emplace_back("box_mm",
                           DataList{corner_data(lattice, change.box.lo), corner_data(lattice, change.box.hi)});
    }
    channels.emplace_back(std::move(members));
  }
  return {{"same", changes.layers.empty()},
          {"voxel_mm", pitch_of(lattice)},
          {"channels", std::move(channels)},
          {"layers", layers_of(changes)}};
}

DataMembers members_of(const MaterialChanges& changes, const voxel::Lattice& lattice) {
  const auto mm3 = [&](uint64_t voxels) { return static_cast<double>(voxels) * compile::voxel_mm3(lattice); };
  DataList pairs;
  for (const auto& [pair, count] : changes.voxels)
    pairs.emplace_back(DataMembers{{"from", changes.names[pair.first]},
                                   {"to", changes.names[pair.second]},
                                   {"voxels", number(count)},
                                   {"mm3", mm3(count)}});
  DataMembers members{
      {"same", changes.layers.empty()},        {"voxel_mm", pitch_of(lattice)},   {"first_mm3", mm3(changes.inside[0])},
      {"second_mm3", mm3(changes.inside[1])},  {"lost_mm3", mm3(changes.lost())}, {"gained_mm3", mm3(changes.gained())},
      {"changed_mm3", mm3(changes.changed())}, {"materials", std::move(pairs)},   {"layers", layers_of(changes)}};
  if (!changes.layers.empty())
    members.emplace_back("box_mm",
                         DataList{corner_data(lattice, changes.box.lo), corner_data(lattice, changes.box.hi)});
  return members;
}

template <class Changes>
void tell(const Events& events, const Changes& changes, const voxel::Lattice& lattice) {
  if (events.wants_data()) {
    if (!changes.layers.empty()) events.warn(verdict(changes));
    return events.event("changes", members_of(changes, lattice));
  }
  std::string text;
  for (const std::string& line : change_lines(changes, lattice)) text += line + "\n";
  for (const std::string& line : layer_lines(changes, lattice)) text += "  " + line + "\n";
  events.print(text + verdict(changes) + "\n");
}

// Returns a page whose pictures show the layers that change most.
template <class Changes, class Picture>
std::string page_of(const compile::DiffChoices& choices, const Changes& changes, const voxel::Lattice& lattice,
                    const std::string& heading, const Picture& picture_of_layer) {
  ReportPage page(choices.first + " and " + choices.second + ": " + verdict(changes));
  page.add_list("Changes", change_lines(changes, lattice));
  if (changes.layers.empty()) return page.html();
  page.add_heading(heading);
  for (size_t n = 0; n < shown_layers(changes); ++n)
    page.add_picture(layer_text(changes.layers[n], lattice), picture_of_layer(changes.layers[n].layer));
  return page.html();
}

}  // namespace

void tell_changes(const Events& events, const MaterialChanges& changes, const voxel::Lattice& lattice) {
  tell(events, changes, lattice);
}

void tell_changes(const Events& events, const ValueChanges& changes, const voxel::Lattice& lattice) {
  tell(events, changes, lattice);
}

std::string changes_page(const compile::DiffChoices& choices, const MaterialChanges& changes,
                         const compile::ComparedSolid& a, const compile::ComparedSolid& b,
                         const voxel::Lattice& lattice) {
  return page_of(choices, changes, lattice,
                 "Layers that change most: lost in red, gained in blue, of another material in orange",
                 [&](int64_t layer) { return picture_of_changes(a, b, changes, lattice, layer); });
}

std::string changes_page(const compile::DiffChoices& choices, const ValueChanges& changes,
                         const compile::ComparedValues& a, const compile::ComparedValues& b,
                         const voxel::Lattice& lattice) {
  return page_of(
      choices, changes, lattice,
      "Layers of " + a.channels.front().name + " that change most: less in red, more in blue, other colours in orange",
      [&](int64_t layer) { return picture_of_values(a, b, lattice, layer); });
}

}  // namespace ombre::jobs
