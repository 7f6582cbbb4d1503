// Runs small jobs in folders of their own, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/test_errors.h"
#include "formats/containers/file.h"
#include "jobs/slice/slice.h"

namespace ombre::compile {

namespace fs = std::filesystem;
using Contents = std::map<std::string, std::string>;

// A test with a folder of its own.
class Slice : public testing::Test {
 protected:
  Slice() {
    std::string name = (fs::temp_directory_path() / "ombre_slice_XXXXXX").string();
    root_ = ::mkdtemp(name.data());
  }
  ~Slice() override {
    std::error_code ignored;
    fs::permissions(root_, fs::perms::owner_all, ignored);
    fs::remove_all(root_, ignored);
  }

  std::string folder(const std::string& name = "job") const { return (root_ / name).string(); }

  SliceOptions options(FolderUse use = FolderUse::fresh, int threads = 2) const {
    SliceOptions options;
    options.folder = folder();
    options.use = use;
    options.threads = threads;
    return options;
  }

  fs::path root_;
};

inline SliceRequest ball_request() {
  SliceRequest request;
  request.program = "ombre test";
  request.design_hash = "0123456789abcdef0123456789abcdef";
  request.printer = "generic";
  request.lattice = {{-2, -2, -2}, {Pitch{1, 10}, Pitch{1, 5}, Pitch{1, 10}}, {40, 20, 40}};
  request.materials = {{"red", 1, {255, 0, 0, 255}}, {"blue", 5, {0, 0, 255, 255}}};
  request.check_texts = {"the core is hot"};
  return request;
}

// Returns a layer of a ball with one material in each half, whose lowest and highest layers are empty. Voxels near its
// centre fail the check.
inline voxel::LayerResult ball_layer(const SliceRequest& request, int64_t k, bool with_checks) {
  voxel::LayerResult result;
  result.checks.resize(request.check_texts.size());
  const auto& lattice = request.lattice;
  RunLayer& runs = std::get<RunLayer>(result.channels.emplace_back(RunLayer(static_cast<uint32_t>(lattice.count[0]))));
  for (int64_t j = 0; j < lattice.count[1]; ++j) {
    for (int64_t i = 0; i < lattice.count[0]; ++i) {
      const Vec3 p = lattice.center(i, j, k);
      const MaterialId id = length(p) > 1.7 ? 0 : p.x < 0.3 * p.z ? 1 : 5;
      runs.add_uniform(id, 1);
      if (!with_checks || length(p) > 0.3) continue;
      if (result.checks[0].count++ == 0) result.checks[0].first = {i, j, k};
    }
    runs.end_row();
  }
  return result;
}

inline LayerProducer ball(const SliceRequest& request, bool with_checks = true) {
  return [request, with_checks](int64_t begin, int64_t end, const StopFlag*) {
    std::vector<voxel::LayerResult> layers;
    for (int64_t k = begin; k < end; ++k) layers.push_back(ball_layer(request, k, with_checks));
    return layers;
  };
}

// Returns the rows of the ball's layers that lie in a box, over the whole width.
inline RegionProducer ball_rows(const SliceRequest& request) {
  return [request](const voxel::TileBox& box, const StopFlag*) {
    std::vector<voxel::LayerResult> layers;
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
      voxel::LayerResult layer = ball_layer(request, k, true);
      RunLayer rows(layer.materials().width());
      std::vector<MaterialId> row(rows.width());
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        layer.materials().row(static_cast<uint32_t>(j)).unpack(row.data());
        rows.append_row(row.data());
      }
      layer.materials() = std::move(rows);
      layers.push_back(std::move(layer));
    }
    return layers;
  };
}

inline Contents contents(const fs::path& folder) {
  Contents all;
  for (const auto& entry : fs::directory_iterator(folder))
    all[entry.path().filename().string()] = formats::read_file(entry.path().string());
  return all;
}

inline void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

inline SliceReport run(const SliceRequest& request, const SliceOptions& options) {
  return slice(request, ball(request), options);
}

// Returns the files of an uninterrupted run on one thread.
inline Contents expected(const SliceRequest& request, const fs::path& root) {
  SliceOptions options;
  options.folder = (root / "expected").string();
  options.threads = 1;
  run(request, options);
  Contents all = contents(options.folder);
  fs::remove_all(options.folder);
  return all;
}

inline void expect_same(const Contents& a, const Contents& b) {
  for (const auto& [name, text] : a) {
    ASSERT_TRUE(b.count(name)) << name << " is missing";
    EXPECT_TRUE(b.at(name) == text) << name << " differs";
  }
  EXPECT_EQ(a.size(), b.size());
}

// Returns a request of masks: a file for each of two materials.
inline SliceRequest mask_request() {
  SliceRequest request = ball_request();
  voxel::Printer printer;
  printer.name = "vat";
  use_printer(request, printer, ImageFormat::mask);
  return request;
}

inline Data job_json(const std::string& folder) {
  Diagnostics diagnostics;
  auto job = parse_json(make_source("job.json", formats::read_file(folder + "/job.json")), diagnostics);
  EXPECT_TRUE(job) << to_text(diagnostics);
  return job.value_or(Data());
}

}  // namespace ombre::compile
