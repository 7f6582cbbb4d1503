// Many parts of a few kinds as one op: tables of parameters and an index in space.
//
// A union of thousands of solids is not written out op by op. Each solid is a row: the number of a
// body, which is a program without its constants, and the constants. An op `parts` stands for a value
// that combines all rows; before evaluation in a region it is replaced by the code of those that reach
// the region (passes/expand_parts.cpp), so that space decides what a tile costs, not the number of parts.
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

// How the parts' values of one slot combine.
enum class SlotKind : uint8_t {
  any,    // is it 1 in some part?
  sum,    // in the order of the parts
  first,  // of the first part that holds the point
  last,   // of the last part that holds the point
};

// Rows of one form of the programs.
class PartTable {
 public:
  // A program without the values of its constants.
  struct Body {
    Program code;            // its constants and maps are of no meaning
    std::vector<int> slots;  // as in `add`
    bool may_be_unknown = false;
    size_t input_count = 0;  // the first instructions
  };

  explicit PartTable(Precision precision) : precision_(precision) {}
  void expect(size_t rows) { rows_.reserve(rows); }
  // `slots[s]` is the program's output for slot s, or -1. The program has neither calls nor sources.
  // `may_be_unknown`: can any of its values be NaN where the part is?
  void add(const Program& program, const std::vector<int>& slots, bool may_be_unknown);
  // The rows of another table of the same precision, whose slot s is slot places[s] here.
  void append(const PartTable& later, const std::vector<size_t>& places);
  // What of a body some slots need.
  struct Excerpt {
    struct Line {
      Instruction in;        // its operands count from the excerpt's first line, if they are no inputs
      size_t parameter = 0;  // number of its first one
    };
    std::vector<Line> lines;
    std::vector<ValueId> slots;  // the line of each slot; none if it is not wanted, or not there
  };
  static constexpr ValueId none = ~ValueId{0};
  Excerpt excerpt(uint32_t body, const std::vector<bool>& wanted) const;  // by slot
  Excerpt reach(uint32_t body) const;                                     // slot 0, and it may be none
  // Appends the excerpt of a part's body to `to`; its inputs are the three given values. `slots` gets the value of
  // each slot, or none; it may be shorter than the set's slots.
  void append(uint32_t part, const Excerpt& excerpt, Program& to, const std::array<ValueId, 3>& inputs,
              std::vector<ValueId>& slots) const;
  size_t size() const { return rows_.size(); }
  size_t body_count() const { return bodies_.size(); }
  const Body& body(uint32_t number) const { return bodies_[number]; }
  uint32_t body_of(uint32_t part) const { return rows_[part].body; }
  // Constants and rows of maps, in the order of the body's code.
  double parameter(uint32_t part, size_t number) const;
  // Of parts of one body, in a row.
  void parameters(std::span<const uint32_t> parts, size_t number, float* row) const;
  // Of all parts of a body, if they have it in common.
  std::optional<double> common_parameter(uint32_t body, size_t number) const;

 private:
  struct Row {
    uint32_t body = 0, number = 0;  // among the rows of its body
  };
  // The parameters of a body's rows, as far as they differ: many are equal in all of them. A deque grows without a
  // copy of what it holds.
  template <class T>
  class Parameters {
   public:
    uint32_t add(const std::vector<double>& row);  // its number
    size_t per_row() const { return places_.size(); }
    bool is_common(size_t number) const { return places_[number] == common; }
    double at(uint32_t row, size_t number) const {
      const uint32_t place = places_[number];
      return static_cast<double>(place == common ? common_[number] : values_[size_t{row} * varying_.size() + place]);
    }

   private:
    static constexpr uint32_t common = ~uint32_t{0};
    void let_vary(size_t number);

    std::vector<T> common_;         // by number, of the first row
    std::vector<uint32_t> places_;  // by number: among those that vary, or `common`
    std::vector<size_t> varying_;   // numbers
    std::deque<T> values_;          // row by row, of those that vary
    uint32_t rows_ = 0;
  };
  using ParametersOfBatch = Parameters<float>;  // as batches round them
  using ParametersOfReference = Parameters<double>;

  uint32_t body_number(const Program& program, const std::vector<int>& slots, bool may_be_unknown);
  void add_row(uint32_t body);  // of the parameters in row_

  Precision precision_;
  std::vector<Body> bodies_;
  // By body.
  std::deque<std::variant<ParametersOfReference, ParametersOfBatch>> parameters_;
  std::unordered_map<std::string, uint32_t> known_;
  std::vector<Row> rows_;
  std::string key_;          // of the row being added
  std::vector<double> row_;  // its parameters
};

// A box in 256ths of another one, ends included.
struct Cells {
  static constexpr int per_axis = 256;
  std::array<uint8_t, 3> first{0, 0, 0}, last{per_axis - 1, per_axis - 1, per_axis - 1};

  // The least ones around a box that meets `whole`.
  static Cells around(const Box& box, const Box& whole);
  Box in(const Box& whole) const;
};

// A tree over the boxes of parts. A part's box may be cut into pieces, which together hold the part.
class PartIndex {
 public:
  struct Entry {
    Box box;
    uint32_t part = 0;
  };
  // The box as the index keeps it.
  static Box rounded(const Box& box);
  void expect(size_t parts, size_t pieces);
  void add(const Box& box, const std::vector<Cells>& pieces);  // the next part
  void append(const PartIndex& later);                         // its parts, before either is built
  void build();                                                // when all are added
  // Once built: the volume of all pieces, as a share of that of the box around them. Above 1 where many lie in others.
  double filling() const;
  // The parts whose pieces meet the region, in ascending order.
  void find(const Box& region, std::vector<uint32_t>& parts) const;
  // Their pieces, by part.
  void find(const Box& region, std::vector<Entry>& entries) const;
  // How many parts have pieces that meet the region, or `most` if it is more.
  size_t count(const Box& region, size_t most) const;
  bool reaches(const Box& region) const { return count(region, 1) > 0; }
  // The pieces that meet the region, in any order, unless they are more than `most`: false.
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
    uint32_t begin = 0, end = 0;  // of its parts
    uint32_t right = 0;           // the left one follows; 0: a leaf
  };
  struct Part {
    Bounds bounds;
    uint32_t number = 0;
  };
  uint32_t build(uint32_t begin, uint32_t end);
  // `visit` gets the boxes and numbers of parts whose boxes meet the region, until it says false.
  template <class Visit>
  void visit(const Box& region, Visit visit) const;
  // The same for the pieces of a part; false where `visit` said so.
  template <class Visit>
  bool visit_pieces(const Part& part, const Box& region, Visit visit) const;

  std::vector<TreeNode> tree_;
  std::vector<Part> parts_;             // once built, by leaf
  std::vector<Cells> pieces_;           // by number of the part
  std::vector<uint32_t> piece_begins_;  // by number of the part, and an end
};

struct PartSet {
  PartTable reference{Precision::reference}, batch{Precision::batch};
  PartIndex index;
  std::vector<SlotKind> slots;   // slot 0: does a part reach the point? Else its other slots are 0
  size_t held_slot = 0;          // does it hold the point?
  std::vector<Interval> ranges;  // of each slot, wherever parts reach

  // Are parts combined from the last to the first?
  bool is_backwards() const { return std::find(slots.begin(), slots.end(), SlotKind::first) != slots.end(); }
  const PartTable& table(Precision precision) const { return precision == Precision::batch ? batch : reference; }
};

double volume(const Box& box);

// The box of a part, grown by what rounding in single precision can move its surface.
Box grown_for_rounding(const Box& box);

}  // namespace ombre::program
