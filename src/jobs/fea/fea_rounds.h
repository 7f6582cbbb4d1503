// Rounds of a simulation whose results the design reads: their differences and their history.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/fea/fea_job.h"

namespace ombre::jobs {

// The elements of a round, and their materials, by which rounds are compared.
struct RoundModel {
  size_t elements = 0, nodes = 0;
  std::vector<fea::ValueField> fields;
  std::vector<std::pair<std::string, double>> shares;  // shares of materials by volume
};
RoundModel round_model_of(const fea::ModelView& model);

// Returns the greatest change of a fraction, or of another field as a share of its greatest number. Returns nothing if
// the elements or fields are different ones.
std::optional<double> change_between(const RoundModel& before, const RoundModel& now);

// Returns "seat_3.vtu" for the third round of "seat.vtu".
std::string path_of_round(const std::string& path, int round);

// A table of comma-separated values with a line for each round; unknown values are empty.
class RoundHistory {
 public:
  void add(int round, const RoundModel& model, std::optional<double> change, fea::Physics physics,
           const compile::FeaResults& results);
  std::string text() const;

 private:
  using Cells = std::vector<std::pair<std::string, std::string>>;  // values by the names of columns
  std::vector<Cells> rows_;
};

}  // namespace ombre::jobs
