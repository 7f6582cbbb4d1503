// Compositions given by formulas.
#include <map>

#include "design/spec.h"
#include "nodes/common/child_distance.h"

namespace ombre::nodes {
namespace {

using namespace design;

bool same_length(const Reader& reader, size_t functions, size_t materials, std::string_view noun) {
  if (functions == materials) return true;
  return reader.refuse(std::string(reader.node) + " has " + std::to_string(functions) + " " + std::string(noun) +
                           " for " + std::to_string(materials) + " materials",
                       "give one for each");
}

// Turns raw values into fractions, one for each material. Where the values are unusable, the input's own composition is
// used and a check is set.
struct Mixture {
  std::vector<Composition> parts;  // each a single material or a mixture
  std::vector<Field> raw;
  bool threshold = false;

  // `message` returns the text of the check.
  template <class Message>
  Composition over(const Inputs& in, const Point& p, Demand demand, const Message& message) const {
    const Field zero = p.constant(0);
    std::vector<Field> values, finite, nonzero;
    for (const Field v : raw) {
      values.push_back(threshold ? v : max(v, 0.0));
      finite.push_back(is_finite(v));
      nonzero.push_back(truth(values.back()));
    }
    const Field usable =
        logical_and(program::fold(finite, program::logical_and), program::fold(nonzero, program::logical_or));
    std::map<MaterialId, std::vector<Field>> terms;
    const std::vector<Field> shares = threshold ? winners(values) : normalised(values);
    std::map<uint32_t, std::vector<Field>> flags;
    for (size_t i = 0; i < shares.size(); ++i) {
      for (const auto& [id, fraction] : parts[i].fractions) terms[id].push_back(shares[i] * fraction);
      for (const auto& [number, flag] : parts[i].checks)
        flags[number].push_back(logical_and(usable, logical_and(truth(shares[i]), flag)));
    }

    const bool is_usable = p.builder().constant_value(usable) == 1.0;
    const Composition own = is_usable ? Composition() : in.composition(0, p, demand);
    for (const auto& [id, fraction] : own.fractions) terms.try_emplace(id);
    Composition result = fractions(terms, own, usable, zero);
    if (!is_usable) {
      const Field bad = logical_not(usable);
      for (const auto& [number, flag] : own.checks) flags[number].push_back(logical_and(bad, flag));
      const auto [number, flag] = in.check(bad, message());
      flags[number].push_back(flag);
    }
    for (auto& [number, list] : flags)
      result.checks.emplace_back(number, program::fold(std::move(list), program::logical_or));
    return result;
  }

 private:
  static Composition fractions(const std::map<MaterialId, std::vector<Field>>& terms, const Composition& own,
                               Field usable, Field zero) {
    Composition result;
    for (const auto& [id, list] : terms) {
      const Field share = list.empty() ? zero : program::sum(list);
      Field otherwise = zero;
      for (const auto& [own_id, fraction] : own.fractions)
        if (own_id == id) otherwise = fraction;
      result.fractions.emplace_back(id, own.fractions.empty() ? share : select(usable, share, otherwise));
    }
    return result;
  }

  static std::vector<Field> normalised(const std::vector<Field>& values) {
    const Field total = program::sum(values);
    std::vector<Field> shares;
    for (const Field v : values) shares.push_back(share(v, total));
    return shares;
  }

  // Returns 1 for the greatest value, the first one in a tie, and 0 for the others.
  static std::vector<Field> winners(const std::vector<Field>& values) {
    const Field best = program::fold(values, static_cast<Field (*)(Field, Field)>(program::max));
    std::vector<Field> shares;
    Field taken = best.builder->constant(0);
    for (const Field v : values) {
      const Field is_best = less_equal(best, v);
      shares.push_back(logical_and(is_best, logical_not(taken)));
      taken = logical_or(taken, is_best);
    }
    return shares;
  }
};

Mixture mixture(const Inputs& in, const Point& p, std::span<const Number> functions,
                std::span<const MaterialName> materials) {
  Mixture result;
  const expr::Variables variables = child_variables(in, p);
  for (const Number& function : functions) result.raw.push_back(function.at(p, variables));
  for (const MaterialName& name : materials) result.parts.push_back(in.composition_of(name, p));
  return result;
}

std::string list_text(std::span<const Number> functions) {
  std::string text;
  for (const Number& f : functions)
    text += (text.empty() ? "\"" : ", \"") +
            (f.constant() ? expr::Expression::constant(*f.constant()).text() : f.expression()->text()) + "\"";
  return text;
}

struct FGrade {
  SharedList<Number> functions;
  SharedList<MaterialName> materials;
  Choice mode = "prob";

  static Spec<FGrade> spec() {
    return {"fgrade",
            "Sets the composition of its child by formulas, one for each material.",
            {{"functions", &FGrade::functions,
              "Expressions; d is the signed distance of the child, t the position along its struts",
              required(over_child())},
             {"materials", &FGrade::materials, "A material or mixture for each expression", required(mixable())},
             {"mode", &FGrade::mode,
              "prob: the values are shares of a mixture; thresh: the material with the greatest value is used alone",
              one_of({"prob", "thresh"})}},
            one_solid,
            "fgrade([\"0.5 + x/20\", \"0.5 - x/20\"], [\"red\", \"blue\"], \"prob\") { cube(10); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) const {
    if (!same_length(reader, functions.size(), materials.size(), "functions")) return false;
    if (functions.empty()) return reader.refuse("fgrade needs at least one function and its material");
    return check_child_variables(reader, *inputs[0], functions);
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    Mixture result = mixture(in, p, functions, materials);
    result.threshold = mode == "thresh";
    return result.over(in, p, demand, [&] {
      return "the fractions of fgrade are all zero or not finite (" + list_text(functions) +
             "), the child keeps its own materials there";
    });
  }
};

struct Material {
  SharedList<MaterialName> materials;
  SharedList<Number> fractions;

  static Spec<Material> spec() {
    return {"material",
            "Sets the composition of its child: one material, or a mixture.",
            {{"materials", &Material::materials, "One or more materials or mixtures", required(mixable())},
             {"fractions", &Material::fractions, "A share for each material, as numbers or fields; none: equal shares",
              over_child()}},
            one_solid,
            "material([\"red\", \"clear\"], [0.3, 0.7]) { sphere(5); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (fractions.empty()) fractions = SharedList(std::vector<Number>(materials.size(), Number(1)));
    if (!same_length(reader, fractions.size(), materials.size(), "fractions")) return false;
    double total = 0;
    for (const Number& fraction : fractions) {
      total += fraction.constant() ? *fraction.constant() : 1;
      if (!fraction.constant() || *fraction.constant() >= 0) continue;
      return reader.refuse("a fraction of a material is negative");
    }
    if (total <= 0) return reader.refuse("the fractions of the materials are all zero");
    return check_child_variables(reader, *inputs[0], fractions);
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return mixture(in, p, fractions, materials).over(in, p, demand, [&] {
      return "the fractions of material are all zero or not finite (" + list_text(fractions) +
             "), the child keeps its own materials there";
    });
  }
};

}  // namespace

void add_material_gradients(Registry& registry) { registry.add<FGrade, Material>("material gradients"); }

}  // namespace ombre::nodes
