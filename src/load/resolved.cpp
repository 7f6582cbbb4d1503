#include "load/resolved.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "design/attributes.h"
#include "load/design_sources.h"
#include "load/find_calibration.h"
#include "load/ink_step.h"
#include "load/node_maker.h"
#include "load/step_nodes.h"
#include "questions/build.h"
#include "questions/compare_designs.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

using calibration::Calibration;
using calibration::CalibrationPtr;
using calibration::Chain;
using calibration::ChainProblem;
using calibration::Step;
using design::NodePtr;

Data text_data(const std::vector<std::string>& texts) {
  DataList list;
  for (const std::string& text : texts) list.emplace_back(text);
  return Data(std::move(list));
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

class Resolver {
 public:
  Resolver(const LoadedPtr& loaded, const std::vector<CalibrationPtr>& calibrations, const Needs& needs,
           Diagnostics& diagnostics)
      : loaded_(loaded), needs_(needs), diagnostics_(diagnostics), where_{loaded->source, 0, 0} {
    for (const CalibrationPtr& calibration : calibrations)
      if (has_materials(*calibration)) usable_.push_back(for_colours_of(loaded->design, calibration));
    given_ = given_quantities(loaded->design);
  }

  std::optional<Resolution> run() {
    if (!limit_to_deciding()) return std::nullopt;
    for (const std::string& need : needs_.needs)
      if (!add_chains(need)) return std::nullopt;
    round_given();
    const LoadedPtr made = steps_.empty() && rounded_.empty() ? loaded_ : design_with(steps_);
    if (!made) return std::nullopt;
    std::vector<ResolvedStep> agreeing;
    for (const Rival& rival : rivals_)
      if (!agrees(rival, *made, agreeing)) return std::nullopt;
    return Resolution{made, std::move(steps_), std::move(unusable_), std::move(agreeing), std::move(rounded_)};
  }

 private:
  // A chain that leads to what others lead to as well.
  struct Rival {
    std::string need;
    Chain chosen, other;
  };

  bool has_materials(const Calibration& calibration) {
    const auto lacks = [&](const std::vector<std::string>& names) {
      if (names.empty() || material_among(loaded_->design.materials, names)) return false;
      unusable_.push_back(calibration.name + " needs the material " + names.front() +
                          (names.size() > 1 ? " or another one of its list" : "") + ", which the materials file lacks");
      return true;
    };
    return std::ranges::none_of(calibration.inputs, [&](const auto& input) { return lacks(input.materials); }) &&
           !lacks(calibration.rest) && !(calibration.inks && lacks(calibration.inks->clear));
  }

  // Leaves only what decides among the given attributes. Materials that the design names stay.
  bool limit_to_deciding() {
    if (needs_.deciding.empty()) return true;
    for (const std::string& name : needs_.deciding) {
      if (is_among(given_, name)) continue;
      const std::string hint = did_you_mean(name, given_);
      diagnostics_.error(Code::unknown_attribute, where_,
                         "the design gives no number or colour \"" + name + "\", which is to decide",
                         hint.empty() ? "it gives " + join(given_, ", ") : hint);
      return false;
    }
    std::erase_if(given_, [&](const std::string& name) {
      return name != calibration::fractions && !is_among(needs_.deciding, name);
    });
    return true;
  }

  std::optional<double> machine_step(const std::string& quantity) const {
    const auto found = std::ranges::find(needs_.steps, quantity, &voxel::ValueStep::of);
    return found == needs_.steps.end() ? std::nullopt : std::optional(found->size);
  }

  bool add_chains(const std::string& need) {
    const std::vector<Step> joints = need == calibration::fractions ? joint_steps() : std::vector<Step>();
    if (joints.size() > 1) {
      diagnostics_.error(Code::parameters, where_, calibration::several_text({{joints[0]}, {joints[1]}}, need),
                         choosing_hint());
      return false;
    }
    if (joints.size() == 1) return add({joints.front()}) && add_rivals_of(joints.front());
    const auto found = calibration::find_chains(usable_, given_, need);
    if (const auto* problem = std::get_if<ChainProblem>(&found)) {
      if (needs_.unresolved == Unresolved::is_left) return true;
      diagnostics_.error(Code::parameters, where_, problem->message,
                         unusable_.empty() ? problem->hint : problem->hint + "; " + join(unusable_, "; "));
      return false;
    }
    const auto& chains = std::get<std::vector<Chain>>(found);
    if (chains.size() == 1) return add(chains.front());
    if (const int inks = ink_chain(chains); inks >= 0)
      return add(chains[static_cast<size_t>(inks)]) && add_over_inks(chains[static_cast<size_t>(1 - inks)]);
    return decides_by_one(chains, need) && add(chains.front());
  }

  // Returns the steps from two of the given properties to the fractions of three materials.
  std::vector<Step> joint_steps() const {
    std::vector<Step> steps;
    if (is_among(given_, std::string(calibration::fractions))) return steps;
    for (size_t n = 0; n < usable_.size(); ++n)
      for (size_t m = n + 1; m < usable_.size(); ++m)
        if (gives_mixture(*usable_[n]) && gives_mixture(*usable_[m]) && usable_[n]->property != usable_[m]->property &&
            order_in(*usable_[n], *usable_[m]))
          steps.push_back({usable_[n], 0, usable_[m]});
    return steps;
  }

  bool gives_mixture(const Calibration& calibration) const {
    return is_among(given_, calibration.property) && calibration::mixture_law(calibration);
  }

  // Returns the materials of a rule of mixtures, the rest first.
  std::vector<std::string> mixed_materials(const Calibration& calibration) const {
    std::vector<std::string> names{*material_among(loaded_->design.materials, calibration.rest)};
    for (const calibration::Input& input : calibration.inputs)
      names.push_back(*material_among(loaded_->design.materials, input.materials));
    return names;
  }

  // Returns where each material of a mixture stands among those of another one; nothing if they are not the same.
  std::optional<std::array<size_t, 3>> order_in(const Calibration& calibration, const Calibration& other) const {
    const std::vector<std::string> names = mixed_materials(calibration), others = mixed_materials(other);
    std::array<size_t, 3> order{};
    for (size_t n = 0; n < order.size(); ++n) {
      order[n] = static_cast<size_t>(std::ranges::find(others, names[n]) - others.begin());
      if (order[n] == others.size()) return std::nullopt;
    }
    return order;
  }

  // Chains from other attributes to the fractions must agree with a joint step.
  bool add_rivals_of(const Step& joint) {
    std::vector<std::string> others = given_;
    std::erase_if(others, [&](const std::string& name) { return is_among(joint.from(), name); });
    const auto found = calibration::find_chains(usable_, others, std::string(calibration::fractions));
    if (const auto* chains = std::get_if<std::vector<Chain>>(&found))
      for (const Chain& chain : *chains) rivals_.push_back({std::string(calibration::fractions), {joint}, chain});
    return true;
  }

  // Fills in a step with two calibrations.
  std::optional<ResolvedStep> completed_joint(ResolvedStep resolved) {
    const Calibration &one = *resolved.step.calibration, &two = *resolved.step.beside;
    const calibration::MixtureLaw law = *calibration::mixture_law(one), other = *calibration::mixture_law(two);
    calibration::MixtureLaw ordered = other;
    const std::array<size_t, 3> order = *order_in(one, two);
    for (size_t n = 0; n < order.size(); ++n) ordered.values[n] = other.values[order[n]];
    if (!calibration::determine_fractions(law, ordered)) {
      diagnostics_.error(Code::parameters, where_,
                         "by " + resolved.step.names() + " " + one.property + " and " + two.property +
                             " follow from each other, so that they do not determine the fractions of three materials",
                         choosing_hint());
      return std::nullopt;
    }
    resolved.joint.emplace(law, ordered);
    resolved.unit = one.unit;
    resolved.reach = one.reach_of_mixtures();
    resolved.others = {{two.property, two.unit, two.reach_of_mixtures()}};
    resolved.place_in_reach = one.property + "_and_" + two.property + "_place_in_reach";
    resolved.materials = mixed_materials(one);
    std::rotate(resolved.materials.begin(), resolved.materials.begin() + 1,
                resolved.materials.end());  // the rest comes last
    return has_unit(resolved) ? std::optional(std::move(resolved)) : std::nullopt;
  }

  // Adds the steps that earlier ones do not give.
  bool add(const Chain& chain) {
    for (const Step& step : chain) {
      if (std::ranges::any_of(steps_, [&](const auto& other) { return other.step.to() == step.to(); })) continue;
      auto made = completed(step);
      if (!made) return false;
      steps_.push_back(std::move(*made));
    }
    return true;
  }

  // Returns which of two chains is a colour by inks that the other one mixes with a further material: all inks are
  // among those that the other calibration takes for its only fraction. -1: none.
  int ink_chain(const std::vector<Chain>& chains) const {
    if (chains.size() != 2) return -1;
    for (size_t n = 0; n < 2; ++n) {
      if (chains[n].empty() || chains[1 - n].empty()) continue;
      const Calibration &inks = *chains[n].back().calibration, &other = *chains[1 - n].back().calibration;
      if (inks.inks && !other.inks && other.inputs.size() == 1 && takes_all_of(other, inks)) return static_cast<int>(n);
    }
    return -1;
  }

  bool takes_all_of(const Calibration& other, const Calibration& inks) const {
    const design::MaterialTable& table = loaded_->design.materials;
    const std::vector<std::string>& taken = other.inputs.front().materials;
    const auto is_taken = [&](const std::vector<std::string>& names) {
      const auto name = material_among(table, names);
      return !name || std::ranges::any_of(taken, [&](const std::string& one) {
        const design::Material* material = table.find(one);
        return material && material->name == *name;
      });
    };
    return std::ranges::all_of(inks.inputs, [&](const auto& input) { return is_taken(input.materials); }) &&
           is_taken(inks.rest) && (inks.inks->clear.empty() || is_taken(inks.inks->clear));
  }

  // Adds a chain whose last step mixes what the inks give with another material.
  bool add_over_inks(const Chain& chain) {
    if (!add(Chain(chain.begin(), chain.end() - 1))) return false;
    auto last = completed(chain.back());
    if (!last) return false;
    last->is_over_inks = true;
    steps_.push_back(std::move(*last));
    return true;
  }

  // Returns false, and adds an error, if two of the chains begin with the same attributes. The others are rivals, which
  // are compared later.
  bool decides_by_one(const std::vector<Chain>& chains, const std::string& need) {
    std::vector<std::string> first = calibration::begins_with(chains.front());
    std::ranges::sort(first);
    for (size_t n = 1; n < chains.size(); ++n) {
      std::vector<std::string> other = calibration::begins_with(chains[n]);
      std::ranges::sort(other);
      if (other == first || chains[n].back().calibration->inks || chains.front().back().calibration->inks) {
        diagnostics_.error(Code::parameters, where_, calibration::several_text({chains.front(), chains[n]}, need),
                           choosing_hint());
        return false;
      }
      rivals_.push_back({need, chains.front(), chains[n]});
    }
    return true;
  }

  static Phrase choosing_hint() {
    return Phrase("choose one with ") + spelled::option("--calibration", "NAME") +
           ", or the attribute that decides with " + spelled::option("--deciding", "ATTRIBUTE");
  }

  // Rounds what the design gives itself, unless a step gives it.
  void round_given() {
    for (const voxel::ValueStep& step : needs_.steps) {
      if (step.of == calibration::fractions || !is_among(given_, step.of)) continue;
      rounded_.push_back(step);
    }
  }

  // Returns the design with what the steps give, or null and diagnostics.
  LoadedPtr design_with(const std::vector<ResolvedStep>& steps) {
    auto made = std::make_shared<Loaded>(*loaded_);
    for (design::Part& part : made->design.parts) {
      const NodeMaker maker(loaded_->design, part.solid->where(), diagnostics_, &loader_);
      for (const voxel::ValueStep& step : rounded_)
        if (part.solid) part.solid = with_rounded(part.solid, step.of, step.size, maker);
      for (const ResolvedStep& step : steps)
        if (part.solid) part.solid = with_step(part.solid, step, maker);
      if (!part.solid) return nullptr;
    }
    return design::check_design(made->design, diagnostics_) ? made : nullptr;
  }

  // Adds the steps of a chain that leads to what the design has already, unless they contradict it somewhere.
  bool agrees(const Rival& rival, const Loaded& made, std::vector<ResolvedStep>& agreeing) {
    std::vector<ResolvedStep> steps;
    for (const Step& step : rival.other) {
      auto completed_step = completed(step);
      if (!completed_step) return false;
      steps.push_back(std::move(*completed_step));
    }
    const LoadedPtr other = design_with(steps);
    const auto box = other ? design_box(made.design, diagnostics_) : std::nullopt;
    if (!box) return false;
    const bool are_fractions = rival.need == calibration::fractions;
    const size_t errors = diagnostics_.error_count();
    const auto difference =
        greatest_difference(made.design, other->design, are_fractions ? "" : rival.need, *box, diagnostics_);
    if (diagnostics_.error_count() > errors) return false;
    const double whole = are_fractions ? 1 : whole_of(rival.chosen.back());
    if (difference && std::abs(difference->second - difference->first) > agreement_tolerance * whole) {
      report_contradiction(rival, *difference);
      return false;
    }
    agreeing.insert(agreeing.end(), steps.begin(), steps.end());
    return true;
  }

  // Returns the width of what a step can give.
  static double whole_of(const Step& step) {
    const Calibration& calibration = *step.calibration;
    const Interval all =
        step.input ? *calibration.inputs[*step.input].valid : calibration.reach(0, calibration.usual());
    return all.hi - all.lo;
  }

  void report_contradiction(const Rival& rival, const Difference& difference) {
    const std::string what = rival.need == calibration::fractions ? "a fraction of " + difference.of : difference.of;
    const auto attributes = [](const Chain& chain) { return join(calibration::begins_with(chain), " and "); };
    diagnostics_.error(Code::parameters, where_,
                       calibration::several_text({rival.chosen, rival.other}, rival.need) +
                           "; they contradict each other: at " + format_point(difference.at) + " mm " +
                           attributes(rival.chosen) + " needs " + what + ' ' + format_rounded(difference.first, 4) +
                           ", and " + attributes(rival.other) + " needs " + format_rounded(difference.second, 4),
                       Phrase("ask for what both allow, or ") + choosing_hint());
  }

  // Fills in what the step reads, and its materials. Returns nothing, and adds an error, if jobs cannot follow it.
  std::optional<ResolvedStep> completed(const Step& step) {
    ResolvedStep resolved{step, "", "", {}};
    const Calibration& calibration = *step.calibration;
    const std::vector<std::string> from = step.from();
    if (is_among(from, std::string(calibration::fractions))) {
      diagnostics_.error(Code::parameters, where_,
                         calibration.name + " gives " + step.to() + " from " + join(from, " and ") +
                             ", and jobs follow attributes alone",
                         "give " + step.to() + " in the design");
      return std::nullopt;
    }
    resolved.rounds_to = machine_step(step.to());
    resolved.attribute = from.front();
    if (step.beside) return completed_joint(std::move(resolved));
    if (calibration.inks) {
      if (!complete_inks(resolved)) return std::nullopt;
      if (resolved.rounds_to) diagnostics_.note(where_, "shares of inks are not rounded to what the machine takes");
      resolved.rounds_to.reset();
      return resolved;
    }
    set_reaches(resolved, from);
    for (const calibration::Input& input : calibration.inputs)
      resolved.materials.push_back(input.is_fraction() ? *material_among(loaded_->design.materials, input.materials)
                                                       : "");
    if (calibration.has_fractions())
      resolved.materials.push_back(*material_among(loaded_->design.materials, calibration.rest));
    if (!has_unit(resolved)) return std::nullopt;
    return resolved;
  }

  static void set_reaches(ResolvedStep& resolved, const std::vector<std::string>& from) {
    const Step& step = resolved.step;
    const Calibration& calibration = *step.calibration;
    const std::vector<double> usual = calibration.usual();
    const auto reads = [&](const std::string& name) {
      const size_t input = calibration.input_called(name);
      return ReadAttribute{name, calibration.inputs[input].unit, calibration.choices(input, usual)};
    };
    for (size_t n = 1; n < from.size(); ++n) resolved.others.push_back(reads(from[n]));
    if (!step.input) {
      const ReadAttribute first = reads(from.front());
      resolved.unit = first.unit;
      resolved.reach = first.reach;
      return;
    }
    resolved.unit = calibration.unit;
    resolved.reach = calibration.whole_reach(*step.input);
    if (!resolved.others.empty()) resolved.place_in_reach = calibration.property + "_place_in_reach";
  }

  bool complete_inks(ResolvedStep& resolved) {
    const Calibration& calibration = *resolved.step.calibration;
    for (const calibration::Input& input : calibration.inputs)
      resolved.materials.push_back(*material_among(loaded_->design.materials, input.materials));
    resolved.materials.push_back(*material_among(loaded_->design.materials, calibration.rest));
    if (!calibration.inks->clear.empty())
      resolved.materials.push_back(*material_among(loaded_->design.materials, calibration.inks->clear));
    return load_inks(resolved, NodeMaker(loaded_->design, where_, diagnostics_, &loader_), diagnostics_);
  }

  // Returns false, and adds an error, if the design gives an attribute in another unit.
  bool has_unit(const ResolvedStep& resolved) {
    std::vector<ReadAttribute> all{{resolved.attribute, resolved.unit, resolved.reach}};
    all.insert(all.end(), resolved.others.begin(), resolved.others.end());
    return std::ranges::all_of(all, [&](const ReadAttribute& one) { return has_unit(one, resolved); });
  }

  bool has_unit(const ReadAttribute& read, const ResolvedStep& resolved) {
    const std::vector<design::AttributeDeclaration> declared = declared_attributes(loaded_->design);
    const auto found = std::ranges::find(declared, read.attribute, &design::AttributeDeclaration::name);
    if (found == declared.end() || found->unit.empty()) return true;
    if (read.unit.empty() || read.unit == found->unit) return true;
    diagnostics_.error(Code::parameters, where_,
                       "the attribute \"" + read.attribute + "\" has the unit " + found->unit + ", and " +
                           resolved.step.names() + " has " + read.unit,
                       "convert its values, and give it that unit");
    return false;
  }

  LoadedPtr loaded_;
  const Needs& needs_;
  Diagnostics& diagnostics_;
  SourceRange where_;
  sources::SourceCache cache_;
  DesignSources loader_{cache_};
  std::vector<CalibrationPtr> usable_;
  std::vector<std::string> given_, unusable_;
  std::vector<ResolvedStep> steps_;
  std::vector<Rival> rivals_;
  std::vector<voxel::ValueStep> rounded_;
};

}  // namespace

std::optional<std::vector<CalibrationPtr>> load_calibrations(const CalibrationNames& names, Diagnostics& diagnostics) {
  const size_t errors = diagnostics.error_count();
  std::vector<CalibrationPtr> loaded;
  for (const std::string& name : names.chosen.empty() ? names.listed : names.chosen) {
    const CalibrationPtr calibration = find_calibration(name, diagnostics);
    if (calibration &&
        std::ranges::none_of(loaded, [&](const auto& other) { return other->name == calibration->name; }))
      loaded.push_back(calibration);
  }
  return diagnostics.error_count() == errors ? std::optional(std::move(loaded)) : std::nullopt;
}

Data describe_calibration(const Calibration& calibration) {
  return DataMembers{{"calibration", calibration.name},
                     {"title", calibration.title},
                     {"citation", calibration.citation},
                     {"illustrative", calibration.is_illustrative}};
}

Data describe(const ResolvedStep& resolved) {
  const Step& step = resolved.step;
  const Calibration& calibration = *step.calibration;
  DataMembers members{{"from", text_data(step.from())},         {"to", Data(step.to())},
                      {"calibration", Data(calibration.name)},  {"title", Data(calibration.title)},
                      {"citation", Data(calibration.citation)}, {"illustrative", Data(calibration.is_illustrative)}};
  if (step.beside) members.emplace_back("beside", describe_calibration(*step.beside));
  if (calibration.inks)
    members.emplace_back("inks", describe(*calibration.inks));
  else
    members.emplace_back("reach", Data(DataList{resolved.reach.lo, resolved.reach.hi}));
  if (resolved.rounds_to) members.emplace_back("rounded_to", Data(*resolved.rounds_to));
  std::vector<std::string> materials = resolved.materials;
  std::erase(materials, "");
  if (!materials.empty()) members.emplace_back("materials", text_data(materials));
  return Data(std::move(members));
}

Data describe(const voxel::ValueStep& rounded) {
  return DataMembers{{"to", Data(rounded.of)}, {"rounded_to", Data(rounded.size)}};
}

std::optional<std::string> material_among(const design::MaterialTable& table, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const design::Material* material = table.find(name)) return material->name;
  return std::nullopt;
}

bool names_materials(const design::Design& design) {
  Question question(design);
  const design::Composition composition = question.composition();
  return composition.fractions.size() != 1 || composition.fractions.front().first != design.materials.first().id;
}

std::vector<std::string> given_quantities(const design::Design& design) {
  std::vector<std::string> given;
  for (const design::AttributeDeclaration& declared : declared_attributes(design))
    if (declared.type == design::ValueType::number || is_colour(declared)) given.push_back(declared.name);
  if (names_materials(design)) given.emplace_back(calibration::fractions);
  return given;
}

std::optional<Resolution> resolve(const LoadedPtr& loaded, const std::vector<CalibrationPtr>& calibrations,
                                  const Needs& needs, Diagnostics& diagnostics) {
  return Resolver(loaded, calibrations, needs, diagnostics).run();
}

}  // namespace ombre::compile
