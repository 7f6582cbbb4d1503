// Parameters that are whole numbers.
#include <algorithm>
#include <cmath>

#include "design/values.h"

namespace ombre::design {

bool read(const Data& data, const Domain& domain, int& value, const Reader& reader) {
  const int least = static_cast<int>(std::max(domain.least, -1e9)),
            greatest = static_cast<int>(std::min(domain.greatest, 1e9));
  const double* number = data.number();
  // Accepts rounding errors: a quotient such as 0.3 / 0.1 is nearly whole.
  constexpr double noise = 1e-9;
  const double whole = number ? std::round(*number) : 0;
  if (!number || !(std::abs(*number - whole) <= noise) || whole < least || whole > greatest)
    return reader.fail(data, "a whole number from " + std::to_string(least) + " to " + std::to_string(greatest), {},
                       data.number() ? Code::parameter_range : Code::parameter_type);
  value = static_cast<int>(whole);
  return true;
}

bool read(const Data& data, const Domain& domain, Counts3& value, const Reader& reader) {
  const DataList* list = data.list();
  if (!list || list->size() != 3) return reader.fail(data, "three whole numbers (x, y, z)");
  bool good = true;
  for (size_t axis = 0; axis < 3; ++axis) good = read((*list)[axis], domain, value[axis], reader) && good;
  return good;
}

Data write(int value, bool) { return Data(static_cast<double>(value)); }
Data write(const Counts3& value, bool h) {
  return Data(DataList{write(value[0], h), write(value[1], h), write(value[2], h)});
}

}  // namespace ombre::design
