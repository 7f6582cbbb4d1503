#include "jobs/fea/section_options.h"

namespace ombre::compile {
namespace {

std::optional<std::string> if_named(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional(name);
}

}  // namespace

const options::Spec<SectionOptions>& SectionOptions::options() {
  using namespace options;
  using S = SectionOptions;
  static const Spec<S> spec{
      choice(
          "--fill", &S::fill, {"exact", "centre"},
          "exact (default): the part of a brick inside is stiff and heavy; centre: a brick is whole if its centre is "
          "inside",
          "RULE"),
      choice("--assign", &S::assign, {"draw", "mix"},
             "Material of an element of a mixture: draw (one material, by the odds of its fractions) or mix (mean\n"
             "properties)",
             "RULE"),
      option("--modulus", &S::modulus, kind::text, "An attribute of the design that is Young's modulus in MPa", "NAME"),
      option("--conductivity", &S::conductivity, kind::text,
             "An attribute of the design that is the conductivity in W/(m K) or S/m; in conduction", "NAME"),
      option("--sections", &S::sections, kind::whole,
             "Number of sections of elements with mix, --modulus or --conductivity", "N")
          .between(1, 60000)};
  return spec;
}

FeaRequest SectionOptions::request(int threads) const {
  return {assign, fill, if_named(modulus), if_named(conductivity), static_cast<size_t>(sections), threads};
}

}  // namespace ombre::compile
