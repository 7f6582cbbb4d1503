#include "jobs/stacks/design_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <mutex>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "jobs/stacks/fraction_windows.h"
#include "jobs/stacks/layer_difference.h"
#include "jobs/stacks/marked_layer.h"
#include "load/turned.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

using voxel::Evaluator;
using voxel::TileBox;

constexpr size_t most_explained = 16;  // layers that are told in detail

// A draw is a multiple of 2^-24, which a fraction of a float may reach or not by rounding. So a voxel in so many may
// differ although no place beside it explains that.
constexpr double voxels_for_one_draw = 1e6;

std::string place_text(const Vec3& p) {
  return "(" + format_rounded(p.x, 5) + ", " + format_rounded(p.y, 5) + ", " + format_rounded(p.z, 5) + ") mm";
}

// Returns the lattice of the whole job as the design places it: its corner is a whole number of voxels from the
// design's box, so that nothing that job.json rounds moves the voxels. Adds a finding if it is not.
voxel::Lattice placed(const Stack& stack, const Box& box, Findings& findings) {
  voxel::Lattice lattice = whole_lattice(stack.request());
  for (int axis = 0; axis < 3; ++axis) {
    const Pitch pitch = lattice.pitch[static_cast<size_t>(axis)];
    const double before = std::round((box.lo[axis] - lattice.origin[axis]) / pitch.mm());
    const double origin = box.lo[axis] - pitch.times(before);
    const auto count = static_cast<double>(lattice.count[static_cast<size_t>(axis)]);
    const auto needed = static_cast<double>(voxel::voxels_along(box.size()[axis], pitch));
    const std::string letter(1, static_cast<char>('x' + axis));
    if (std::abs(origin - lattice.origin[axis]) > 1e-6 * pitch.mm())
      findings.push_back({"place", "the design begins at " + format_rounded(box.lo[axis], 8) + " mm along " + letter +
                                       ", which is not a whole number of voxels from the stack's corner at " +
                                       format_rounded(lattice.origin[axis], 8) + " mm"});
    else
      lattice.origin[axis] = origin;
    if (before < 0 || before + needed > count)
      findings.push_back({"place", "the design is longer along " + letter +
                                       " than the stack: " + format_count(static_cast<unsigned long long>(needed)) +
                                       " voxels from number " + std::to_string(static_cast<int64_t>(before)) +
                                       " on, of " + format_count(static_cast<unsigned long long>(count))});
  }
  return lattice;
}

// The result of comparing one layer.
struct Compared {
  bool is_read = false;
  uint64_t voxels = 0, rounded = 0, diffused = 0;
  LayerDifference difference;
  uint64_t as_made = 0;                         // differing voxels that the evaluator that made the stack gives, too
  Shown diffused_layer;                         // what the images of a layer with diffused voxels show
  std::vector<voxel::ChannelPixels> fractions;  // of its materials
};

class DesignChecker {
 public:
  DesignChecker(const Stack& stack, const LayerReader& reader, const DesignVoxels& design,
                std::vector<LayerSample> samples, const CheckWork& work, DesignCheck& result)
      : stack_(stack),
        request_(stack.request()),
        reader_(reader),
        design_(design),
        samples_(std::move(samples)),
        work_(work),
        result_(result),
        reference_(design.voxels(Evaluator::reference)),
        windows_(request_.materials, reader.appearance()) {
    if (request_.evaluator != Evaluator::reference) as_made_ = design.voxels(request_.evaluator);
  }

  void run() {
    const auto produce = [&](size_t n) {
      if (work_.stop && work_.stop->requested()) throw Cancelled();
      return compare(samples_[n]);
    };
    const auto consume = [&](size_t n, Compared& layer) { take(n, layer); };
    const auto window =
        static_cast<size_t>(std::max(work_.threads, 1));  // diffused layers are kept until it is their turn
    run_ordered<Compared>(samples_.size(), work_.threads, window, produce, consume);
    judge_as_made();
    if (result_.diffused > 0) check_fractions();
    explain();
  }

 private:
  // Returns how far rounding of floats may move a boundary: some units in the last place of the largest coordinate,
  // and at most a quarter of a voxel.
  double rounding_mm(int axis) const {
    const Box box = request_.lattice.box();
    double largest = 0;
    for (int other = 0; other < 3; ++other)
      largest = std::max({largest, std::abs(box.lo[other]), std::abs(box.hi[other])});
    constexpr double units = 64, last_place = 1.2e-7;
    return std::min(units * last_place * largest, request_.lattice.pitch[static_cast<size_t>(axis)].mm() / 4);
  }

  int64_t width() const { return request_.lattice.count[0]; }
  LayerWindow whole() const { return {{0, 0}, {request_.lattice.count[0], request_.lattice.count[1]}}; }

  // Returns what a producer's voxels show in a window of a layer, channel by channel.
  std::vector<Shown> shown(const RegionProducer& voxels, int64_t layer, const LayerWindow& window) const {
    const TileBox box{{window.lo[0], window.lo[1], layer}, {window.hi[0], window.hi[1], layer + 1}};
    const std::vector<voxel::LayerResult> made = voxels(box, work_.stop);
    std::vector<Shown> channels;
    for (size_t n = 0; n < request_.channels.size(); ++n)
      channels.push_back(shown_of(made.front().channels[n], request_.channels[n].type, reader_.appearance()));
    return channels;
  }

  // Calls take(n, m) for each voxel n of the layer that lies in a window, with its number m there.
  template <class Take>
  void for_each(const LayerWindow& window, const Take& take) const {
    size_t m = 0;
    for (int64_t j = window.lo[1]; j < window.hi[1]; ++j)
      for (int64_t i = window.lo[0]; i < window.hi[0]; ++i) take(static_cast<size_t>(j * width() + i), m++);
  }

  // Returns the voxels of the layer in which the images differ from a producer.
  std::vector<size_t> differing(const std::vector<Shown>& images, const RegionProducer& voxels, int64_t layer,
                                const LayerWindow& window) const {
    const std::vector<Shown> made = shown(voxels, layer, window);
    std::vector<size_t> found;
    for_each(window, [&](size_t n, size_t m) {
      bool differs = false;
      for (size_t c = 0; c < made.size(); ++c) differs |= !is_same(images[c][n], made[c][m], request_.channels[c].type);
      if (differs) found.push_back(n);
    });
    return found;
  }

  // Shades are rounded, so that they may be off by one.
  static bool is_same(uint32_t a, uint32_t b, voxel::ChannelType type) {
    if (type == voxel::ChannelType::material || type == voxel::ChannelType::mask) return a == b;
    if (type != voxel::ChannelType::colour) return std::max(a, b) - std::min(a, b) <= 1;
    for (const int shift : {24, 16, 8, 0})
      if (std::abs(static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255)) > 1) return false;
    return true;
  }

  LayerWindow around(const std::vector<size_t>& voxels) const {
    LayerWindow window{{width(), request_.lattice.count[1]}, {0, 0}};
    for (const size_t n : voxels) {
      const std::array<int64_t, 2> at{static_cast<int64_t>(n) % width(), static_cast<int64_t>(n) / width()};
      for (size_t axis = 0; axis < 2; ++axis) {
        window.lo[axis] = std::min(window.lo[axis], at[axis]);
        window.hi[axis] = std::max(window.hi[axis], at[axis] + 1);
      }
    }
    return window;
  }

  // Returns producers of voxels beside their centres, which are made when they are first needed.
  const std::vector<RegionProducer>& beside() const {
    std::call_once(beside_is_made_, [&] {
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
          Vec3 by;
          by[axis] = side * rounding_mm(axis);
          beside_.push_back(design_.voxels(Evaluator::reference, by));
        }
    });
    return beside_;
  }

  // Removes voxels that have what the images show at a place within rounding. Returns how many.
  uint64_t remove_rounded(const std::vector<Shown>& images, int64_t layer, std::vector<size_t>& voxels) const {
    const size_t before = voxels.size();
    for (const RegionProducer& producer : beside()) {
      if (voxels.empty()) break;
      const std::vector<size_t> still = differing(images, producer, layer, around(voxels));
      std::erase_if(voxels, [&](size_t n) { return !std::ranges::binary_search(still, n); });
    }
    return before - voxels.size();
  }

  Compared compare(const LayerSample& sample) const {
    Compared result;
    result.difference.layer = sample.layer;
    const auto images = read_layer(stack_, reader_, sample.layer);
    if (!images) return result;
    result.is_read = true;
    for (const LayerWindow& window : sample.windows) {
      result.voxels += static_cast<uint64_t>((window.hi[0] - window.lo[0]) * (window.hi[1] - window.lo[1]));
      std::ranges::move(differing(*images, reference_, sample.layer, window),
                        std::back_inserter(result.difference.voxels));
    }
    std::ranges::sort(result.difference.voxels);
    if (result.difference.voxels.empty()) return result;
    if (request_.dither == voxel::Dither::diffusion && request_.has_materials())
      compare_diffused(*images, sample.layer, result);
    else
      compare_rounded(*images, sample.layer, result);
    return result;
  }

  void compare_rounded(const std::vector<Shown>& images, int64_t layer, Compared& result) const {
    std::vector<size_t>& voxels = result.difference.voxels;
    result.rounded = remove_rounded(images, layer, voxels);
    if (voxels.empty() || !as_made_) return;
    const std::vector<size_t> still = differing(images, as_made_, layer, around(voxels));
    for (const size_t n : voxels) result.as_made += std::ranges::binary_search(still, n) ? 0 : 1;
  }

  // An error that is rounded otherwise changes the voxels after it. So the shape is compared with the reference, the
  // voxels with the evaluator that made them, and the fractions with the mixture.
  void compare_diffused(const std::vector<Shown>& images, int64_t layer, Compared& result) const {
    if (!as_made_) return;
    std::vector<size_t>& voxels = result.difference.voxels;
    const uint64_t before = voxels.size();
    const Shown expected = shown(reference_, layer, whole()).front();
    std::vector<size_t> shape;
    for (const size_t n : voxels)
      if ((images.front()[n] == 0) != (expected[n] == 0)) shape.push_back(n);
    result.rounded = remove_rounded(images, layer, shape);
    voxels = differing(images, as_made_, layer, whole());
    std::ranges::move(shape, std::back_inserter(voxels));
    std::ranges::sort(voxels);
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
    if (!voxels.empty()) return;
    result.diffused = before - result.rounded;
    result.diffused_layer = images.front();
    result.fractions = fractions_of(layer);
  }

  std::vector<voxel::ChannelPixels> fractions_of(int64_t layer) const {
    const RegionProducer fractions = design_.fractions(request_.materials);
    const TileBox box{{0, 0, layer}, {request_.lattice.count[0], request_.lattice.count[1], layer + 1}};
    return std::move(fractions(box, work_.stop).front().channels);
  }

  void take(size_t n, Compared& layer) {
    result_.layers += layer.is_read ? 1 : 0;
    result_.voxels += layer.voxels;
    result_.rounded += layer.rounded;
    result_.diffused += layer.diffused;
    if (!layer.diffused_layer.empty()) windows_.add(width(), layer.diffused_layer, layer.fractions);
    if (!layer.is_read) ++unread_;
    if (layer.difference.voxels.size() == layer.as_made)
      take_as_made(layer);
    else
      differences_.push_back(std::move(layer.difference));
    if (work_.progress) work_.progress->update({n + 1, samples_.size()});
  }

  void take_as_made(Compared& layer) {
    if (layer.as_made == 0) return;
    as_made_voxels_ += layer.as_made;
    as_made_differences_.push_back(std::move(layer.difference));
  }

  // Takes voxels for rounded that the evaluator that made the stack gives, too, if they are few enough.
  void judge_as_made() {
    if (static_cast<double>(as_made_voxels_) * voxels_for_one_draw <= static_cast<double>(result_.voxels)) {
      result_.rounded += as_made_voxels_;
      return;
    }
    std::ranges::move(as_made_differences_, std::back_inserter(differences_));
    std::ranges::sort(differences_, {}, &LayerDifference::layer);
  }

  void check_fractions() {
    result_.windows = windows_.windows();
    if (const auto material = windows_.misfit())
      result_.findings.push_back({"fractions", "the numbers of voxels of " + *material + " in " +
                                                   format_count(windows_.windows()) +
                                                   " windows do not fit its fractions (chi square, level 1e-6)"});
  }

  std::string look_text(uint32_t look, const voxel::Channel& channel) const {
    if (look == shows_nothing) return "nothing of the job";
    if (channel.type != voxel::ChannelType::material) return std::to_string(look);
    if (look == 0) return "void";
    for (const SliceMaterial& material : request_.materials)
      if (material.id == look) return material.name;
    return "a material that job.json does not list";
  }

  // Says of each layer what differs, and of the worst ones why, with a picture.
  void explain() {
    if (unread_ > 0)
      result_.unchecked.push_back(format_count(unread_) + " layers have no images that can be read, and were not " +
                                  "compared with the design");
    find_worst();
    for (LayerDifference& difference : differences_) {
      const size_t count = difference.voxels.size();
      const std::string text = "layer " + std::to_string(difference.layer) + " has " + format_count(count) +
                               (count == 1 ? " voxel" : " voxels") + " that the design does not give";
      difference.finding = {"voxels", text, difference.layer};
      if (std::ranges::binary_search(worst_, difference.layer)) explain(difference);
      result_.findings.push_back(difference.finding);
    }
  }

  void find_worst() {
    std::vector<std::pair<size_t, int64_t>> sizes;
    for (const LayerDifference& difference : differences_)
      sizes.emplace_back(difference.voxels.size(), difference.layer);
    std::ranges::sort(sizes, std::greater());
    for (size_t n = 0; n < sizes.size() && n < most_explained; ++n) worst_.push_back(sizes[n].second);
    std::ranges::sort(worst_);
  }

  void explain(LayerDifference& difference) {
    const auto images = read_layer(stack_, reader_, difference.layer);
    const std::vector<Shown> expected = shown(reference_, difference.layer, whole());
    const size_t first = difference.voxels.front();
    const auto i = static_cast<int64_t>(first) % width(), j = static_cast<int64_t>(first) / width();
    for (size_t c = 0; c < expected.size(); ++c) {
      if ((*images)[c][first] == expected[c][first]) continue;
      difference.finding.text += "; the first is voxel (" + std::to_string(i) + ", " + std::to_string(j) + ") at " +
                                 place_text(request_.lattice.center(i, j, difference.layer)) + ", which shows " +
                                 look_text((*images)[c][first], request_.channels[c]) + " in place of " +
                                 look_text(expected[c][first], request_.channels[c]);
      break;
    }
    double changes = static_cast<double>(images->front().size());
    if (request_.has_materials() && request_.dither != voxel::Dither::threshold) {
      FractionWindows windows(request_.materials, reader_.appearance());
      windows.add(width(), images->front(), fractions_of(difference.layer));
      changes = windows.expected_changes();
    }
    const auto expected_layer = [&](int64_t layer) { return shown(reference_, layer, whole()).front(); };
    const LikelyCause cause =
        likely_cause(images->front(), expected.front(), width(), others(difference.layer), expected_layer, changes);
    difference.finding.kind = cause.kind;
    if (!cause.text.empty()) difference.finding.text += "; " + cause.text;
    add_picture(difference, images->front());
  }

  // Returns layers that may have been taken for this one: those that differ, too, and its neighbours.
  std::vector<int64_t> others(int64_t layer) const {
    std::vector<int64_t> list;
    for (const int64_t neighbour : {layer - 1, layer + 1})
      if (neighbour >= 0 && neighbour < request_.lattice.count[2]) list.push_back(neighbour);
    for (const int64_t other : worst_)
      if (std::abs(other - layer) > 1) list.push_back(other);
    return list;
  }

  void add_picture(const LayerDifference& difference, const Shown& images) {
    std::vector<uint8_t> flags(images.size());
    for (const size_t n : difference.voxels) flags[n] = 1;
    const auto colour = [&](size_t n) -> formats::Rgba {
      for (const SliceMaterial& material : request_.materials)
        if (material.id == images[n]) return material.rgba;
      const auto alpha = static_cast<uint8_t>(images[n] == 0 ? 0 : 255);
      return {128, 128, 128, alpha};
    };
    result_.pictures.push_back(
        {"layer " + std::to_string(difference.layer), marked_layer(request_.lattice, colour, flags)});
  }

  const Stack& stack_;
  const SliceRequest& request_;
  const LayerReader& reader_;
  const DesignVoxels& design_;
  std::vector<LayerSample> samples_;
  const CheckWork& work_;
  DesignCheck& result_;
  RegionProducer reference_, as_made_;  // the latter is empty where the reference made the stack
  mutable std::once_flag beside_is_made_;
  mutable std::vector<RegionProducer> beside_;
  FractionWindows windows_;
  std::vector<LayerDifference> differences_, as_made_differences_;
  uint64_t as_made_voxels_ = 0;
  std::vector<int64_t> worst_;  // layers with the most differing voxels, ascending
  uint64_t unread_ = 0;
};

void compare_hash(const Stack& stack, const LoadedPtr& loaded, Findings& findings) {
  const std::string hash = design::hash(loaded->design).hex(), stated = stack.request().design_hash;
  const std::string remedy = stack.request().resolved.empty()
                                 ? ""
                                 : "; the job resolved its properties, and ombre resolve -o writes that design";
  if (hash != stated)
    findings.push_back({"design", loaded->path + " is another design than that of the job: its hash is " + hash +
                                      ", not " + stated + remedy});
}

// Compares the materials of job.json with those of the design.
void compare_materials(const Stack& stack, const design::Design& design, const std::vector<SliceMaterial>& possible,
                       Findings& findings) {
  for (const SliceMaterial& listed : stack.request().materials) {
    const design::Material* there = design.materials.find(listed.name);
    if (!there || there->id != listed.id ||
        std::ranges::find(possible, listed.id, &SliceMaterial::id) == possible.end())
      findings.push_back({"materials", "the design has no material " + listed.name + " with the number " +
                                           std::to_string(listed.id) + ", which job.json lists"});
    else if (there->colour != listed.rgba)
      findings.push_back({"materials", listed.name + " has another colour in the design than in job.json"});
  }
}

// Says how much of the stack is compared.
std::string share_text(double sampled, const voxel::Lattice& lattice, size_t layers) {
  return format_rounded(100 * sampled / static_cast<double>(lattice.voxels()), 3) + " % of the voxels, in " +
         format_count(layers) + " of " + format_count(static_cast<unsigned long long>(lattice.count[2])) +
         " layers, are evaluated again; a fault elsewhere that fits the journal is not seen";
}

}  // namespace

std::optional<DesignCheck> check_design(const Stack& stack, const LayerReader& reader, const LoadedPtr& loaded,
                                        LayerRange layers, const SampleChoice& choice, const CheckWork& work,
                                        Diagnostics& diagnostics) {
  const auto box = design_box(loaded->design, diagnostics);
  if (!box) return std::nullopt;
  DesignCheck result;
  compare_hash(stack, loaded, result.findings);
  const voxel::Lattice whole = placed(stack, *box, result.findings);
  const StageLoan loan{work.threads, work.memory_bytes, work.progress, work.stop};
  const auto design = DesignVoxels::make(loaded, stack.request(), whole, loan, diagnostics);
  if (!design) return std::nullopt;
  compare_materials(stack, loaded->design, design->materials(), result.findings);
  SampleChoice chosen = choice;
  chosen.whole_layers = stack.request().dither == voxel::Dither::diffusion && stack.request().has_materials();
  std::vector<LayerSample> samples = choose_samples(stack.request().lattice, layers, chosen);
  double sampled = 0;
  for (const LayerSample& sample : samples)
    for (const LayerWindow& window : sample.windows)
      sampled += static_cast<double>((window.hi[0] - window.lo[0]) * (window.hi[1] - window.lo[1]));
  if (sampled < static_cast<double>(stack.request().lattice.voxels()))
    result.unchecked.push_back(share_text(sampled, stack.request().lattice, samples.size()));
  DesignChecker(stack, reader, *design, std::move(samples), work, result).run();
  return result;
}

}  // namespace ombre::compile
