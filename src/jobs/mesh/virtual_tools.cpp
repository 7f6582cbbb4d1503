#include "jobs/mesh/virtual_tools.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "formats/slicers/slicer_settings.h"
#include "jobs/common/session.h"

namespace ombre::jobs {
namespace {

std::optional<double> middle_of(const compile::Region& region, const std::string& attribute) {
  for (const auto& [name, middle] : region.attributes)
    if (name == attribute) return middle;
  return std::nullopt;
}

formats::Filament tool_of(const compile::RegionBody& body) {
  formats::Filament tool;
  tool.colour = body.colour;
  std::vector<std::string> words;
  if (const auto temperature = middle_of(body.region, "temperature")) {
    tool.temperature = std::round(*temperature);
    words.push_back(format_rounded(*tool.temperature, 6) + " C");
  }
  if (const auto flow = middle_of(body.region, "flow_rate")) {
    constexpr double percent = 100;
    tool.flow = std::round(*flow * percent) / percent;
    words.push_back("flow " + format_rounded(percent * *tool.flow, 4) + " %");
  }
  tool.name = join(words, ", ");
  return tool;
}

}  // namespace

void add_virtual_tools(const compile::MeshedDesign& made, const Events& events, formats::MeshDocument& document) {
  std::vector<formats::Filament>& tools = document.project.filaments;
  for (size_t n = 0; n < made.bodies.size(); ++n) {
    formats::Filament tool = tool_of(made.bodies[n]);
    if (tool.name.empty())
      throw WrongArgument(spelled::option("--virtual-tools") +
                          " is for bands of temperature or flow_rate; write for example " +
                          spelled::option("--by", "temperature"));
    auto same = std::ranges::find(tools, tool.name, &formats::Filament::name);
    if (same == tools.end()) same = tools.insert(tools.end(), std::move(tool));
    formats::set_extruder(document.bodies[n], static_cast<size_t>(same - tools.begin()) + 1);
  }
  if (tools.size() > formats::most_filaments)
    throw WrongArgument(std::to_string(tools.size()) +
                        " pairs of temperature and flow need a tool each, and a project has at most " +
                        std::to_string(formats::most_filaments) + "; choose fewer " + spelled::option("--bands"));
  document.project.has_one_nozzle = true;
  DataList reported;
  for (size_t n = 0; n < tools.size(); ++n) {
    events.say("tool " + std::to_string(n + 1) + ": " + tools[n].name);
    reported.push_back(tools[n].name);
  }
  events.event("tools", {{"tools", reported}});
}

}  // namespace ombre::jobs
