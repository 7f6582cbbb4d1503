#include "load/resolved.h"

#include <algorithm>
#include <set>

#include "base/text/text.h"
#include "calibration/piecewise.h"
#include "design/attributes.h"
#include "load/design_sources.h"
#include "load/find_calibration.h"
#include "load/ink_step.h"
#include "load/node_maker.h"
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

// Returns the solid with what the step gives.
NodePtr with_step(const NodePtr& solid, const ResolvedStep& resolved, const NodeMaker& maker) {
  const Step& step = resolved.step;
  if (step.calibration->inks) return with_inks(solid, resolved, maker);
  const Calibration& calibration = *step.calibration;
  const std::vector<double> usual = calibration.usual();
  const size_t varied = step.input ? *step.input : calibration.input_called(resolved.attribute);
  const auto curve = step.input ? calibration::inverse_curve(calibration, varied, usual)
                                : calibration::forward_curve(calibration, varied, usual);
  const expr::Expression result = maker.curve_of(solid, resolved.attribute, curve);
  if (step.to() != calibration::fractions)
    return maker.make("attribute", {{"name", Data(step.to())}, {"value", NodeMaker::formula_data(result)}}, {solid});
  DataList functions, materials;
  double others = 0;  // fractions that are as usual
  for (size_t n = 0; n < calibration.inputs.size(); ++n) {
    if (!calibration.inputs[n].is_fraction()) continue;
    if (n != varied) others += usual[n];
    functions.push_back(n == varied ? NodeMaker::formula_data(result) : Data(usual[n]));
    materials.emplace_back(resolved.materials[n]);
  }
  functions.push_back(NodeMaker::formula_data(
      expr::Expression::binary(expr::Binary::subtract, expr::Expression::constant(1 - others), result)));
  materials.emplace_back(resolved.materials.back());
  return maker.make("fgrade", {{"functions", Data(std::move(functions))}, {"materials", Data(std::move(materials))}},
                    {solid});
}

class Resolver {
 public:
  Resolver(const LoadedPtr& loaded, const std::vector<CalibrationPtr>& calibrations, Diagnostics& diagnostics)
      : loaded_(loaded), diagnostics_(diagnostics), where_{loaded->source, 0, 0} {
    for (const CalibrationPtr& calibration : calibrations)
      if (has_materials(*calibration)) usable_.push_back(for_colours_of(loaded->design, calibration));
    given_ = given_quantities(loaded->design);
  }

  std::optional<Resolution> run(const std::vector<std::string>& needs, Unresolved unresolved) {
    for (const std::string& need : needs)
      if (!add_chain(need, unresolved)) return std::nullopt;
    for (ResolvedStep& step : steps_)
      if (!complete(step)) return std::nullopt;
    auto made = std::make_shared<Loaded>(*loaded_);
    for (design::Part& part : made->design.parts) {
      const NodeMaker maker(loaded_->design, part.solid->where(), diagnostics_, &loader_);
      for (const ResolvedStep& step : steps_) {
        part.solid = with_step(part.solid, step, maker);
        if (!part.solid) return std::nullopt;
      }
    }
    if (!steps_.empty() && !design::check_design(made->design, diagnostics_)) return std::nullopt;
    return Resolution{steps_.empty() ? loaded_ : made, std::move(steps_), std::move(unusable_)};
  }

 private:
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

  bool add_chain(const std::string& need, Unresolved unresolved) {
    const auto found = calibration::find_chain(usable_, given_, need);
    if (const auto* chain = std::get_if<Chain>(&found)) {
      for (const Step& step : *chain)
        if (std::ranges::none_of(steps_, [&](const auto& other) { return other.step.to() == step.to(); }))
          steps_.push_back({step, "", "", {}, {}, nullptr});
      return true;
    }
    const auto& problem = std::get<ChainProblem>(found);
    if (problem.kind == ChainProblem::Kind::none && unresolved == Unresolved::is_left) return true;
    Phrase hint = problem.hint;
    if (problem.kind == ChainProblem::Kind::several)
      hint = "choose one with " + spelled::option("--calibration", "NAME");
    else if (!unusable_.empty())
      hint = hint + "; " + join(unusable_, "; ");
    diagnostics_.error(Code::parameters, where_, problem.message, hint);
    return false;
  }

  // Fills in what the step reads, and its materials.
  bool complete(ResolvedStep& resolved) {
    const Step& step = resolved.step;
    const Calibration& calibration = *step.calibration;
    const std::vector<std::string> from = step.from();
    if (from.size() != 1 || from.front() == calibration::fractions) {
      diagnostics_.error(Code::parameters, where_,
                         calibration.name + " gives " + step.to() + " from " + join(from, " and ") +
                             ", and jobs follow one attribute at a time",
                         "give " + step.to() + " in the design");
      return false;
    }
    resolved.attribute = from.front();
    if (calibration.inks) return complete_inks(resolved);
    const std::vector<double> usual = calibration.usual();
    const size_t read = calibration.input_called(resolved.attribute);
    resolved.unit = step.input ? calibration.unit : calibration.inputs[read].unit;
    resolved.reach = step.input ? calibration.reach(*step.input, usual) : calibration.choices(read, usual);
    for (const calibration::Input& input : calibration.inputs)
      resolved.materials.push_back(input.is_fraction() ? *material_among(loaded_->design.materials, input.materials)
                                                       : "");
    if (calibration.has_fractions())
      resolved.materials.push_back(*material_among(loaded_->design.materials, calibration.rest));
    return has_unit(resolved);
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

  // Returns false, and adds an error, if the design gives the attribute in another unit.
  bool has_unit(const ResolvedStep& resolved) {
    const std::vector<design::AttributeDeclaration> declared = declared_attributes(loaded_->design);
    const auto found = std::ranges::find(declared, resolved.attribute, &design::AttributeDeclaration::name);
    if (found == declared.end() || found->unit.empty()) return true;
    if (resolved.unit.empty() || resolved.unit == found->unit) return true;
    diagnostics_.error(Code::parameters, where_,
                       "the attribute \"" + resolved.attribute + "\" has the unit " + found->unit + ", and " +
                           resolved.step.calibration->name + " has " + resolved.unit,
                       "convert its values, and give it that unit");
    return false;
  }

  LoadedPtr loaded_;
  Diagnostics& diagnostics_;
  SourceRange where_;
  sources::SourceCache cache_;
  DesignSources loader_{cache_};
  std::vector<CalibrationPtr> usable_;
  std::vector<std::string> given_, unusable_;
  std::vector<ResolvedStep> steps_;
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

Data describe(const ResolvedStep& resolved) {
  const Step& step = resolved.step;
  const Calibration& calibration = *step.calibration;
  DataMembers members{{"from", text_data(step.from())},         {"to", Data(step.to())},
                      {"calibration", Data(calibration.name)},  {"title", Data(calibration.title)},
                      {"citation", Data(calibration.citation)}, {"illustrative", Data(calibration.is_illustrative)}};
  if (calibration.inks)
    members.emplace_back("inks", describe(*calibration.inks));
  else
    members.emplace_back("reach", Data(DataList{resolved.reach.lo, resolved.reach.hi}));
  std::vector<std::string> materials = resolved.materials;
  std::erase(materials, "");
  if (!materials.empty()) members.emplace_back("materials", text_data(materials));
  return Data(std::move(members));
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
                                  const std::vector<std::string>& needs, Unresolved unresolved,
                                  Diagnostics& diagnostics) {
  return Resolver(loaded, calibrations, diagnostics).run(needs, unresolved);
}

}  // namespace ombre::compile
