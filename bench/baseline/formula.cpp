#include "formula.h"

#include <cmath>
#include <exprtk.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace baseline {

struct Formula::Compiled {
  double x = 0, y = 0, z = 0;
  double rho = 0, phic = 0, r = 0, theta = 0, phis = 0;
  bool cylinder = false, sphere = false;  // whether the formula uses these coordinates
  exprtk::symbol_table<double> symbols;
  exprtk::expression<double> expression;

  void declare() {
    const std::pair<const char*, double*> variables[] = {
        {"x", &x}, {"y", &y}, {"z", &z}, {"rho", &rho}, {"phic", &phic}, {"r", &r}, {"theta", &theta}, {"phis", &phis}};
    for (const auto& [name, place] : variables) symbols.add_variable(name, *place);
    symbols.add_constants();
    symbols.add_constant("e", std::numbers::e);
    expression.register_symbol_table(symbols);
  }

  void compile(const std::string& text) {
    exprtk::parser<double> parser;
    parser.dec().collect_variables() = true;
    if (!parser.compile(text, expression)) throw std::runtime_error(text + ": " + parser.error());
    std::vector<std::pair<std::string, exprtk::parser<double>::symbol_type>> used;
    parser.dec().symbols(used);
    for (const auto& [name, type] : used) {
      cylinder |= name == "rho" || name == "phic";
      sphere |= name == "r" || name == "theta" || name == "phis";
    }
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

Formula::Formula(const std::string& text) : compiled_(std::make_unique<Compiled>()) {
  compiled_->declare();
  compiled_->compile(text);
}

Formula::~Formula() = default;

double Formula::at(const Point& p) const {
  Compiled& c = *compiled_;
  c.x = p.x;
  c.y = p.y;
  c.z = p.z;
  if (c.cylinder) c.set_cylinder();
  if (c.sphere) c.set_sphere();
  return c.expression.value();
}

}  // namespace baseline
