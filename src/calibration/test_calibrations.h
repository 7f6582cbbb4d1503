// Calibrations for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/text/diagnostic.h"
#include "calibration/calibration.h"

namespace ombre::calibration::test {

// Returns a calibration with these members besides those that say where it comes from.
inline std::string text_of(const std::string& members) {
  return R"({"title": "t", "citation": "c", "licence": "l", )" +
         (members.find("\"name\"") == std::string::npos ? std::string(R"("name": "made-up", )") : "") +
         (members.find("\"property\"") == std::string::npos ? std::string(R"("property": "modulus", "unit": "MPa", )")
                                                            : "") +
         members + "}";
}

inline CalibrationPtr made(const std::string& members) {
  Diagnostics diagnostics;
  auto calibration = parse_calibration(make_source("c.json", text_of(members)), diagnostics);
  EXPECT_TRUE(calibration) << to_text(diagnostics);
  return calibration;
}

// A law of the fraction of one material.
inline CalibrationPtr law(const std::string& name, const std::string& constants) {
  return made(R"("inputs": [{"fraction": "Vero"}], "rest": "Agilus", "interpolant": ")" + name +
              R"(", "constants": {)" + constants + "}");
}

}  // namespace ombre::calibration::test
