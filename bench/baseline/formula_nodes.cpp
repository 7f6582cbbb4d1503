#include "formula_nodes.h"

#include <utility>

#include "formula.h"
#include "solids.h"

namespace baseline {
namespace {

class Function final : public Leaf {
 public:
  Function(const std::string& expression, const Box& box, size_t material)
      : Leaf(box, material), formula_(expression) {}
  double distance(const Point& p) const override { return box().contains(p) ? formula_.at(p) : far_away; }

 private:
  Formula formula_;
};

class Grade final : public Node {
 public:
  Grade(const std::vector<std::string>& functions, std::vector<size_t> materials, bool greatest_takes_all,
        NodePtr child)
      : Node(child->box()),
        materials_(std::move(materials)),
        greatest_takes_all_(greatest_takes_all),
        child_(std::move(child)) {
    for (const std::string& function : functions) formulas_.push_back(std::make_unique<Formula>(function));
  }

  double distance(const Point& p) const override { return child_->distance(p); }

  void add_composition(const Point& p, Composition& shares) const override {
    double values[max_materials];
    for (size_t i = 0; i < formulas_.size(); ++i) values[i] = formulas_[i]->at(p);
    if (greatest_takes_all_) {
      const auto greatest = std::max_element(values, values + formulas_.size());
      shares[materials_[static_cast<size_t>(greatest - values)]] += 1;
      return;
    }
    double total = 0;
    for (size_t i = 0; i < formulas_.size(); ++i) total += values[i] = std::max(values[i], 0.0);
    if (total > 0)
      for (size_t i = 0; i < formulas_.size(); ++i) shares[materials_[i]] += values[i] / total;
  }

 private:
  static constexpr size_t max_materials = 256;

  std::vector<std::unique_ptr<Formula>> formulas_;
  std::vector<size_t> materials_;
  bool greatest_takes_all_;
  NodePtr child_;
};

}  // namespace

NodePtr function(const std::string& expression, const Box& box, size_t material) {
  return std::make_unique<Function>(expression, box, material);
}

NodePtr grade(const std::vector<std::string>& functions, std::vector<size_t> materials, bool greatest_takes_all,
              NodePtr child) {
  return std::make_unique<Grade>(functions, std::move(materials), greatest_takes_all, std::move(child));
}

}  // namespace baseline
