// Evaluates designs at points in double precision, for tests.
#pragma once

#include <map>
#include <random>

#include "jobs/test_designs.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"
#include "questions/build.h"

namespace ombre::compile {

class TestSolid {
 public:
  struct Answer {
    bool inside = false, interior = false;
    double distance = 0;
    std::map<std::string, double> fractions;  // fractions that are not 0
    std::map<std::string, double> attributes;
  };

  explicit TestSolid(const std::string& text, design::Demand demand = design::Demand::inside) {
    Diagnostics diagnostics;
    loaded_ = load_text(text, diagnostics);
    EXPECT_TRUE(loaded_) << to_text(diagnostics);
    solid_ = whole_solid(loaded_->design);
    design::LoweringContext context(loaded_->design.materials, {solid_});
    program::Builder builder;
    design::Lowering lowering(context, builder);
    const auto p = program::Point::origin_frame(builder);
    program::Outputs outputs{{"inside", lowering.inside(*solid_, p)},
                             {"interior", lowering.membership(*solid_, p, design::Border::excluded)},
                             {"distance", lowering.distance(*solid_, p)}};
    for (const auto& [id, fraction] : lowering.composition(*solid_, p, demand).fractions)
      outputs.emplace_back(loaded_->design.materials.all()[id].name, fraction);
    materials_end_ = outputs.size();
    for (const auto& attribute : context.attributes())
      outputs.emplace_back(attribute.name, lowering.attribute(*solid_, attribute.name, p, demand));
    context.finish_bodies();
    inside_size_ = builder.finish({outputs[0]}).code.size();
    program_ = program::inline_bodies(builder.finish(outputs));
    if (!program_.has_parts()) return;
    std::vector<Interval> ranges;
    evaluate_intervals(program_, Box::centered({1000, 1000, 1000}), ranges);
    program_ = expand_parts(program_, ranges, program::Precision::reference);
  }

  const design::Node& node() const { return *solid_; }
  size_t inside_size() const { return inside_size_; }  // instructions of the program for membership

  Answer at(Vec3 p) const {
    evaluate_point(program_, p, values_);
    const auto value = [&](size_t n) { return values_[program_.outputs[n]]; };
    Answer answer{value(0) != 0, value(1) != 0, value(2), {}, {}};
    for (size_t n = 3; n < program_.outputs.size(); ++n) {
      if (n >= materials_end_)
        answer.attributes[program_.output_names[n]] = value(n);
      else if (value(n) != 0)
        answer.fractions[program_.output_names[n]] = value(n);
    }
    return answer;
  }

 private:
  LoadedPtr loaded_;
  design::NodePtr solid_;
  program::Program program_;
  size_t materials_end_ = 0, inside_size_ = 0;
  mutable std::vector<double> values_;
};

class RandomPoints {
 public:
  explicit RandomPoints(Box box, unsigned seed = 1) : box_(box), random_(seed) {}
  Vec3 next() {
    const auto within = [&](int axis) {
      return std::uniform_real_distribution<double>(box_.lo[axis], box_.hi[axis])(random_);
    };
    return {within(0), within(1), within(2)};
  }

 private:
  Box box_;
  std::mt19937 random_;
};

}  // namespace ombre::compile
