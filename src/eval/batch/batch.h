// Evaluates programs over boxes of points in single precision, row by row.
//
// A value that depends on x alone is computed once for the box, one of x and y once for each y, and one of x and z once
// for each z. Only values of all three are computed for each row. Values are stored in reused rows of floats that stay
// in the first-level cache.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/system/large_array.h"
#include "eval/batch/kernels.h"
#include "program/program.h"

namespace ombre::eval {

// A row of floats, or one number for a whole row.
struct Values {
  const float* row = nullptr;
  bool is_number = false;
  float operator[](size_t n) const { return row[is_number ? 0 : n]; }
  Values from(size_t n) const { return {row + (is_number ? 0 : n), is_number}; }
};

// Rows of a layer that are to be filled. Row `first` + n begins at values + n * stride.
struct RowsToFill {
  size_t layer = 0, first = 0, count = 0;
  float* values = nullptr;
  size_t width = 0, stride = 0;
};

// Sources and parts that give values for whole rows of the box.
class SourceRows {
 public:
  virtual ~SourceRows() = default;
  virtual bool has(const program::Read& read) const = 0;  // false if the source must be evaluated at each point
  virtual void fill(const program::Read& read, const RowsToFill& rows) const = 0;
  // Fills rows with a slot of the program's part set `set`. Only called for programs with parts.
  virtual void fill_parts(uint32_t /*set*/, size_t /*slot*/, const RowsToFill&) const {}
};

// Coordinates of the points of a box, as floats.
struct BoxPoints {
  std::span<const float> xs, ys, zs;
};

// A row of points of a narrow box. Starting an op on a row costs as much as dozens of points, so the rows of a layer
// are joined into one. Each is padded to a multiple of batch_lanes. They need not be neighbours.
struct PointRow {
  const float* xs = nullptr;  // x coordinates, padded
  float y = 0;
};
struct BoxLayers {
  std::span<const PointRow> rows;
  std::span<const float> zs;
  size_t width = 0;
};

// Arbitrary points, given by lists of equal length.
struct PointList {
  std::span<const float> xs, ys, zs;
};

class BatchEvaluator {
 public:
  // Rows are finished by finish_row(), or all of them by finish_row_inside(). Then sources are not sampled either where
  // a cheaper operand of a conjunction is 0 and so decides output 0.
  enum class Finish : uint8_t { everywhere, inside };
  explicit BatchEvaluator(const KernelSet& kernels, Finish finish = Finish::everywhere)
      : kernels_(kernels), finish_(finish) {}

  // Starts the evaluation of a box. `program` may not hold calls or affine maps, and parts only if `sources` has them.
  // `ranges` are the values' ranges over the box for batches, and affect only speed. All arguments must outlive the
  // evaluation.
  void begin(const program::Program& program, const std::vector<Interval>& ranges, const BoxPoints& points,
             const SourceRows& sources);
  // Starts the evaluation of layers. The only row of each layer is row 0.
  void begin(const program::Program& program, const std::vector<Interval>& ranges, const BoxLayers& points,
             const SourceRows& sources);

  // Compiles a program for boxes with up to `most_points` points per layer, padding included, and up to `most_layers`
  // layers. The compiled program can be placed on many such boxes, with different constants.
  void compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_points,
               size_t most_layers, const SourceRows& sources);
  void set_constant(program::ValueId constant, float value);
  void place(const BoxLayers& points);
  // Compiles a program for lists of up to `most_points` points, which are row 0 of layer 0.
  void compile_for_list(const program::Program& program, const std::vector<Interval>& ranges, size_t most_points,
                        const SourceRows& sources);
  void place(const PointList& points);

  void begin_layer(size_t k);
  // begin_row computes output 0 along row j of the layer. finish_row then computes the other outputs. finish_row_inside
  // does so too, but does not sample sources where output 0 is 0; outputs are undefined there.
  void begin_row(size_t j);
  void finish_row();
  void finish_row_inside();
  Values output(size_t n) const;

 private:
  // The memory of a value. Values that are stored for each y are `step` floats apart.
  struct Place {
    float* base = nullptr;
    ptrdiff_t step = 0;
    float* at(size_t j) const { return base + static_cast<ptrdiff_t>(j) * step; }
  };
  struct Step {
    enum class Kind : uint8_t { kernel, sine_cosine, fill, sample, parts } kind = Kind::kernel;
    uint8_t numbers = 0;  // bits of the operands that are one number for the whole row
    Kernel kernel = nullptr;
    Place a, b, c, out, second_out;
    const program::Read* read = nullptr;
    uint32_t channels = 0;  // begin of a sample's list of channels in channels_
    uint32_t channel_count = 0;
    const program::Instruction* parts = nullptr;
    Place guard;  // of a sample: nonzero where it matters; everywhere if there is no row
    bool guard_is_number = false;
  };
  // Properties of an instruction that the compiler computes.
  struct Fact {
    uint8_t mask = 0;  // the axes on which it depends
    bool needed = false;
    bool early = false;     // output 0 needs it
    bool outlives = false;  // an output, or read by instructions that depend on other axes
    bool done = false;
    program::ValueId last_use = 0, partner = 0;
    program::ValueId next_channel = 0;  // another channel of the same source at the same points
    program::ValueId guard = 0;         // of a sample: the value that says where it matters, or none
    uint32_t rank = 0;                  // guards have lower ranks than what they guard
    float* base = nullptr;
  };

  enum class Form : uint8_t { box, layers, list };
  struct Shape {
    Form form = Form::box;
    std::array<size_t, 3> most{};  // greatest number of points along each axis
  };
  uint8_t mask_of_input(size_t axis) const;
  void compile(const program::Program& program, const std::vector<Interval>& ranges, const Shape& shape,
               const SourceRows& sources);
  void run_before_layers();
  template <class F>
  void each_read(const program::Instruction& in, F f) const;
  void classify();
  std::vector<bool> conjuncts() const;
  std::vector<double> sampling_costs() const;
  void find_guards();
  void find_ranks();
  bool is_sampled(const program::Instruction& in) const;
  template <class F>
  void each_use(program::ValueId id, F f) const;
  void find_order();
  void pair_sines();
  void link_channels();
  void add_channels(program::ValueId first, Step& step);
  void reserve();
  void compile_one(program::ValueId id, const std::vector<Interval>& ranges);
  void take_constants_and_inputs();
  void place_input(size_t axis, std::span<const float> values);
  Place place_for(program::ValueId id, uint8_t consumer) const;
  Place take(program::ValueId id);
  void release(program::ValueId id, program::ValueId user);
  size_t row_length(uint8_t mask) const;
  void run(const std::vector<Step>& steps, size_t j, size_t count);
  void sample(const Step& step, size_t j, size_t count) const;
  // Writes the numbers of the lanes in [begin, begin + count) where a value is not 0, and returns how many there are.
  static size_t choose_lanes(const Values& where, size_t begin, size_t count, uint8_t* lanes);
  RowsToFill rows_of(const Step& step, size_t j, size_t count) const;

  const KernelSet& kernels_;
  const Finish finish_;
  const program::Program* program_ = nullptr;
  const SourceRows* sources_ = nullptr;
  Shape shape_;
  size_t width_ = 0, rows_ = 0, layers_ = 0, j_ = 0, k_ = 0;
  size_t box_width_ = 0, box_rows_ = 0;                  // size of a layer in points
  std::array<std::vector<program::ValueId>, 3> inputs_;  // the inputs that are needed
  std::vector<Fact> facts_;
  bool has_guards_ = false;
  std::vector<program::ValueId> order_, seen_;
  std::array<std::vector<float*>, 8> free_;  // free rows by mask
  std::array<std::vector<Step>, 9> steps_;   // steps by mask; [8] holds those of all axes that output 0 does not need
  // Pairs of the row of a value that depends on z, and the place where rows read it.
  std::vector<std::pair<float*, float*>> layer_numbers_;
  std::vector<std::pair<int, Place>> channels_;  // channels of samples, and the places of their values
  LargeArray<float> memory_;
  size_t memory_floats_ = 0;
  float* next_ = nullptr;
  Values inside_;  // nonzero where sources are sampled; everywhere if there is no row
};

}  // namespace ombre::eval
