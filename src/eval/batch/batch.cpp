#include "eval/batch/batch.h"

#include <algorithm>
#include <cstdint>

#include "base/system/assert.h"

namespace ombre::eval {

using program::Instruction;
using program::Op;
using program::ValueId;

namespace {

constexpr uint8_t axis_x = 1, axis_y = 2, axis_z = 4, all_axes = 7;
constexpr size_t late = 8;
constexpr ValueId none = ~ValueId{0};

// Returns the axis along which values that depend on the axes in `mask` are stored, or 0 if they are single numbers.
uint8_t row_axis(uint8_t mask) { return mask & axis_x ? axis_x : mask & axis_y ? axis_y : mask; }

}  // namespace

void BatchEvaluator::begin(const program::Program& program, const std::vector<Interval>& ranges,
                           const BoxPoints& points, const SourceRows& sources) {
  compile(program, ranges, Shape{Form::box, {points.xs.size(), points.ys.size(), points.zs.size()}}, sources);
  width_ = points.xs.size();
  rows_ = points.ys.size();
  layers_ = points.zs.size();
  place_input(0, points.xs);
  place_input(1, points.ys);
  place_input(2, points.zs);
  run_before_layers();
}

void BatchEvaluator::begin(const program::Program& program, const std::vector<Interval>& ranges,
                           const BoxLayers& points, const SourceRows& sources) {
  compile(program, ranges, padded(points.width) * points.rows.size(), points.zs.size(), sources);
  place(points);
}

void BatchEvaluator::compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_points,
                             size_t most_layers, const SourceRows& sources) {
  compile(program, ranges, Shape{Form::layers, {most_points, 1, most_layers}}, sources);
}

void BatchEvaluator::compile_for_list(const program::Program& program, const std::vector<Interval>& ranges,
                                      size_t most_points, const SourceRows& sources) {
  compile(program, ranges, Shape{Form::list, {most_points, 1, 1}}, sources);
}

void BatchEvaluator::compile(const program::Program& program, const std::vector<Interval>& ranges, const Shape& shape,
                             const SourceRows& sources) {
  program_ = &program;
  sources_ = &sources;
  shape_ = shape;
  classify();
  find_guards();
  find_order();
  pair_sines();
  link_channels();
  reserve();
  take_constants_and_inputs();
  for (const ValueId id : order_)
    if (!facts_[id].done) compile_one(id, ranges);
}

void BatchEvaluator::set_constant(ValueId constant, float value) {
  if (facts_[constant].needed) std::fill_n(facts_[constant].base, row_length(0), value);
}

void BatchEvaluator::place(const BoxLayers& points) {
  box_width_ = points.width;
  box_rows_ = points.rows.size();
  width_ = padded(box_width_) * box_rows_;
  rows_ = 1;
  layers_ = points.zs.size();
  ASSERT(width_ <= shape_.most[0] && layers_ <= shape_.most[2]);
  for (const ValueId id : inputs_[0]) {
    float* to = facts_[id].base;
    for (const PointRow& row : points.rows) to = std::copy_n(row.xs, padded(box_width_), to);
  }
  for (const ValueId id : inputs_[1]) {
    float* to = facts_[id].base;
    for (const PointRow& row : points.rows) to = std::fill_n(to, padded(box_width_), row.y);
  }
  place_input(2, points.zs);
  run_before_layers();
}

void BatchEvaluator::place(const PointList& points) {
  box_width_ = points.xs.size();
  box_rows_ = 1;
  width_ = padded(box_width_);
  rows_ = layers_ = 1;
  ASSERT(box_width_ <= shape_.most[0]);
  place_input(0, points.xs);
  place_input(1, points.ys);
  place_input(2, points.zs);
  run_before_layers();
}

void BatchEvaluator::place_input(size_t axis, std::span<const float> values) {
  for (const ValueId id : inputs_[axis]) {
    float* const end = std::copy(values.begin(), values.end(), facts_[id].base);
    std::fill(end, facts_[id].base + padded(values.size()), values.back());
  }
}

// Computes values that are the same in all layers.
void BatchEvaluator::run_before_layers() {
  run(steps_[0], 0, 1);
  run(steps_[axis_y], 0, rows_);
  run(steps_[axis_z], 0, layers_);
  run(steps_[axis_x], 0, width_);
  if (!steps_[axis_x | axis_y].empty())
    for (size_t j = 0; j < rows_; ++j) run(steps_[axis_x | axis_y], j, width_);
}

void BatchEvaluator::begin_layer(size_t k) {
  k_ = k;
  for (const auto& [from, to] : layer_numbers_) *to = from[k];
  run(steps_[axis_y | axis_z], 0, rows_);
  run(steps_[axis_x | axis_z], 0, width_);
}

void BatchEvaluator::begin_row(size_t j) {
  j_ = j;
  run(steps_[all_axes], j, width_);
}

void BatchEvaluator::finish_row() { run(steps_[late], j_, width_); }

void BatchEvaluator::finish_row_inside() {
  inside_ = output(0);
  finish_row();
  inside_ = {};
}

Values BatchEvaluator::output(size_t n) const {
  const ValueId id = program_->outputs[n];
  return {place_for(id, all_axes).at(j_), row_axis(facts_[id].mask) != axis_x};
}

// Calls `f` with the operands that an instruction reads. Sources with values for whole rows read none.
template <class F>
void BatchEvaluator::each_read(const Instruction& in, F f) const {
  if (in.op == Op::parts || (in.op == Op::source && sources_->has(program_->reads[in.aux]))) return;
  each_operand(in, f);
}

bool BatchEvaluator::is_sampled(const Instruction& in) const {
  return in.op == Op::source && !sources_->has(program_->reads[in.aux]);
}

// Calls `f` with what must be computed before an instruction: its operands and its guard.
template <class F>
void BatchEvaluator::each_use(ValueId id, F f) const {
  each_read(program_->code[id], f);
  if (facts_[id].guard != none) f(facts_[id].guard);
}

// Returns the axes along which an input varies. In form `layers` all points of a layer lie in one row, in form `list`
// all points do.
uint8_t BatchEvaluator::mask_of_input(size_t axis) const {
  if (shape_.form == Form::list) return all_axes;
  return shape_.form == Form::layers && axis == 1 ? axis_x : static_cast<uint8_t>(1 << axis);
}

// Finds the axes on which each value depends, and the values that are needed.
void BatchEvaluator::classify() {
  facts_.assign(program_->code.size(), Fact{});
  for (size_t i = 0; i < facts_.size(); ++i) {
    const Instruction& in = program_->code[i];
    uint8_t& mask = facts_[i].mask;
    if (in.op == Op::input) mask = mask_of_input(static_cast<size_t>(in.value));
    each_operand(in, [&](ValueId id) { mask |= facts_[id].mask; });
    if (in.op == Op::parts || (in.op == Op::source && sources_->has(program_->reads[in.aux]))) mask = all_axes;
  }
  for (const ValueId id : program_->outputs) facts_[id].needed = true;
  facts_[program_->outputs[0]].early = true;
  for (size_t i = facts_.size(); i-- > 0;) {
    if (!facts_[i].needed) continue;
    each_read(program_->code[i], [&](ValueId id) {
      facts_[id].needed = true;
      facts_[id].early |= facts_[i].early;
    });
  }
}

// Returns for each value whether it is nonzero wherever output 0 is, as an operand of its conjunctions.
std::vector<bool> BatchEvaluator::conjuncts() const {
  std::vector<bool> found(facts_.size());
  found[program_->outputs[0]] = true;
  for (size_t i = facts_.size(); i-- > 0;) {
    const Instruction& in = program_->code[i];
    if (found[i] && in.op == Op::logical_and) found[in.a] = found[in.b] = true;
  }
  return found;
}

// Returns for each value the ops of the samples that it needs. Those that are needed in several ways count several
// times.
std::vector<double> BatchEvaluator::sampling_costs() const {
  std::vector<double> costs(facts_.size());
  for (size_t i = 0; i < facts_.size(); ++i) {
    const Instruction& in = program_->code[i];
    if (is_sampled(in)) costs[i] = program_->reads[in.aux].source->ops_of_sample(program_->reads[in.aux].channel);
    each_read(in, [&](ValueId id) { costs[i] += costs[id]; });
  }
  return costs;
}

// Finds the guards of samples. All ways from a sample to output 0 lead through conjunctions with its guard. Other
// outputs only count where output 0 is not 0.
void BatchEvaluator::find_guards() {
  for (Fact& fact : facts_) fact.guard = none;
  has_guards_ = false;
  if (finish_ != Finish::inside) return;
  if (std::ranges::none_of(program_->code, [&](const Instruction& in) { return is_sampled(in); })) return;
  const std::vector<bool> implied = conjuncts();
  const std::vector<double> costs = sampling_costs();
  std::vector<bool> is_used(facts_.size()), is_used_late(facts_.size());
  for (size_t n = 0; n < program_->outputs.size(); ++n) (n == 0 ? is_used : is_used_late)[program_->outputs[n]] = true;
  const auto use = [&](ValueId id, ValueId guard) {
    facts_[id].guard = is_used[id] && facts_[id].guard != guard ? none : guard;
    is_used[id] = true;
  };
  for (size_t i = facts_.size(); i-- > 0;) {
    Fact& fact = facts_[i];
    const Instruction& in = program_->code[i];
    if (!fact.needed) continue;
    if (!fact.early) {
      each_read(in, [&](ValueId id) { is_used_late[id] = true; });
      continue;
    }
    if (fact.guard != none && is_used_late[i] && !implied[fact.guard]) fact.guard = none;
    each_read(in, [&](ValueId id) {
      const ValueId other = id == in.a ? in.b : in.a;
      const bool decides = fact.guard == none && in.op == Op::logical_and && costs[other] < costs[id];
      use(id, decides ? other : fact.guard);
    });
  }
  // Values of fewer axes are computed earlier.
  for (size_t i = 0; i < facts_.size(); ++i) {
    Fact& fact = facts_[i];
    const bool is_known = fact.guard != none && (facts_[fact.guard].mask & ~fact.mask) == 0;
    if (!is_known || !is_sampled(program_->code[i]) || row_axis(fact.mask) != axis_x) fact.guard = none;
  }
  has_guards_ = std::ranges::any_of(facts_, [](const Fact& fact) { return fact.guard != none; });
  if (has_guards_) find_ranks();
}

// Gives operands no higher ranks than their users, and guards lower ranks than what they guard.
void BatchEvaluator::find_ranks() {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (size_t i = 0; i < facts_.size(); ++i) {
      Fact& fact = facts_[i];
      uint32_t rank = fact.guard == none ? 0 : facts_[fact.guard].rank + 1;
      each_read(program_->code[i], [&](ValueId id) { rank = std::max(rank, facts_[id].rank); });
      has_changed |= rank != fact.rank;
      fact.rank = rank;
    }
  }
}

// Puts the instructions that output 0 needs first, guards before what they guard, and finds the last use of each value.
void BatchEvaluator::find_order() {
  order_.clear();
  for (const bool early : {true, false})
    for (ValueId i = 0; i < facts_.size(); ++i)
      if (facts_[i].needed && facts_[i].early == early) order_.push_back(i);
  if (has_guards_)
    std::ranges::stable_sort(order_, {}, [&](ValueId i) { return std::pair(!facts_[i].early, facts_[i].rank); });
  for (const ValueId i : order_)
    each_use(i, [&](ValueId id) {
      facts_[id].last_use = i;
      if (facts_[id].mask != facts_[i].mask) facts_[id].outlives = true;
    });
  for (const ValueId id : program_->outputs) facts_[id].outlives = true;
}

// Pairs the sine and cosine of the same value, which are computed together.
void BatchEvaluator::pair_sines() {
  seen_.assign(facts_.size(), none);
  for (const ValueId i : order_) {
    facts_[i].partner = none;
    const Instruction& in = program_->code[i];
    if (in.op != Op::sin && in.op != Op::cos) continue;
    const ValueId other = seen_[in.a];
    seen_[in.a] = i;
    if (other == none || program_->code[other].op == in.op) continue;
    facts_[i].partner = other;
    facts_[other].partner = i;
  }
}

// Links channels of one source that are needed at the same points and for the same outputs. They are sampled together.
void BatchEvaluator::link_channels() {
  channels_.clear();
  if (program_->reads.empty()) return;
  seen_.assign(facts_.size(), none);
  for (const ValueId i : order_) {
    const Instruction& in = program_->code[i];
    if (in.op != Op::source) continue;
    facts_[i].next_channel = none;
    const ValueId before = seen_[in.a];
    seen_[in.a] = i;
    if (before == none) continue;
    const Instruction& other = program_->code[before];
    const bool is_same = other.b == in.b && other.c == in.c && facts_[before].mask == facts_[i].mask &&
                         facts_[before].early == facts_[i].early && facts_[before].guard == facts_[i].guard &&
                         program_->reads[other.aux].source == program_->reads[in.aux].source &&
                         !sources_->has(program_->reads[other.aux]) && !sources_->has(program_->reads[in.aux]);
    if (is_same) facts_[before].next_channel = i;
  }
}

void BatchEvaluator::add_channels(ValueId first, Step& step) {
  step.channels = static_cast<uint32_t>(channels_.size());
  channels_.emplace_back(step.read->channel, step.out);
  for (ValueId i = facts_[first].next_channel; i != none; i = facts_[i].next_channel) {
    facts_[i].done = true;
    channels_.emplace_back(program_->reads[program_->code[i].aux].channel, take(i));
  }
  step.channel_count = static_cast<uint32_t>(channels_.size()) - step.channels;
}

// Returns the length of a row in the largest box.
size_t BatchEvaluator::row_length(uint8_t mask) const {
  switch (row_axis(mask)) {
    case axis_x:
      return padded(shape_.most[0]);
    case axis_y:
      return padded(shape_.most[1]);
    case axis_z:
      return padded(shape_.most[2]);
    default:
      return padded(1);
  }
}

// Reserves memory for the case that no row is reused. Most of it is never touched.
void BatchEvaluator::reserve() {
  size_t floats = 2 * batch_lanes;
  for (const Fact& fact : facts_) {
    const bool each_row = fact.mask == (axis_x | axis_y) && fact.outlives;
    floats += (each_row ? shape_.most[1] : 1) * row_length(fact.mask) + batch_lanes;
  }
  if (memory_floats_ < floats) {
    memory_floats_ = std::max(floats, 2 * memory_floats_);
    memory_.reset();
    memory_ = unset_large_array<float>(memory_floats_);
  }
  const auto address = reinterpret_cast<uintptr_t>(memory_.get());
  constexpr uintptr_t alignment = batch_lanes * sizeof(float);
  next_ = memory_.get() + (alignment - address % alignment) % alignment / sizeof(float);
  for (auto& rows : free_) rows.clear();
  for (auto& steps : steps_) steps.clear();
  layer_numbers_.clear();
}

// Returns memory for a value's result.
BatchEvaluator::Place BatchEvaluator::take(ValueId id) {
  Fact& fact = facts_[id];
  auto& free_rows = free_[fact.mask];
  if (!fact.outlives && !free_rows.empty()) {
    fact.base = free_rows.back();
    free_rows.pop_back();
    return {fact.base, 0};
  }
  const bool each_row = fact.mask == (axis_x | axis_y) && fact.outlives;
  const size_t length = row_length(fact.mask);
  fact.base = next_;
  next_ += (each_row ? shape_.most[1] : 1) * length;
  if (fact.mask == axis_z) next_ += batch_lanes;
  if (fact.mask == axis_z && fact.outlives) layer_numbers_.emplace_back(fact.base, fact.base + length);
  return {fact.base, each_row ? static_cast<ptrdiff_t>(length) : 0};
}

void BatchEvaluator::release(ValueId id, ValueId user) {
  Fact& fact = facts_[id];
  if (fact.outlives || fact.last_use != user) return;
  fact.last_use = none;  // avoids a second release if both operands are the same
  free_[fact.mask].push_back(fact.base);
}

// Returns where an instruction that depends on the axes `consumer` reads a value.
BatchEvaluator::Place BatchEvaluator::place_for(ValueId id, uint8_t consumer) const {
  const Fact& fact = facts_[id];
  const uint8_t own = row_axis(fact.mask), reader = row_axis(consumer);
  if (own == axis_x && fact.mask == (axis_x | axis_y))
    return {fact.base, fact.outlives ? static_cast<ptrdiff_t>(row_length(fact.mask)) : 0};
  if (own == reader || own == 0) return {fact.base, 0};
  if (own == axis_y) return {fact.base, 1};  // one number for each row
  // One number for the layer, which begin_layer copies to the place after the row of all layers' numbers.
  return {fact.base + row_length(fact.mask), 0};
}

void BatchEvaluator::take_constants_and_inputs() {
  for (auto& ids : inputs_) ids.clear();
  for (ValueId id = 0; id < facts_.size(); ++id) {
    const Instruction& in = program_->code[id];
    if (!facts_[id].needed || (in.op != Op::constant && in.op != Op::input)) continue;
    facts_[id].outlives = true;
    facts_[id].done = true;
    take(id);
    if (in.op == Op::constant)
      set_constant(id, static_cast<float>(in.value));
    else
      inputs_[static_cast<size_t>(in.value)].push_back(id);
  }
}

void BatchEvaluator::compile_one(ValueId id, const std::vector<Interval>& ranges) {
  const Instruction& in = program_->code[id];
  Fact& fact = facts_[id];
  fact.done = true;
  Step step;
  Place* places[] = {&step.a, &step.b, &step.c};
  Unknowns unknowns = Unknowns::never;
  size_t n = 0;
  each_read(in, [&](ValueId operand) {
    *places[n] = place_for(operand, fact.mask);
    if (row_axis(facts_[operand].mask) != row_axis(fact.mask)) step.numbers |= static_cast<uint8_t>(1 << n);
    if (ranges[operand].is_everything()) unknowns = Unknowns::possible;
    ++n;
  });
  if (fact.guard != none) {
    step.guard = place_for(fact.guard, fact.mask);
    step.guard_is_number = row_axis(facts_[fact.guard].mask) != row_axis(fact.mask);
  }
  each_use(id, [&](ValueId operand) { release(operand, id); });

  step.out = take(id);
  if (in.op == Op::parts) {
    step.kind = Step::Kind::parts;
    step.parts = &in;
  } else if (in.op == Op::source) {
    step.read = &program_->reads[in.aux];
    step.kind = sources_->has(*step.read) ? Step::Kind::fill : Step::Kind::sample;
    if (step.kind == Step::Kind::sample) add_channels(id, step);
  } else if (fact.partner != none && !facts_[fact.partner].done) {
    facts_[fact.partner].done = true;
    step.kind = Step::Kind::sine_cosine;
    step.second_out = take(fact.partner);
    if (in.op == Op::cos) std::swap(step.out, step.second_out);
  } else {
    step.kernel = kernels_.kernel(in.op, step.numbers, unknowns);
  }
  steps_[fact.mask == all_axes && !fact.early ? late : fact.mask].push_back(step);
}

void BatchEvaluator::run(const std::vector<Step>& steps, size_t j, size_t count) {
  for (const Step& step : steps) {
    switch (step.kind) {
      case Step::Kind::kernel:
        step.kernel(step.a.at(j), step.b.at(j), step.c.at(j), step.out.at(j), count);
        break;
      case Step::Kind::sine_cosine:
        kernels_.sine_cosine(step.a.at(j), step.out.at(j), step.second_out.at(j), count);
        break;
      case Step::Kind::fill:
        sources_->fill(*step.read, rows_of(step, j, count));
        break;
      case Step::Kind::sample:
        sample(step, j, count);
        break;
      case Step::Kind::parts:
        sources_->fill_parts(step.parts->aux, static_cast<size_t>(step.parts->value), rows_of(step, j, count));
        break;
    }
  }
}

// Returns the rows of the box that make up the current row.
RowsToFill BatchEvaluator::rows_of(const Step& step, size_t j, size_t count) const {
  if (shape_.form == Form::box) return {k_, j, 1, step.out.at(j), count, count};
  return {k_, 0, box_rows_, step.out.at(j), box_width_, padded(box_width_)};
}

size_t BatchEvaluator::choose_lanes(const Values& where, size_t begin, size_t count, uint8_t* lanes) {
  size_t chosen = 0;
  for (size_t i = 0; i < count; ++i)
    if (where.row == nullptr || where[begin + i] != 0) lanes[chosen++] = static_cast<uint8_t>(i);
  return chosen;
}

void BatchEvaluator::sample(const Step& step, size_t j, size_t count) const {
  const float *a = step.a.at(j), *b = step.b.at(j), *c = step.c.at(j);
  const auto value = [&](const float* row, size_t n, unsigned number) {
    return static_cast<double>(row[step.numbers & number ? 0 : n]);
  };
  const Values where = step.guard.base != nullptr ? Values{step.guard.at(j), step.guard_is_number} : inside_;
  constexpr size_t most = 128, most_channels = 16;
  std::array<uint8_t, most> lanes;  // NOLINT: those that are read are set before
  std::array<Vec3, most> points;
  std::array<double, most * most_channels> values;  // NOLINT: likewise
  std::array<int, most_channels> channels{};
  std::array<double*, most_channels> rows{};
  for (size_t begin = 0; begin < count; begin += most) {
    const size_t here = std::min(most, count - begin), chosen = choose_lanes(where, begin, here, lanes.data());
    for (size_t i = 0; i < chosen; ++i) {
      const size_t n = begin + lanes[i];
      points[i] = {value(a, n, a_is_number), value(b, n, b_is_number), value(c, n, c_is_number)};
    }
    for (size_t first = 0; first < step.channel_count; first += most_channels) {
      const size_t together = std::min<size_t>(most_channels, step.channel_count - first);
      const auto* const requested = channels_.data() + step.channels + first;
      for (size_t m = 0; m < together; ++m) {
        channels[m] = requested[m].first;
        rows[m] = values.data() + m * most;
      }
      step.read->source->sample_channels(std::span(channels).first(together), std::span(points).first(chosen),
                                         std::span(rows).first(together));
      for (size_t m = 0; m < together; ++m) {
        float* const out = requested[m].second.at(j) + begin;
        if (chosen < here) std::fill_n(out, here, 0.0F);
        for (size_t i = 0; i < chosen; ++i) out[lanes[i]] = static_cast<float>(rows[m][i]);
      }
    }
  }
}

}  // namespace ombre::eval
