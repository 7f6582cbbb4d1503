#include "calibration/chains.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/text/text.h"

namespace ombre::calibration {
namespace {

std::string quantity(const Input& input) { return input.is_fraction() ? std::string(fractions) : input.attribute; }

constexpr size_t most_chains = 8;

// Returns the ways in which a calibration can be used. An input is found if all others have usual values, or are
// attributes, which a design or other steps may give.
std::vector<Step> uses_of(const CalibrationPtr& calibration) {
  if (calibration->inks) return {{calibration, 0}};  // all inks together
  std::vector<Step> uses{{calibration, std::nullopt}};
  for (size_t n = 0; n < calibration->inputs.size(); ++n) {
    bool is_possible = calibration->is_invertible(n);
    for (size_t other = 0; other < calibration->inputs.size(); ++other)
      is_possible =
          is_possible && (other == n || calibration->inputs[other].usual || !calibration->inputs[other].is_fraction());
    if (is_possible) uses.push_back({calibration, n});
  }
  return uses;
}

void keep_some(std::vector<Chain>& chains) {
  if (chains.size() > most_chains) chains.resize(most_chains);
}

// Quantities by the number of steps that lead to them, with all steps that do so first.
class Search {
 public:
  Search(const std::vector<CalibrationPtr>& calibrations, const std::vector<std::string>& given)
      : known_(given.begin(), given.end()) {
    for (const CalibrationPtr& calibration : calibrations)
      for (Step& use : uses_of(calibration)) uses_.push_back(std::move(use));
    while (take_all()) {
    }
  }

  bool knows(const std::string& quantity) const { return known_.contains(quantity); }

  // Returns the shortest chains to a known quantity.
  std::vector<Chain> chains(const std::string& quantity) const {
    const auto found = steps_.find(quantity);
    if (found == steps_.end()) return {{}};  // it is given
    std::vector<Chain> all;
    for (const Step& step : found->second) {
      std::vector<Chain> before{{}};
      for (const std::string& from : step.from()) before = joined(before, chains(from));
      for (Chain& chain : before) {
        chain.push_back(step);
        all.push_back(std::move(chain));
      }
    }
    keep_some(all);
    return all;
  }

  // Returns the quantities from which a single step would lead to this one.
  std::vector<std::string> sources_of(const std::string& quantity) const {
    std::vector<std::string> sources;
    for (const Step& use : uses_)
      if (use.to() == quantity) sources.push_back(join(use.from(), " and ") + " (" + use.calibration->name + ')');
    return sources;
  }

  // Returns the quantities to which steps lead.
  std::vector<std::string> reached() const {
    std::vector<std::string> names;
    for (const auto& [name, steps] : steps_) names.push_back(name);
    return names;
  }

 private:
  // Takes all steps from what is known. Returns false if nothing new is known then.
  bool take_all() {
    std::map<std::string, std::vector<Step>> found;
    for (const Step& use : uses_) {
      const std::vector<std::string> from = use.from();
      const bool is_possible = std::ranges::all_of(from, [&](const auto& name) { return knows(name); });
      if (is_possible && !from.empty() && !knows(use.to())) found[use.to()].push_back(use);
    }
    for (auto& [name, steps] : found) {
      known_.insert(name);
      steps_.emplace(name, std::move(steps));
    }
    return !found.empty();
  }

  static std::vector<Chain> joined(const std::vector<Chain>& firsts, const std::vector<Chain>& seconds) {
    std::vector<Chain> all;
    for (const Chain& first : firsts)
      for (const Chain& second : seconds) {
        Chain both = first;
        for (const Step& step : second)
          if (std::ranges::none_of(both, [&](const Step& other) { return other.to() == step.to(); }))
            both.push_back(step);
        all.push_back(std::move(both));
      }
    keep_some(all);
    return all;
  }

  std::vector<Step> uses_;
  std::set<std::string> known_;
  std::map<std::string, std::vector<Step>> steps_;
};

}  // namespace

std::vector<std::string> Step::from() const {
  if (beside) return {calibration->property, beside->property};
  std::vector<std::string> names;
  if (input) names.push_back(calibration->property);
  for (size_t n = 0; n < calibration->inputs.size() && !calibration->inks; ++n) {
    const std::string name = quantity(calibration->inputs[n]);
    if (n == input || calibration->inputs[n].usual) continue;
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string Step::to() const { return input ? quantity(calibration->inputs[*input]) : calibration->property; }

std::vector<CalibrationPtr> Step::calibrations() const {
  return beside ? std::vector{calibration, beside} : std::vector{calibration};
}

std::string Step::names() const { return beside ? calibration->name + " and " + beside->name : calibration->name; }

std::string Step::text() const { return join(from(), " and ") + " to " + to() + " by " + names(); }

std::string chain_text(const Chain& chain) {
  std::vector<std::string> texts;
  for (const Step& step : chain) texts.push_back(step.text());
  return join(texts, ", then ");
}

std::vector<std::string> begins_with(const Chain& chain) {
  std::vector<std::string> first;
  std::set<std::string> made;
  for (const Step& step : chain) {
    for (const std::string& from : step.from())
      if (!made.contains(from) && std::ranges::find(first, from) == first.end()) first.push_back(from);
    made.insert(step.to());
  }
  return first;
}

std::variant<std::vector<Chain>, ChainProblem> find_chains(const std::vector<CalibrationPtr>& calibrations,
                                                           const std::vector<std::string>& given,
                                                           const std::string& wanted) {
  const Search search(calibrations, given);
  const std::string has = given.empty() ? "the design gives no attribute" : "the design gives " + join(given, ", ");
  if (!search.knows(wanted)) {
    const std::vector<std::string> sources = search.sources_of(wanted), reached = search.reached();
    std::string hint =
        sources.empty() ? "no calibration that is chosen gives " + wanted : "it could give " + join(sources, ", or ");
    if (!reached.empty())
      hint += "; calibrations lead to " + join(reached, ", ") + ", for machines whose profile names it in \"needs\"";
    return ChainProblem{has + ", and no calibration leads from there to " + wanted, std::move(hint)};
  }
  return search.chains(wanted);
}

std::string several_text(const std::vector<Chain>& chains, const std::string& wanted) {
  return "two chains of calibrations lead to " + wanted + ": " + chain_text(chains[0]) + "; and " +
         chain_text(chains[1]);
}

}  // namespace ombre::calibration
