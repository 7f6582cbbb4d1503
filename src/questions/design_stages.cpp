#include "questions/design_stages.h"

#include <algorithm>

#include "questions/build.h"
#include "questions/field_program.h"

namespace ombre::compile {
namespace {

using design::StageChannel;

FieldQuery query_of(const design::Design& solid, const design::StageRead& read) {
  FieldQuery query;
  query.distance = read.distance;
  query.inside = read.inside;
  query.attributes = read.attributes;
  for (const design::Material& material : solid.materials.all())
    if (read.fractions) query.fractions.push_back(material.id);
  return query;
}

StageChannel channel_of(const design::Design& solid, const std::string& name, const design::StageRead& read,
                        size_t number) {
  StageChannel channel{name, {}, number};
  const bool is_attribute = std::ranges::find(read.attributes, name) != read.attributes.end();
  if (name == "inside") {
    channel.is_flag = true;
    channel.range = {0, 1};
  } else if (const design::Material* material = solid.materials.find(name); material && !is_attribute) {
    channel.material = material->id;
    channel.range = {0, 1};
  }
  return channel;
}

class InputMaker {
 public:
  explicit InputMaker(const voxel::Lattice& lattice) : lattice_(lattice) {}

  void add(const design::Design& job, const design::StageRead& read, size_t number) {
    design::Design solid = job;
    solid.parts = {{design::nameless_part, read.solid}};
    StageInput::Evaluator evaluator;
    evaluator.first_channel = channels_.size();
    if (read.distance || read.fractions || !read.attributes.empty())
      add_fields(solid, read, evaluator, number);
    else
      add_shape(solid, evaluator, number);
    evaluators_.push_back(std::move(evaluator));
  }

  StageInput take() { return {std::move(channels_), std::move(evaluators_), is_zero_outside_}; }

 private:
  void add_shape(const design::Design& solid, StageInput::Evaluator& evaluator, size_t number) {
    Diagnostics diagnostics;
    const auto program = build_inside_program(solid, diagnostics);
    if (!program) throw error_of(diagnostics);
    voxel::EvaluatorOptions how;
    how.evaluator = voxel::best_evaluator(lattice_);
    evaluator.shape =
        std::make_shared<const voxel::LayerEvaluator>(*program, lattice_, voxel::Dither::threshold, 0, how);
    channels_.push_back(channel_of(solid, "inside", {}, number));
  }

  void add_fields(const design::Design& solid, const design::StageRead& read, StageInput::Evaluator& evaluator,
                  size_t number) {
    Diagnostics diagnostics;
    auto program = build_field_program(solid, query_of(solid, read), diagnostics);
    if (!program) throw error_of(diagnostics);
    for (const std::string& name : program->output_names) channels_.push_back(channel_of(solid, name, read, number));
    if (read.distance || !read.attributes.empty()) is_zero_outside_ = false;
    evaluator.fields =
        std::make_shared<const voxel::FieldEvaluator>(std::move(*program), lattice_, voxel::best_evaluator(lattice_));
  }

  const voxel::Lattice& lattice_;
  std::vector<StageChannel> channels_;
  std::vector<StageInput::Evaluator> evaluators_;
  bool is_zero_outside_ = true;
};

StageInput make_stage_input(const design::Design& job, const std::vector<design::StageRead>& reads,
                            const voxel::Lattice& lattice) {
  InputMaker maker(lattice);
  for (size_t n = 0; n < reads.size(); ++n) maker.add(job, reads[n], n);
  return maker.take();
}

}  // namespace

Error error_of(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics.list())
    if (diagnostic.severity == Severity::error) return {diagnostic.code, to_text(diagnostics), diagnostic.values};
  return Error(to_text(diagnostics));
}

design::Design with_stages(design::Design design, const StageLoan& loan) {
  const auto stages = std::make_shared<JobStages>(&make_stage_input);
  stages->lend(loan);
  design.stages = stages;
  return design;
}

JobStagesPtr stages_of(const design::Design& design) {
  if (auto given = std::dynamic_pointer_cast<JobStages>(design.stages)) return given;
  return std::make_shared<JobStages>(&make_stage_input);
}

}  // namespace ombre::compile
