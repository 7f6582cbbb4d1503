// Reports models and results of `ombre fea`, in lines for people and in events for programs.
#pragma once

#include <string>
#include <variant>

#include "jobs/common/events.h"
#include "jobs/fea/fea_choices.h"

namespace ombre::jobs {

// A model of bricks or tetrahedra with its supports and loads.
struct Case {
  std::variant<fea::Model, compile::TetraModel> made;
  fea::Conditions conditions;

  fea::ModelView view() const {
    if (const auto* bricks = std::get_if<fea::Model>(&made)) return *bricks;
    return std::get<compile::TetraModel>(made).model;
  }
  const compile::TetraModel* tetrahedra() const { return std::get_if<compile::TetraModel>(&made); }
  bool is_mechanics() const { return conditions.physics == fea::Physics::mechanics; }
  // Bytes that solving takes; bricks have a solver of their own.
  double solve_bytes() const;
};

void tell_model(const Events& events, const Case& here);
// Reports the cost of a factorisation before it begins.
void tell_factorisation(const Events& events, const fea::DirectUse& use);

void tell_results(const compile::FeaChoices& arguments, const Events& events, const Case& here,
                  const compile::FeaResults& results, double seconds);

// Returns texts such as "1 round", "12,092 rounds".
std::string counted(size_t count, const std::string& what);

}  // namespace ombre::jobs
