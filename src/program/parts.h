// A union of thousands of similar parts as a single op: tables of parameters and an index in space.
//
// Each part is a row: the number of a body, which is a program without its constants, and the constants. The op `parts`
// stands for a value that combines all rows. Before evaluation in a region it is replaced by the code of the parts that
// reach the region (passes/expand_parts.cpp). The cost of a tile therefore depends on the parts near it, not on the
// number of parts.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "base/math/box.h"
#include "program/program.h"

namespace ombre::program {

// How the values of a slot of all parts are combined.
enum class SlotKind : uint8_t {
  any,    // 1 if it is 1 in some part
  sum,    // added in the order of the parts
  first,  // value of the first part that holds the point
  last,   // value of the last part that holds the point
};

// The parts of a set, as programs of one precision.
class PartTable {
 public:
  // A program without the values of its constants.
  struct Body {
    Program code;            // the values of its constants and maps are unused
    std::vector<int> slots;  // number of the output for each slot, as in `add`
    bool may_be_unknown = false;
    size_t input_count = 0;  // number of inputs, which are its first instructions
  };

  explicit PartTable(Precision precision) : precision_(precision) {}
  void expect(size_t rows) { rows_.reserve(rows); }
  // Adds a part. `slots[s]` is the number of the program's output for slot s, or -1. The program may not hold calls or
  // sources. `may_be_unknown` says whether a value may be NaN within the part.
  void add(const Program& program, const std::vector<int>& slots, bool may_be_unknown);
  // Appends the rows of another table of the same precision. Slot s of that table is slot places[s] of this one.
  void append(const PartTable& later, const std::vector<size_t>& places);
  // The instructions of a body that some slots need.
  struct Excerpt {
    struct Line {
      Instruction in;        // operands other than inputs are numbered from the excerpt's first line
      size_t parameter = 0;  // number of its first parameter
    };
    std::vector<Line> lines;
    std::vector<ValueId> slots;  // the line of each slot; none if the slot is not wanted or does not exist
  };
  static constexpr ValueId none = ~ValueId{0};
  Excerpt excerpt(uint32_t body, const std::vector<bool>& wanted) const;  // indexed by slot
  Excerpt reach(uint32_t body) const;                                     // slot 0 only; the line may be none
  // Appends the excerpt of a part's body to `to`, with the three given values as its inputs. Sets `slots` to the value
  // of each slot, or none. `slots` may be shorter than the set's list of slots.
  void append(uint32_t part, const Excerpt& excerpt, Program& to, const std::array<ValueId, 3>& inputs,
              std::vector<ValueId>& slots) const;
  size_t size() const { return rows_.size(); }
  size_t body_count() const { return bodies_.size(); }
  const Body& body(uint32_t number) const { return bodies_[number]; }
  uint32_t body_of(uint32_t part) const { return rows_[part].body; }
  // Returns a parameter of a part. Parameters are constants and rows of maps, in the order of the body's code.
  double parameter(uint32_t part, size_t number) const;
  // Writes a parameter of each of several parts, which share one body, to `row`.
  void parameters(std::span<const uint32_t> parts, size_t number, float* row) const;
  // Returns a parameter of all parts of a body if they have the same value, else nothing.
  std::optional<double> common_parameter(uint32_t body, size_t number) const;

 private:
  struct Row {
    uint32_t body = 0, number = 0;  // position among the rows of its body
  };
  // The parameters of a body's rows. Parameters that are equal in all rows are stored once. The deque grows without
  // copying its content.
  template <class T>
  class Parameters {
   public:
    uint32_t add(const std::vector<double>& row);  // returns the row's number
    size_t per_row() const { return places_.size(); }
    bool is_common(size_t number) const { return places_[number] == common; }
    double at(uint32_t row, size_t number) const {
      const uint32_t place = places_[number];
      return static_cast<double>(place == common ? common_[number] : values_[size_t{row} * varying_.size() + place]);
    }

   private:
    static constexpr uint32_t common = ~uint32_t{0};
    void let_vary(size_t number);

    std::vector<T> common_;         // parameters of the first row
    std::vector<uint32_t> places_;  // position of each parameter among those that vary, or `common`
    std::vector<size_t> varying_;   // numbers of the parameters that vary
    std::deque<T> values_;          // row by row: the parameters that vary
    uint32_t rows_ = 0;
  };
  using ParametersOfBatch = Parameters<float>;  // rounded to float as in batches
  using ParametersOfReference = Parameters<double>;

  uint32_t body_number(const Program& program, const std::vector<int>& slots, bool may_be_unknown);
  void add_row(uint32_t body);  // adds the parameters in row_

  Precision precision_;
  std::vector<Body> bodies_;
  // One entry for each body.
  std::deque<std::variant<ParametersOfReference, ParametersOfBatch>> parameters_;
  std::unordered_map<std::string, uint32_t> known_;
  std::vector<Row> rows_;
  std::string key_;          // key of the row that is being added
  std::vector<double> row_;  // parameters of the row that is being added
};

// A box within another box, in units of 1/256 of each side, ends included.
struct Cells {
  static constexpr int per_axis = 256;
  std::array<uint8_t, 3> first{0, 0, 0}, last{per_axis - 1, per_axis - 1, per_axis - 1};

  // Returns the smallest cells around a box that intersects `whole`.
  static Cells around(const Box& box, const Box& whole);
  Box in(const Box& whole) const;
};

// A tree over the boxes of parts. The box of a part may be divided into pieces, which together contain the part.
class PartIndex {
 public:
  struct Entry {
    Box box;
    uint32_t part = 0;
  };
  // Returns the box with the precision of the index.
  static Box rounded(const Box& box);
  void expect(size_t parts, size_t pieces);
  void add(const Box& box, const std::vector<Cells>& pieces);  // adds the next part
  void append(const PartIndex& later);  // appends the parts of another index; neither may be built yet
  void build();                         // called when all parts are added
  // Returns the total volume of all pieces divided by the volume of the box around them. It exceeds 1 if many pieces
  // overlap. The index must be built.
  double filling() const;
  // Finds the parts whose pieces intersect the region, in ascending order.
  void find(const Box& region, std::vector<uint32_t>& parts) const;
  // Finds the pieces that intersect the region, sorted by part.
  void find(const Box& region, std::vector<Entry>& entries) const;
  // Returns the number of parts with pieces that intersect the region, at most `most`.
  size_t count(const Box& region, size_t most) const;
  bool reaches(const Box& region) const { return count(region, 1) > 0; }
  // Finds the pieces that intersect the region, in any order. Returns false if there are more than `most`.
  bool find_few(const Box& region, size_t most, std::vector<Entry>& entries) const;

 private:
  struct Bounds {
    float lo[3], hi[3];
    explicit Bounds(const Box& box);
    bool meets(const Box& box) const;
    Box box() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
  };
  struct TreeNode {
    Bounds bounds;
    uint32_t begin = 0, end = 0;  // range of its parts
    uint32_t right = 0;           // number of the right child (the left one follows this node); 0 for a leaf
  };
  struct Part {
    Bounds bounds;
    uint32_t number = 0;
  };
  uint32_t build(uint32_t begin, uint32_t end);
  // Calls `visit` with the number and box of each part whose box intersects the region, until it returns false.
  template <class Visit>
  void visit(const Box& region, Visit visit) const;
  // Calls `visit` for the pieces of a part. Returns false if `visit` did.
  template <class Visit>
  bool visit_pieces(const Part& part, const Box& region, Visit visit) const;

  std::vector<TreeNode> tree_;
  std::vector<Part> parts_;             // sorted by leaf once built
  std::vector<Cells> pieces_;           // sorted by part
  std::vector<uint32_t> piece_begins_;  // first piece of each part, and the end
};

struct PartSet {
  PartTable reference{Precision::reference}, batch{Precision::batch};
  PartIndex index;
  std::vector<SlotKind> slots;   // slot 0 is 1 if a part reaches the point; if not, all other slots are 0
  size_t held_slot = 0;          // the slot that is 1 if the part holds the point
  std::vector<Interval> ranges;  // range of each slot where parts reach

  // True if parts are combined from the last to the first.
  bool is_backwards() const { return std::find(slots.begin(), slots.end(), SlotKind::first) != slots.end(); }
  const PartTable& table(Precision precision) const { return precision == Precision::batch ? batch : reference; }
};

double volume(const Box& box);

// Returns the box of a part, grown by the distance that single precision may move its surface.
Box grown_for_rounding(const Box& box);

}  // namespace ombre::program
