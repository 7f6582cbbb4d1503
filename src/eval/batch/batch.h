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

#include "eval/batch/kernels.h"
#include "program/program.h"

namespace ombre::eval {

// A row of floats, or one number for all of them.
struct Values {
  const float* row = nullptr;
  bool is_number = false;
  float operator[](size_t n) const { return row[is_number ? 0 : n]; }
};

// Sources that know their rows: what they say along row (j, k) of the box.
class SourceRows {
 public:
  virtual ~SourceRows() = default;
  virtual bool has(const program::Read& read) const = 0;  // if not, it is asked point by point
  virtual void fill(const program::Read& read, size_t j, size_t k, std::span<float> values) const = 0;
  // Slot of the program's part set `set`; asked only of those that have parts.
  virtual void fill_parts(uint32_t /*set*/, size_t /*slot*/, size_t /*j*/, size_t /*k*/, std::span<float>) const {}
};

// Coordinates of the points of a box, as floats.
struct BoxPoints {
  std::span<const float> xs, ys, zs;
};

// Narrow boxes have short rows, and starting an op on a row costs as much as some dozens of points. So all
// points of a layer can make up one row: `xs` and `ys` are those of its points then, each row of the box
// padded to a multiple of batch_lanes.
struct BoxLayers {
  std::span<const float> xs, ys, zs;
  size_t width = 0, rows = 0;  // of the box
};

class BatchEvaluator {
 public:
  explicit BatchEvaluator(const KernelSet& kernels) : kernels_(kernels) {}

  // `program` without calls and affine maps, parts only where `sources` has them; `ranges` are its values' over the box
  // for batches, and decide nothing but speed. All arguments must outlive the evaluation.
  void begin(const program::Program& program, const std::vector<Interval>& ranges, const BoxPoints& points,
             const SourceRows& sources);
  // The only row of a layer is row 0.
  void begin(const program::Program& program, const std::vector<Interval>& ranges, const BoxLayers& points,
             const SourceRows& sources);
  void begin_layer(size_t k);
  // Computes output 0 along row j of the layer; finish_row then the other outputs.
  void begin_row(size_t j);
  void finish_row();
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
    float* base = nullptr;
  };

  void begin_box(const program::Program& program, const std::vector<Interval>& ranges, const BoxPoints& points,
                 const SourceRows& sources);
  template <class F>
  void each_read(const program::Instruction& in, F f) const;
  void classify();
  void find_order();
  void pair_sines();
  void reserve();
  void compile(const std::vector<Interval>& ranges);
  void compile_one(program::ValueId id, const std::vector<Interval>& ranges);
  void place_constants_and_inputs(const BoxPoints& points);
  Place place_for(program::ValueId id, uint8_t consumer) const;
  Place take(program::ValueId id);
  void release(program::ValueId id, program::ValueId user);
  size_t row_length(uint8_t mask) const;
  size_t point_count(uint8_t mask) const;
  void run(const std::vector<Step>& steps, size_t j, size_t count);
  void sample(const Step& step, size_t j, size_t count) const;
  // Calls f(j, values) for each row of the box that the row at work stands for.
  template <class F>
  void each_box_row(const Step& step, size_t j, size_t count, F f) const;

  const KernelSet& kernels_;
  const program::Program* program_ = nullptr;
  const SourceRows* sources_ = nullptr;
  size_t width_ = 0, rows_ = 0, layers_ = 0, j_ = 0, k_ = 0;
  bool by_layers_ = false;
  size_t box_width_ = 0, box_rows_ = 0;  // by layers: of the box
  std::vector<Fact> facts_;
  std::vector<program::ValueId> order_, seen_;
  std::array<std::vector<float*>, 8> free_;               // rows by mask
  std::array<std::vector<Step>, 9> steps_;                // by mask; [8]: all axes, and not needed by output 0
  std::vector<std::pair<float*, float*>> layer_numbers_;  // from where values of z lie to where rows read them
  std::vector<float> memory_;
  float* next_ = nullptr;
};

}  // namespace ombre::eval
