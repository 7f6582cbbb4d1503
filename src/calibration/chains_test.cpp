#include "calibration/chains.h"

#include "calibration/test_calibrations.h"

namespace ombre::calibration {
namespace {

using namespace test;

// A calibration of a property by an attribute, or by a fraction.
CalibrationPtr by(const std::string& name, const std::string& property, const std::string& attribute) {
  return made(R"("name": ")" + name + R"(", "property": ")" + property +
              R"(", "unit": "1", "inputs": [{"attribute": ")" + attribute +
              R"("}], "interpolant": "linear", "points": [{"inputs": [0], "value": 0}, {"inputs": [1], "value": 2}])");
}

CalibrationPtr by_fraction(const std::string& name, const std::string& property) {
  return made(
      R"("name": ")" + name + R"(", "property": ")" + property +
      R"(", "unit": "1", "inputs": [{"fraction": "A"}], "rest": "B", "interpolant": "mixture", "constants": {"values": [1, 2]})");
}

std::string found(const std::vector<CalibrationPtr>& calibrations, const std::vector<std::string>& given,
                  const std::string& wanted) {
  const auto answer = find_chains(calibrations, given, wanted);
  if (const auto* problem = std::get_if<ChainProblem>(&answer)) return problem->message + "; " + problem->hint;
  const auto& chains = std::get<std::vector<Chain>>(answer);
  return chains.size() > 1 ? several_text(chains, wanted) : chain_text(chains.front());
}

}  // namespace

TEST(Chains, AreTheShortest) {
  const auto modulus = by_fraction("m", "modulus"), flow = by("f", "flow_rate", "temperature"),
             density = by("d", "density", "temperature");
  EXPECT_EQ(found({modulus, flow}, {"modulus"}, "fractions"), "modulus to fractions by m");
  EXPECT_EQ(found({flow}, {"temperature"}, "flow_rate"), "temperature to flow_rate by f");
  EXPECT_EQ(found({flow, density}, {"density"}, "flow_rate"),
            "density to temperature by d, then temperature to flow_rate by f");
  const auto direct = by("direct", "density", "flow_rate");
  EXPECT_EQ(found({flow, density, direct}, {"density"}, "flow_rate"), "density to flow_rate by direct");
  EXPECT_EQ(found({flow}, {"flow_rate"}, "flow_rate"), "");
}

TEST(Chains, TwoOfOneLengthAreListed) {
  EXPECT_EQ(found({by_fraction("m", "modulus"), by_fraction("d", "density")}, {"modulus", "density"}, "fractions"),
            "two chains of calibrations lead to fractions: modulus to fractions by m; and density to fractions by d");
}

// A second input that is an attribute comes from the design, or from another chain.
TEST(Chains, SeveralInputsComeTogether) {
  const auto density = made(R"("name": "d", "property": "density", "unit": "1", "interpolant": "linear",
      "inputs": [{"attribute": "infill_density"}, {"attribute": "temperature"}], "points": [
      {"inputs": [0, 0], "value": 1}, {"inputs": [0, 1], "value": 2},
      {"inputs": [1, 0], "value": 3}, {"inputs": [1, 1], "value": 4}])");
  const auto hardness = by("h", "shore_hardness", "temperature");
  EXPECT_EQ(found({density, hardness}, {"density", "shore_hardness"}, "infill_density"),
            "shore_hardness to temperature by h, then density and temperature to infill_density by d");
  const auto chains = find_chains({density, hardness}, {"density", "shore_hardness"}, "infill_density");
  EXPECT_EQ(begins_with(std::get<0>(chains).front()), (std::vector<std::string>{"shore_hardness", "density"}));
  EXPECT_EQ(
      found({density}, {"density"}, "infill_density"),
      "the design gives density, and no calibration leads from there to infill_density; it could give density and "
      "temperature (d)");
}

TEST(Chains, NoneSaysWhatCouldBeGiven) {
  EXPECT_EQ(found({by_fraction("m", "modulus")}, {"hu"}, "fractions"),
            "the design gives hu, and no calibration leads from there to fractions; it could give modulus (m)");
  EXPECT_EQ(found({by("resin", "cure_depth", "dose")}, {"cure_depth"}, "fractions"),
            "the design gives cure_depth, and no calibration leads from there to fractions; no calibration that is "
            "chosen gives fractions; calibrations lead to dose, for machines whose profile names it in \"needs\"");
  EXPECT_EQ(found({}, {}, "fractions"),
            "the design gives no attribute, and no calibration leads from there to fractions; no calibration that is "
            "chosen gives fractions");
}

}  // namespace ombre::calibration
