#include "load/ink_step.h"

#include <algorithm>
#include <filesystem>

#include "base/text/text.h"
#include "design/attributes.h"
#include "formats/containers/file.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

using calibration::Calibration;
using calibration::CalibrationPtr;
using calibration::InkUse;
using design::NodePtr;

std::string_view intent_of(const InkUse& inks) { return ink::intent_names()[static_cast<size_t>(inks.intent)]; }

bool has_alpha(const ResolvedStep& step) { return step.attribute == calibration::colour_with_alpha; }

// The names of red, green, blue and, where there is one, alpha.
std::vector<std::string> numbers_of(const ResolvedStep& step) {
  const std::string& name = step.attribute;
  if (has_alpha(step)) return {name + ".r", name + ".g", name + ".b", name + ".a"};
  return {name + ".x", name + ".y", name + ".z"};
}

Data text_list(const std::vector<std::string>& texts, size_t count) {
  DataList list;
  for (size_t n = 0; n < count; ++n) list.emplace_back(texts[n]);
  return Data(std::move(list));
}

}  // namespace

bool is_colour(const design::AttributeDeclaration& declared) {
  if (declared.name == calibration::colour_property) return declared.type == design::ValueType::vector;
  return declared.name == calibration::colour_with_alpha && declared.type == design::ValueType::colour;
}

CalibrationPtr for_colours_of(const design::Design& design, const CalibrationPtr& calibration) {
  if (!calibration->inks) return calibration;
  auto own = std::make_shared<Calibration>(*calibration);
  for (const design::AttributeDeclaration& declared : declared_attributes(design))
    if (is_colour(declared) && declared.name == calibration::colour_with_alpha) own->property = declared.name;
  return own;
}

ink::Profile profile_of(const InkUse& inks) {
  return {inks.profile, std::make_shared<const std::string>(formats::read_file(inks.profile))};
}

bool load_inks(ResolvedStep& step, const NodeMaker& maker, Diagnostics& diagnostics) {
  const Calibration& calibration = *step.step.calibration;
  const InkUse& inks = *calibration.inks;
  design::InkRequest request{{std::filesystem::absolute(inks.profile).string(), {}}};
  request.intent = ink::intent_names()[static_cast<size_t>(inks.intent)].c_str();
  request.black_point = inks.black_point;
  const design::Reader reader = maker.reader("ink_mixture");
  step.inks = reader.loader->source(request, reader);
  if (!step.inks) return false;
  if (step.inks->inks != calibration.inputs.size()) {
    diagnostics.error(Code::parameters, calibration.where,
                      calibration.name + " names " + std::to_string(calibration.inputs.size()) +
                          " channels, and its profile has " + std::to_string(step.inks->inks) + " (" +
                          step.inks->space + ")",
                      "name a material for each ink of the profile, in its order");
    return false;
  }
  if (has_alpha(step) && inks.clear.empty())
    diagnostics.note(calibration.where, "the alpha of color_rgba is not used, since " + calibration.name +
                                            " names no material as \"clear\"");
  return true;
}

NodePtr with_inks(const NodePtr& solid, const ResolvedStep& step, const NodeMaker& maker) {
  const InkUse& inks = *step.step.calibration->inks;
  const size_t opaque = step.inks->inks + 1;
  DataList colour;
  std::vector<Data> numbers;
  for (const std::string& name : numbers_of(step))
    numbers.push_back(NodeMaker::formula_data(maker.attribute_of(solid, name)));
  colour.assign(numbers.begin(), numbers.begin() + 3);
  const NodePtr mixture =
      maker.make("ink_mixture", {{"colour", Data(std::move(colour))},
                                 {"profile", Data(std::filesystem::absolute(inks.profile).string())},
                                 {"materials", text_list(step.materials, opaque)},
                                 {"intent", Data(std::string(intent_of(inks)))},
                                 {"black_point", Data(inks.black_point)}});
  if (!mixture) return nullptr;
  DataList materials{NodeMaker::node_data(mixture)}, fractions;
  if (has_alpha(step) && !inks.clear.empty()) {
    const expr::Expression zero = expr::Expression::constant(0), one = expr::Expression::constant(1);
    const expr::Expression alpha = expr::Expression::call(
        "max", {zero, expr::Expression::call("min", {one, maker.attribute_of(solid, numbers_of(step)[3])})});
    materials.emplace_back(step.materials.back());
    fractions.push_back(NodeMaker::formula_data(alpha));
    fractions.push_back(NodeMaker::formula_data(expr::Expression::binary(expr::Binary::subtract, one, alpha)));
  }
  return maker.make("material", {{"materials", Data(std::move(materials))}, {"fractions", Data(std::move(fractions))}},
                    {solid});
}

Data describe(const InkUse& inks) {
  return DataMembers{{"profile", Data(std::filesystem::path(inks.profile).filename().string())},
                     {"intent", Data(std::string(intent_of(inks)))},
                     {"black_point", Data(inks.black_point)},
                     {"channels", text_list(inks.channels, inks.channels.size())}};
}

}  // namespace ombre::compile
