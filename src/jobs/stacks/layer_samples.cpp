#include "jobs/stacks/layer_samples.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace ombre::compile {
namespace {

constexpr int64_t window_voxels = 128;  // along x and y

class SampleChooser {
 public:
  SampleChooser(const voxel::Lattice& lattice, LayerRange layers, const SampleChoice& choice)
      : count_(lattice.count), layers_(layers), choice_(choice), random_(choice.seed), left_(choice.voxels) {}

  std::vector<LayerSample> run() {
    const double layer = static_cast<double>(count_[0]) * static_cast<double>(count_[1]);
    const bool takes_all = choice_.all || layer * static_cast<double>(layers_.end - layers_.begin) <= left_;
    for (int64_t k = layers_.begin; takes_all && k < layers_.end; ++k) take_layer(k);
    if (takes_all) return list();
    for (const int64_t border : choice_.borders)
      for (const int64_t k : {border - 1, border})
        if (k >= layers_.begin && k < layers_.end) take_layer(k);
    const double for_layers = choice_.whole_layers ? left_ : left_ / 2;
    for (double used = 0; used + layer <= for_layers; used += layer) take_layer(any_layer());
    if (choice_.whole_layers && samples_.empty()) take_layer(any_layer());
    if (!choice_.whole_layers) take_windows();
    return list();
  }

 private:
  int64_t below(int64_t limit) { return static_cast<int64_t>(random_() % static_cast<uint64_t>(limit)); }

  int64_t any_layer() { return layers_.begin + below(layers_.end - layers_.begin); }

  void take_layer(int64_t k) {
    if (!whole_.insert(k).second) return;
    samples_[k] = {{{0, 0}, {count_[0], count_[1]}}};
    left_ -= static_cast<double>(count_[0]) * static_cast<double>(count_[1]);
  }

  void take_windows() {
    constexpr int most_tries = 10'000;
    for (int tries = 0; left_ > 0 && tries < most_tries; ++tries) {
      const int64_t k = any_layer();
      const int64_t i = below(count_[0]) / window_voxels * window_voxels;
      const int64_t j = below(count_[1]) / window_voxels * window_voxels;
      if (whole_.contains(k) || !windows_.insert({k, i, j}).second) continue;
      const LayerWindow window{{i, j},
                               {std::min(i + window_voxels, count_[0]), std::min(j + window_voxels, count_[1])}};
      samples_[k].push_back(window);
      left_ -= static_cast<double>((window.hi[0] - i) * (window.hi[1] - j));
    }
  }

  std::vector<LayerSample> list() const {
    std::vector<LayerSample> samples;
    for (const auto& [layer, windows] : samples_) samples.push_back({layer, windows});
    return samples;
  }

  std::array<int64_t, 3> count_;
  LayerRange layers_;
  const SampleChoice& choice_;
  std::mt19937_64 random_;
  double left_;
  std::set<int64_t> whole_;
  std::set<std::array<int64_t, 3>> windows_;
  std::map<int64_t, std::vector<LayerWindow>> samples_;
};

}  // namespace

std::vector<LayerSample> choose_samples(const voxel::Lattice& lattice, LayerRange layers, const SampleChoice& choice) {
  return SampleChooser(lattice, layers, choice).run();
}

}  // namespace ombre::compile
