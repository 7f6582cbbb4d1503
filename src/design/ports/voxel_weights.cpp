#include "design/ports/voxel_weights.h"

#include <cmath>

#include "base/text/text.h"

namespace ombre::design {
namespace {

constexpr size_t most_along = 1000, most_weights = 1'000'000;
constexpr const char* example = "write for example [[[1, 2, 1]]]: lists along x of lists along y of lists along z";

// Returns the depth of nested lists, following the first element of each.
int nesting(const Data& data) {
  int depth = 0;
  for (const Data* at = &data; at->list() && !at->list()->empty(); at = &at->list()->front()) ++depth;
  return depth;
}

class KernelReader {
 public:
  KernelReader(const Reader& reader, Kernel& kernel) : reader_(reader), kernel_(kernel) {}

  bool read(const Data& data) {
    const int depth = nesting(data);
    if (depth != 3 && depth != 2) return reader_.fail(data, "weights in lists of lists of lists", example);
    kernel_ = {{0, 0, 1}, {}};
    return take(data, 0, static_cast<size_t>(depth)) && check(data);
  }

 private:
  bool take(const Data& data, size_t level, size_t depth) {
    if (level == depth) return take_weight(data);
    const DataList* list = data.list();
    if (!list || list->empty()) return reader_.fail(data, "a list of weights", example);
    int& count = kernel_.size[level];
    if (list->size() > most_along) return reader_.fail(data, "at most 1000 weights along an axis");
    if (count == 0 || is_first_[level]) count = static_cast<int>(list->size());
    is_first_[level] = false;
    if (static_cast<size_t>(count) != list->size())
      return reader_.fail(data, "a list of " + std::to_string(count) + ", as the first one has",
                          "all lists of a level have the same length");
    for (const Data& element : *list)
      if (!take(element, level + 1, depth)) return false;
    return true;
  }

  bool take_weight(const Data& data) {
    const double* number = data.number();
    if (!number || !std::isfinite(*number)) return reader_.fail(data, "a finite number as weight");
    if (kernel_.weights.size() >= most_weights) return reader_.fail(data, "at most 1000000 weights");
    kernel_.weights.push_back(*number);
    return true;
  }

  bool check(const Data& data) const {
    double sum = 0, size = 0;
    for (const double weight : kernel_.weights) {
      sum += weight;
      size += std::abs(weight);
    }
    if (size == 0) return reader_.fail(data, "a kernel with a weight that is not 0");
    if (sum < 0) return reader_.fail(data, "weights whose sum is not negative", "their sum is " + format_number(sum));
    return true;
  }

  const Reader& reader_;
  Kernel& kernel_;
  std::array<bool, 3> is_first_{true, true, true};
};

}  // namespace

bool Port<Kernel>::read(const Data& data, const Domain&, Kernel& value, const Reader& reader) {
  return KernelReader(reader, value).read(data);
}

Data Port<Kernel>::write(const Kernel& value, bool) {
  DataList planes;
  size_t n = 0;
  for (int i = 0; i < value.size[0]; ++i) {
    DataList rows;
    for (int j = 0; j < value.size[1]; ++j) {
      DataList row;
      for (int k = 0; k < value.size[2]; ++k) row.emplace_back(value.weights[n++]);
      rows.emplace_back(std::move(row));
    }
    planes.emplace_back(std::move(rows));
  }
  return Data(std::move(planes));
}

}  // namespace ombre::design
