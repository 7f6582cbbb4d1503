#include "fea/files/calculix.h"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/system/other_program.h"
#include "base/system/tasks.h"
#include "base/system/temporary_folder.h"
#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::fea {
namespace {

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Returns the lines in which the program tells of its failure, or else its last ones.
std::string words_of_failure(const std::string& log) {
  const size_t error = log.find("*ERROR");
  std::string words =
      error != std::string::npos ? log.substr(error, 300) : log.substr(log.size() - std::min<size_t>(log.size(), 300));
  std::string line;
  for (const char c : words) {
    const bool is_space = c == '\n' || c == ' ' || c == '\t' || c == '\r';
    if (!is_space)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  return line.empty() ? "it said nothing" : "it said: " + line;
}

// Runs ccx on job.inp in the folder; its output goes to job.log.
void run_program(const TemporaryFolder& folder, int threads, const StopFlag* stop) {
  const std::string log = folder.file("job.log");
  // The program writes files of its own into the working folder.
  const OtherProgram program{{"ccx", "-i", "job"},
                             folder.path(),
                             log,
                             {{"OMP_NUM_THREADS", std::to_string(threads > 0 ? threads : core_count())}},
                             SIGKILL};
  const auto status = program.run(stop);
  if (!status)
    throw Error(Code::other_program, "there is no program ccx: install CalculiX (calculix-ccx), or solve without " +
                                         spelled::option("--solver", "calculix"));
  const std::string words = text_of_file(log);
  // The exit code of ccx is not used, since it is 0 even for some failures.
  if (WIFSIGNALED(*status))
    throw Error(Code::other_program, "CalculiX was ended by signal " + std::to_string(WTERMSIG(*status)) +
                                         (WTERMSIG(*status) == SIGKILL ? ", perhaps since memory ran out" : "") + "; " +
                                         words_of_failure(words));
  if (words.find("Job finished") == std::string::npos)
    throw Error(Code::other_program, "CalculiX did not finish; " + words_of_failure(words));
}

// Reads the numbers of a line, and returns how many there are.
size_t numbers_in(std::string_view line, std::array<double, 8>& numbers) {
  size_t count = 0;
  const char *at = line.data(), *const end = at + line.size();
  while (count < numbers.size()) {
    while (at < end && *at == ' ') ++at;
    if (at == end) break;
    const auto [next, failure] = std::from_chars(at, end, numbers[count]);
    if (failure != std::errc())
      throw Error(Code::other_program, "CalculiX gave a result that is no number: " + std::string(line));
    ++count;
    at = next;
  }
  return count;
}

size_t place_of(double number, size_t count, std::string_view line) {
  if (!(number >= 1 && number <= static_cast<double>(count)))
    throw Error(Code::other_program, "CalculiX gave a result for what there is not: " + std::string(line));
  return static_cast<size_t>(number) - 1;
}

template <size_t size>
void read_node(std::string_view line, size_t count, std::vector<std::array<double, size>>& values) {
  std::array<double, 8> numbers{};
  if (numbers_in(line, numbers) < size + 1)
    throw Error(Code::other_program, "CalculiX gave too few results: " + std::string(line));
  values.resize(count);
  std::copy_n(numbers.begin() + 1, size, values[place_of(numbers[0], count, line)].begin());
}

// Sums of a tensor over an element's points.
template <size_t size>
void read_point(std::string_view line, size_t count, std::vector<std::array<double, size>>& values,
                std::vector<double>& points) {
  std::array<double, 8> numbers{};
  if (numbers_in(line, numbers) < size + 2)
    throw Error(Code::other_program, "CalculiX gave too few results: " + std::string(line));
  values.resize(count);
  points.resize(count);
  const size_t element = place_of(numbers[0], count, line);
  ++points[element];
  for (size_t n = 0; n < size; ++n) values[element][n] += numbers[n + 2];
}

template <size_t size>
void divide(std::vector<std::array<double, size>>& values, const std::vector<double>& points) {
  for (size_t n = 0; n < values.size(); ++n) {
    if (points[n] == 0)
      throw Error(Code::other_program, "CalculiX gave no result for element " + std::to_string(n + 1));
    for (double& value : values[n]) value /= points[n];
  }
}

// Reorders the components xx, yy, zz, xy, xz, yz to our order: xx, yy, zz, xy, yz, zx.
std::array<double, 6> in_order(const std::array<double, 6>& c) { return {c[0], c[1], c[2], c[3], c[5], c[4]}; }

// Runs the program in a temporary folder, which is removed at the end, and reads its results.
PrintedResults results_of(const ModelView& model, const Conditions& conditions, const CalculixOptions& options,
                          const StopFlag* stop) {
  refuse_inverted(model.mesh);
  const TemporaryFolder folder;
  {
    std::ofstream deck(folder.file("job.inp"), std::ios::binary);
    write_inp(
        model, conditions, options.type, "ombre",
        [&](std::string_view bytes) { deck.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); }, true);
    deck.close();
    if (!deck) throw Error(Code::cannot_write, "the deck cannot be written to " + folder.file("job.inp"));
  }
  run_program(folder, options.threads, stop);
  return read_printed(text_of_file(folder.file("job.dat")), model.mesh.node_count(), model.mesh.count());
}

[[noreturn]] void fail_without(const char* what) {
  throw Error(Code::other_program,
              std::string("CalculiX finished without ") + what + "; its equations may have no solution");
}

}  // namespace

PrintedResults read_printed(const std::string& text, size_t nodes, size_t elements) {
  PrintedResults found;
  std::vector<double> stress_points, strain_points, flux_points;
  std::vector<std::array<double, 1>> temperatures, heat;
  std::function<void(std::string_view)> take;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    const size_t first = line.find_first_not_of(' ');
    if (first == std::string_view::npos) continue;
    const char c = line[first];
    if (c == '-' || (c >= '0' && c <= '9')) {
      if (take) take(line);
      continue;
    }
    const std::string_view title = line.substr(first);
    take = nullptr;
    if (title.starts_with("displacements"))
      take = [&](std::string_view l) { read_node(l, nodes, found.displacements); };
    else if (title.starts_with("forces"))
      take = [&](std::string_view l) { read_node(l, nodes, found.forces); };
    else if (title.starts_with("temperatures"))
      take = [&](std::string_view l) { read_node(l, nodes, temperatures); };
    else if (title.starts_with("heat generation"))
      take = [&](std::string_view l) { read_node(l, nodes, heat); };
    else if (title.starts_with("stresses"))
      take = [&](std::string_view l) { read_point(l, elements, found.stresses, stress_points); };
    else if (title.starts_with("strains"))
      take = [&](std::string_view l) { read_point(l, elements, found.strains, strain_points); };
    else if (title.starts_with("heat flux"))
      take = [&](std::string_view l) { read_point(l, elements, found.fluxes, flux_points); };
  }
  divide(found.stresses, stress_points);
  divide(found.strains, strain_points);
  divide(found.fluxes, flux_points);
  for (const auto& [value] : temperatures) found.temperatures.push_back(value);
  for (const auto& [value] : heat) found.heat.push_back(value);
  return found;
}

// Returns the share of an element that is filled. In the deck, the stress of a cut brick's material is spread over the
// whole brick.
static double share_of(const MeshView& mesh, size_t element) {
  return mesh.bricks() ? mesh.bricks()->share(element) : 1;
}

Solution solve_by_calculix(const ModelView& model, const Conditions& conditions, const CalculixOptions& options,
                           const StopFlag* stop) {
  const PrintedResults results = results_of(model, conditions, options, stop);
  if (results.displacements.empty() || results.forces.empty()) fail_without("displacements");
  if (results.stresses.empty() || results.strains.empty()) fail_without("stresses");
  Solution solution;
  for (size_t n = 0; n < results.displacements.size(); ++n) {
    const auto &u = results.displacements[n], &f = results.forces[n];
    if (!std::isfinite(u[0] + u[1] + u[2])) fail_without("finite displacements");
    solution.displacement_mm.push_back({u[0], u[1], u[2]});
    for (size_t axis = 0; axis < 3; ++axis) solution.energy_mj += 0.5 * u[axis] * f[axis];
  }
  std::vector<double> loads(3 * model.mesh.node_count());
  for (const Prescribed& force : conditions.forces) loads[3 * size_t{force.node} + force.axis] = force.value;
  for (const Prescribed& held : conditions.displacements)
    solution.reactions_n.push_back(
        {held.node, held.axis, results.forces[held.node][held.axis] - loads[3 * size_t{held.node} + held.axis]});
  for (size_t n = 0; n < results.stresses.size(); ++n) {
    solution.stress_mpa.push_back(in_order(results.stresses[n]));
    for (double& stress : solution.stress_mpa.back()) stress /= share_of(model.mesh, n);
  }
  for (const auto& tensor : results.strains) {
    auto strain = in_order(tensor);
    for (size_t n = 3; n < 6; ++n) strain[n] *= 2;  // engineering shear
    solution.strain.push_back(strain);
  }
  return solution;
}

Conduction conduct_by_calculix(const ModelView& model, const Conditions& conditions, const CalculixOptions& options,
                               const StopFlag* stop) {
  constexpr double milli = 1e-3;
  const PrintedResults results = results_of(model, conditions, options, stop);
  if (results.temperatures.empty() || results.heat.empty()) fail_without("temperatures");
  if (results.fluxes.empty()) fail_without("fluxes");
  Conduction found;
  found.value = results.temperatures;
  for (const double value : found.value)
    if (!std::isfinite(value)) fail_without("finite temperatures");
  std::vector<double> flows(model.mesh.node_count());
  for (const Prescribed& flow : conditions.forces) flows[flow.node] = flow.value;
  for (const Prescribed& held : conditions.displacements)
    found.flows.push_back({held.node, 0, milli * results.heat[held.node] - flows[held.node]});
  // Heat that does not leave at prescribed temperatures leaves through films.
  for (const Prescribed& flow : found.flows) found.lost_w += flow.value;
  for (const double flow : flows) found.lost_w += flow;
  if (conditions.films.empty()) found.lost_w = 0;
  for (size_t n = 0; n < results.fluxes.size(); ++n) {
    const auto& flux = results.fluxes[n];
    found.flux.push_back((milli / share_of(model.mesh, n)) * Vec3{flux[0], flux[1], flux[2]});
  }
  return found;
}

}  // namespace ombre::fea
