// Evaluates programs over boxes of points in single precision, row by row, each value where it varies.
//
// A value that depends on x alone is computed once for the box, one of x and y once for each y, one of
// x and z once for each z; only what mixes all three is computed for each row. Values live in reused
// rows of floats that stay in the first-level cache.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/system/large_array.h"
#include "eval/batch/kernels.h"
#include "program/program.h"

namespace ombre::eval {

// A row of floats, or one number for all of them.
struct Values {
  const float* row = nullptr;
  bool is_number = false;
  float operator[](size_t n) const { return row[is_number ? 0 : n]; }
  Values from(size_t n) const { return {row + (is_number ? 0 : n), is_number}; }
};

// Rows of a layer to be filled: row `first` + n begins at values + n * stride.
struct RowsToFill {
  size_t layer = 0, first = 0, count = 0;
  float* values = nullptr;
  size_t width = 0, stride = 0;
};

// Sources that know their rows: what they say along those of the box.
class SourceRows {
 public:
  virtual ~SourceRows() = default;
  virtual bool has(const program::Read& read) const = 0;  // if not, it is evaluated point by point
  virtual void fill(const program::Read& read, const RowsToFill& rows) const = 0;
  // Slot of the program's part set `set`; only for those that have parts.
  virtual void fill_parts(uint32_t /*set*/, size_t /*slot*/, const RowsToFill&) const {}
};

// Coordinates of the points of a box, as floats.
struct BoxPoints {
  std::span<const float> xs, ys, zs;
};

// Narrow boxes have short rows, and starting an op on a row costs as much as some dozens of points. So the
// rows of a layer can make up one: they are padded to a multiple of batch_lanes, and need not be neighbours.
struct PointRow {
  const float* xs = nullptr;  // padded width
  float y = 0;
};
struct BoxLayers {
  std::span<const PointRow> rows;
  std::span<const float> zs;
  size_t width = 0;
};

// Points anywhere, as many in each list.
struct PointList {
  std::span<const float> xs, ys, zs;
};

class BatchEvaluator {
 public:
  explicit BatchEvaluator(const KernelSet& kernels) : kernels_(kernels) {}

  // `program` without calls and affine maps, parts only where `sources` has them; `ranges` are its values' over
  // the box for batches, and decide nothing but speed. All arguments must outlive the evaluation.
  void begin(const program::Program& program, const std::vector<Interval>& ranges, const BoxPoints& points,
             const SourceRows& sources);
  // The only row of a layer is row 0.
  void begin(const program::Program& program, const std::vector<Interval>& ranges, const BoxLayers& points,
             const SourceRows& sources);

  // The same in steps: what is compiled once can be placed on many boxes of at most so many points a layer
  // (padding included) and layers, whose constants may differ.
  void compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_points,
               size_t most_layers, const SourceRows& sources);
  void set_constant(program::ValueId constant, float value);
  void place(const BoxLayers& points);
  // And on lists of at most so many points: row 0 of layer 0.
  void compile_for_list(const program::Program& program, const std::vector<Interval>& ranges, size_t most_points,
                        const SourceRows& sources);
  void place(const PointList& points);

  void begin_layer(size_t k);
  // Computes output 0 along row j of the layer; finish_row then the other outputs, and finish_row_inside those whose
  // values mean nothing where output 0 is 0: sources are not sampled there.
  void begin_row(size_t j);
  void finish_row();
  void finish_row_inside();
  Values output(size_t n) const;

 private:
  // A value's place. Where it is kept for each y, they are `step` apart.
  struct Place {
    float* base = nullptr;
    ptrdiff_t step = 0;
    float* at(size_t j) const { return base + static_cast<ptrdiff_t>(j) * step; }
  };
  struct Step {
    enum class Kind : uint8_t { kernel, sine_cosine, fill, sample, parts } kind = Kind::kernel;
    uint8_t numbers = 0;  // operands that are one number for the row
    Kernel kernel = nullptr;
    Place a, b, c, out, second_out;
    const program::Read* read = nullptr;
    uint32_t channels = 0;  // of a sample: where its list begins in channels_, which `channel_count` says the length of
    uint32_t channel_count = 0;
    const program::Instruction* parts = nullptr;
  };
  // What the compiler knows of an instruction.
  struct Fact {
    uint8_t mask = 0;  // the axes it depends on
    bool needed = false;
    bool early = false;     // output 0 needs it
    bool outlives = false;  // read by instructions of other axes, or an output
    bool done = false;
    program::ValueId last_use = 0, partner = 0;
    program::ValueId next_channel = 0;  // another one of its source at the same points
    float* base = nullptr;
  };

  enum class Form : uint8_t { box, layers, list };
  struct Shape {
    Form form = Form::box;
    std::array<size_t, 3> most{};  // points along each axis
  };
  uint8_t mask_of_input(size_t axis) const;
  void compile(const program::Program& program, const std::vector<Interval>& ranges, const Shape& shape,
               const SourceRows& sources);
  void run_before_layers();
  template <class F>
  void each_read(const program::Instruction& in, F f) const;
  void classify();
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
  // Which lanes of `count` from `begin` on are sampled: their numbers, one after the other.
  size_t choose_lanes(size_t begin, size_t count, uint8_t* lanes) const;
  RowsToFill rows_of(const Step& step, size_t j, size_t count) const;

  const KernelSet& kernels_;
  const program::Program* program_ = nullptr;
  const SourceRows* sources_ = nullptr;
  Shape shape_;
  size_t width_ = 0, rows_ = 0, layers_ = 0, j_ = 0, k_ = 0;
  size_t box_width_ = 0, box_rows_ = 0;                  // of the points of a layer
  std::array<std::vector<program::ValueId>, 3> inputs_;  // that are needed
  std::vector<Fact> facts_;
  std::vector<program::ValueId> order_, seen_;
  std::array<std::vector<float*>, 8> free_;               // rows by mask
  std::array<std::vector<Step>, 9> steps_;                // by mask; [8]: all axes, and not needed by output 0
  std::vector<std::pair<float*, float*>> layer_numbers_;  // from where values of z lie to where rows read them
  std::vector<std::pair<int, Place>> channels_;           // of samples, and where their values go
  LargeArray<float> memory_;
  size_t memory_floats_ = 0;
  float* next_ = nullptr;
  Values inside_;  // where sources are sampled; no row: everywhere
};

}  // namespace ombre::eval
