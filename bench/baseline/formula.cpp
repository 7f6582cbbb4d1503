#include "formula.h"

#include <cmath>
#include <exprtk.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace baseline {
namespace {

// The variables of all formulas: one point is evaluated at a time.
struct Variables {
  double x = 0, y = 0, z = 0;
  double rho = 0, phic = 0, r = 0, theta = 0, phis = 0;
  exprtk::symbol_table<double> symbols;

  Variables() {
    const std::pair<const char*, double*> places[] = {{"x", &x},       {"y", &y}, {"z", &z},         {"rho", &rho},
                                                      {"phic", &phic}, {"r", &r}, {"theta", &theta}, {"phis", &phis}};
    for (const auto& [name, place] : places) symbols.add_variable(name, *place);
    symbols.add_constants();
    symbols.add_constant("e", std::numbers::e);
  }

  void set_cylinder() {
    rho = std::sqrt(x * x + y * y);
    phic = std::atan2(y, x);
  }

  void set_sphere() {
    r = std::sqrt(x * x + y * y + z * z);
    theta = std::atan2(y, x);
    phis = r > 0 ? std::acos(z / r) : 0;
  }
};

Variables variables;

exprtk::parser<double>& shared_parser() {
  static exprtk::parser<double> parser;
  parser.dec().collect_variables() = true;
  return parser;
}

}  // namespace

struct Formula::Compiled {
  bool cylinder = false, sphere = false;  // whether the formula uses these coordinates
  exprtk::expression<double> expression;

  explicit Compiled(const std::string& text) {
    exprtk::parser<double>& parser = shared_parser();
    expression.register_symbol_table(variables.symbols);
    if (!parser.compile(text, expression)) throw std::runtime_error(text + ": " + parser.error());
    std::vector<std::pair<std::string, exprtk::parser<double>::symbol_type>> used;
    parser.dec().symbols(used);
    for (const auto& [name, type] : used) {
      cylinder |= name == "rho" || name == "phic";
      sphere |= name == "r" || name == "theta" || name == "phis";
    }
  }
};

Formula::Formula(const std::string& text) : compiled_(std::make_unique<Compiled>(text)) {}
Formula::~Formula() = default;

double Formula::at(const Point& p) const {
  variables.x = p.x;
  variables.y = p.y;
  variables.z = p.z;
  if (compiled_->cylinder) variables.set_cylinder();
  if (compiled_->sphere) variables.set_sphere();
  return compiled_->expression.value();
}

}  // namespace baseline
