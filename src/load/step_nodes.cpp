#include "load/step_nodes.h"

#include <algorithm>
#include <limits>

#include "base/math/math.h"
#include "load/ink_step.h"

namespace ombre::compile {
namespace {

using calibration::Calibration;
using calibration::Interpolant;
using design::NodePtr;
using expr::Binary;
using expr::Expression;

Expression constant(double value) { return Expression::constant(value); }
Expression difference_of(const Expression& a, const Expression& b) {
  return Expression::binary(Binary::subtract, a, b);
}
Expression sum_of(const Expression& a, const Expression& b) { return Expression::binary(Binary::add, a, b); }
Expression product_of(const Expression& a, const Expression& b) { return Expression::binary(Binary::multiply, a, b); }
Expression quotient_of(const Expression& a, const Expression& b) { return Expression::binary(Binary::divide, a, b); }

Expression rounded_to_step(const Expression& value, double step) {
  return product_of(Expression::call("round", {quotient_of(value, constant(step))}), constant(step));
}

// Writes the result of a step as a formula of the attributes of a solid.
class StepFormula {
 public:
  StepFormula(const NodePtr& solid, const ResolvedStep& step, const NodeMaker& maker)
      : solid_(solid), step_(step), calibration_(*step.step.calibration), maker_(maker), usual_(calibration_.usual()) {
    for (size_t n = 0; n < calibration_.inputs.size(); ++n)
      if (n != step.step.input && reads(calibration_.inputs[n].attribute)) free_.push_back(n);
  }

  Expression result() const {
    Expression value = step_.others.empty() ? curve() : step_.step.input ? inverse() : forward();
    return step_.rounds_to ? rounded_to_step(value, *step_.rounds_to) : value;
  }

  // Returns 1 where the property has the value of the varied input's first choice, and 2 for that of its last.
  Expression place_in_reach() const {
    const std::vector<double> choices = corners();
    return sum_of(constant(1), share_between(choices.front(), choices.back()));
  }

 private:
  bool reads(const std::string& attribute) const {
    if (attribute.empty()) return false;
    return attribute == step_.attribute ||
           std::ranges::find(step_.others, attribute, &ReadAttribute::attribute) != step_.others.end();
  }
  bool is_of_logarithm() const { return calibration_.interpolant == Interpolant::log_linear; }
  Expression attribute(const std::string& name) const { return maker_.attribute_of(solid_, name); }

  // Returns the curve of the calibration, for a step from a single attribute.
  Expression curve() const {
    const size_t varied = step_.step.input ? *step_.step.input : calibration_.input_called(step_.attribute);
    return maker_.curve_of(solid_, step_.attribute,
                           step_.step.input ? calibration::inverse_curve(calibration_, varied, usual_)
                                            : calibration::forward_curve(calibration_, varied, usual_));
  }

  Expression forward() const {
    const Expression value = value_over(usual_);
    return is_of_logarithm() ? Expression::call("exp", {value}) : value;
  }

  // Between two neighbouring corners of the varied input the value is linear in it, whatever the others are. So the
  // input is the sum of the shares of all such pieces that lie below the value.
  Expression inverse() const {
    const std::vector<double> choices = corners();
    Expression sum = constant(choices.front());
    for (size_t n = 0; n + 1 < choices.size(); ++n) {
      const Expression share = Expression::call(
          "max", {constant(0), Expression::call("min", {constant(1), share_between(choices[n], choices[n + 1])})});
      sum = sum_of(sum, product_of(constant(choices[n + 1] - choices[n]), share));
    }
    return sum;
  }

  std::vector<double> corners() const {
    const size_t varied = *step_.step.input;
    return calibration::corners_of(calibration_, varied, calibration_.choices(varied, usual_));
  }

  // Returns where the property lies between its values at two choices of the varied input: 0 to 1.
  Expression share_between(double first, double second) const {
    std::vector<double> at = usual_;
    at[*step_.step.input] = first;
    const Expression low = value_over(at);
    at[*step_.step.input] = second;
    return quotient_of(difference_of(property(), low), difference_of(value_over(at), low));
  }

  Expression property() const {
    const Expression value = attribute(calibration_.property);
    if (!is_of_logarithm()) return value;
    // Values that are not positive have no logarithm, and get that of the least value.
    const auto& logarithms = calibration_.grid.values();
    const double least = math::exp(*std::ranges::min_element(logarithms));
    return Expression::call("log", {Expression::call("max", {value, constant(least)})});
  }

  // Returns the calibration's value, or its logarithm, as a function of the attributes among its inputs; the other
  // inputs have their numbers in `at`. The calibration is linear between the rows of the table.
  Expression value_over(std::vector<double> at) const {
    DataList rows, row, more;
    add_rows(0, at, row, rows);
    for (size_t n = 1; n < free_.size(); ++n)
      more.push_back(NodeMaker::formula_data(attribute(calibration_.inputs[free_[n]].attribute)));
    return NodeMaker::first_output(
        maker_.make("table", {{"rows", Data(std::move(rows))},
                              {"a", NodeMaker::formula_data(attribute(calibration_.inputs[free_[0]].attribute))},
                              {"more", Data(std::move(more))}}));
  }

  void add_rows(size_t n, std::vector<double>& at, DataList& row, DataList& rows) const {
    if (n == free_.size()) {
      const double value = calibration_.value(at);
      rows.emplace_back(row);
      std::get<DataList>(rows.back().value).emplace_back(is_of_logarithm() ? math::log(value) : value);
      return;
    }
    for (const double key : calibration::corners_of(calibration_, free_[n], *calibration_.inputs[free_[n]].valid)) {
      at[free_[n]] = key;
      row.emplace_back(key);
      add_rows(n + 1, at, row, rows);
      row.pop_back();
    }
  }

  const NodePtr& solid_;
  const ResolvedStep& step_;
  const Calibration& calibration_;
  const NodeMaker& maker_;
  std::vector<double> usual_;
  std::vector<size_t> free_;  // inputs that attributes give
};

NodePtr with_attribute(const NodePtr& solid, const std::string& name, const Expression& value, const NodeMaker& maker) {
  return maker.make("attribute", {{"name", Data(name)}, {"value", NodeMaker::formula_data(value)}}, {solid});
}

// Returns the shares of three materials that have both properties. Where no mixture has them, shares below 0 become 0,
// and the others keep their ratio. The place in reach is 1 plus the least share.
struct JointShares {
  std::vector<Expression> shares;  // of the inputs of the step's calibration
  Expression place_in_reach;
};

JointShares shares_of(const NodePtr& solid, const ResolvedStep& step, const NodeMaker& maker) {
  const auto property = [&](const std::string& name, const calibration::MixtureLaw& law) {
    const Expression value = maker.attribute_of(solid, name);
    if (!law.of_logarithms) return value;
    // Values that are not positive have no logarithm, and get one far below that of each material.
    return Expression::call("log", {Expression::call("max", {value, constant(std::numeric_limits<double>::min())})});
  };
  const Expression u = property(step.attribute, step.joint->first);
  const Expression v = property(step.others[0].attribute, step.joint->second);
  std::vector<Expression> exact, positive;
  for (const auto& [at_zero, of_u, of_v] :
       calibration::fractions_of_properties(step.joint->first, step.joint->second)) {
    exact.push_back(sum_of(constant(at_zero), sum_of(product_of(constant(of_u), u), product_of(constant(of_v), v))));
    positive.push_back(Expression::call("max", {constant(0), exact.back()}));
  }
  const Expression sum = sum_of(positive[0], sum_of(positive[1], positive[2]));
  JointShares joint{{quotient_of(positive[1], sum), quotient_of(positive[2], sum)},
                    sum_of(constant(1), Expression::call("min", exact))};
  if (!step.rounds_to) return joint;
  Expression left = constant(1);
  for (Expression& share : joint.shares) {
    share = Expression::call("min", {rounded_to_step(share, *step.rounds_to), left});
    left = difference_of(left, share);
  }
  return joint;
}

NodePtr with_joint(const NodePtr& solid, const ResolvedStep& step, const NodeMaker& maker) {
  const JointShares joint = shares_of(solid, step, maker);
  DataList shares, materials(step.materials.begin(), step.materials.end());
  Expression left = constant(1);
  for (const Expression& share : joint.shares) {
    shares.push_back(NodeMaker::formula_data(share));
    left = difference_of(left, share);
  }
  shares.push_back(NodeMaker::formula_data(left));
  const NodePtr made = maker.make(
      "fgrade", {{"functions", Data(std::move(shares))}, {"materials", Data(std::move(materials))}}, {solid});
  return made ? with_attribute(made, step.place_in_reach, joint.place_in_reach, maker) : nullptr;
}

// Returns the solid with the fraction of one material, as the step gives it; the rest takes what it leaves.
NodePtr with_fractions(const NodePtr& solid, const ResolvedStep& step, Expression fraction, const NodeMaker& maker) {
  const Calibration& calibration = *step.step.calibration;
  const std::vector<double> usual = calibration.usual();
  double others = 0;  // fractions that are as usual
  for (size_t n = 0; n < calibration.inputs.size(); ++n)
    if (calibration.inputs[n].is_fraction() && n != *step.step.input) others += usual[n];
  if (step.rounds_to) fraction = Expression::call("min", {fraction, constant(1 - others)});
  DataList shares, materials;
  for (size_t n = 0; n < calibration.inputs.size(); ++n) {
    if (!calibration.inputs[n].is_fraction()) continue;
    const bool is_varied = n == *step.step.input;
    shares.push_back(is_varied ? NodeMaker::formula_data(fraction) : Data(usual[n]));
    if (is_varied && step.is_over_inks)
      materials.push_back(NodeMaker::node_data(maker.make("composition_of", {{"solid", NodeMaker::node_data(solid)}})));
    else
      materials.emplace_back(step.materials[n]);
  }
  shares.push_back(NodeMaker::formula_data(difference_of(constant(1 - others), fraction)));
  materials.emplace_back(step.materials.back());
  const bool has_mixture = step.is_over_inks;
  return maker.make(
      has_mixture ? "material" : "fgrade",
      {{has_mixture ? "fractions" : "functions", Data(std::move(shares))}, {"materials", Data(std::move(materials))}},
      {solid});
}

}  // namespace

NodePtr with_step(const NodePtr& solid, const ResolvedStep& step, const NodeMaker& maker) {
  if (step.step.calibration->inks) return with_inks(solid, step, maker);
  if (step.joint) return with_joint(solid, step, maker);
  const StepFormula formula(solid, step, maker);
  const Expression result = formula.result();
  const NodePtr made = step.step.to() == calibration::fractions ? with_fractions(solid, step, result, maker)
                                                                : with_attribute(solid, step.step.to(), result, maker);
  if (!made || step.place_in_reach.empty()) return made;
  return with_attribute(made, step.place_in_reach, formula.place_in_reach(), maker);
}

NodePtr with_rounded(const NodePtr& solid, const std::string& attribute, double step, const NodeMaker& maker) {
  return with_attribute(solid, attribute, rounded_to_step(maker.attribute_of(solid, attribute), step), maker);
}

}  // namespace ombre::compile
