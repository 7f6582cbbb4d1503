#include "jobs/mesh/mixed_filaments.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "formats/slicers/slicer_settings.h"
#include "jobs/common/session.h"
#include "questions/build.h"
#include "questions/region_survey.h"

namespace ombre::jobs {
namespace {

constexpr double percent = 100;

// The two filaments of the mixture.
struct FilamentPair {
  const design::Material *first = nullptr, *second = nullptr;
};

FilamentPair pair_of(const compile::Loaded& loaded, Diagnostics& diagnostics) {
  const auto box = compile::design_box(loaded.design, diagnostics);
  const auto inside = box ? compile::find_materials(loaded.design, *box, 1, diagnostics) : std::nullopt;
  if (!inside || inside->names.size() != 2)
    throw WrongArgument(spelled::option("--mix-layers") + " is for mixtures of two materials; the design has " +
                        (inside ? join(inside->names, ", ") : "none"));
  return {loaded.design.materials.find(inside->names[0]), loaded.design.materials.find(inside->names[1])};
}

// Returns the fraction of the pair's first material in the middle of a band.
double first_share(const compile::Region& region, const FilamentPair& pair) {
  if (region.fractions.size() != 1)
    throw WrongArgument(spelled::option("--mix-layers") + " is for bands of one fraction; write " +
                        spelled::option("--by", pair.first->name));
  const auto& [material, middle] = region.fractions[0];
  return material == pair.first->id ? middle : 1 - middle;
}

formats::FilamentMixture mixture_of(const FilamentPair& pair, const LayerCycle& cycle) {
  formats::FilamentMixture mixture;
  mixture.name = std::to_string(cycle.first) + " " + pair.first->name + " to " +
                 std::to_string(cycle.layers - cycle.first) + " " + pair.second->name;
  mixture.parts = {{1, cycle.first}, {2, cycle.layers - cycle.first}};
  for (size_t part = 0; part < mixture.colour.size(); ++part)
    mixture.colour[part] = static_cast<uint8_t>(
        std::lround(cycle.share() * pair.first->colour[part] + (1 - cycle.share()) * pair.second->colour[part]));
  return mixture;
}

// Returns the extruder of a cycle, and adds the mixture if it is a new one.
size_t extruder_for(const FilamentPair& pair, const LayerCycle& cycle,
                    std::vector<formats::FilamentMixture>& mixtures) {
  if (cycle.first == cycle.layers) return 1;
  if (cycle.first == 0) return 2;
  formats::FilamentMixture mixture = mixture_of(pair, cycle);
  auto same = std::ranges::find(mixtures, mixture.name, &formats::FilamentMixture::name);
  if (same == mixtures.end()) same = mixtures.insert(same, std::move(mixture));
  return static_cast<size_t>(same - mixtures.begin()) + 3;
}

}  // namespace

LayerCycle nearest_cycle(double share, int most) {
  LayerCycle nearest{share < 0.5 ? 0 : 1, 1};
  for (int layers = 2; layers <= most; ++layers) {
    const LayerCycle cycle{static_cast<int>(std::lround(share * layers)), layers};
    if (std::abs(cycle.share() - share) < std::abs(nearest.share() - share) - 1e-12) nearest = cycle;
  }
  return nearest;
}

void add_mixed_filaments(const compile::Loaded& loaded, const compile::MeshedDesign& made, int most_layers,
                         const Events& events, Diagnostics& diagnostics, formats::MeshDocument& document) {
  const FilamentPair pair = pair_of(loaded, diagnostics);
  document.project.filaments = {{pair.first->name, pair.first->colour, {}, {}},
                                {pair.second->name, pair.second->colour, {}, {}}};
  DataList reported;
  double worst = 0;
  for (size_t n = 0; n < made.bodies.size(); ++n) {
    const double wanted = first_share(made.bodies[n].region, pair);
    const LayerCycle cycle = nearest_cycle(wanted, most_layers);
    const size_t extruder = extruder_for(pair, cycle, document.project.mixtures);
    formats::set_extruder(document.bodies[n], extruder);
    worst = std::max(worst, std::abs(cycle.share() - wanted));
    events.say(made.bodies[n].region.name + ": " + std::to_string(cycle.first) + " of " + std::to_string(cycle.layers) +
               " layers " + pair.first->name + ", " + format_rounded(percent * cycle.share(), 3) + " % for " +
               format_rounded(percent * wanted, 3) + " %");
    reported.push_back(DataMembers{{"name", made.bodies[n].region.name},
                                   {"extruder", number(extruder)},
                                   {"first", number(cycle.first)},
                                   {"layers", number(cycle.layers)},
                                   {"wanted", wanted}});
  }
  events.say("shares of bodies are off by up to " + format_rounded(percent * worst, 3) +
             " % from the middles of their bands");
  events.event("mixtures",
               {{"materials", DataList{pair.first->name, pair.second->name}}, {"bodies", reported}, {"worst", worst}});
}

}  // namespace ombre::jobs
