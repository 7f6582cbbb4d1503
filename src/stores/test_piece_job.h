// A small job whose pieces are texts, for tests of stores.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "base/system/temporary_folder.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/test_errors.h"
#include "formats/containers/file.h"
#include "stores/store.h"
#include "stores/stored_job.h"

namespace ombre::stores {

inline std::string piece_file(int64_t id) { return "piece_" + std::to_string(id) + ".txt"; }

// Pieces 0 to count - 1. Those whose number is a multiple of 5 have no file, the others have one.
class PieceJob : public StoredJob {
 public:
  explicit PieceJob(int64_t count, std::string design = "a") : count_(count), design_(std::move(design)) {}

  const JobWords& words() const override {
    static const JobWords words{"text job", "text job", "pieces", "text.json", "piece", ".txt"};
    return words;
  }
  std::string description(const Entries& finished) const override {
    return print_json(DataMembers{{"format", "text job, version 1"},
                                  {"design", design_},
                                  {"pieces", number(count_)},
                                  {"complete", is_complete(finished)}});
  }
  bool is_complete(const Entries& finished) const override { return static_cast<int64_t>(finished.size()) == count_; }
  void check_same(const std::string& folder, const DataMembers& there) const override {
    const Data description(there);
    const Data* design = description.find("design");
    if (!design || !(*design == Data(design_))) throw Error(folder + " holds another design");
  }
  bool accepts(const Entry& entry) const override {
    if (entry.id >= count_ || entry.files.size() != (entry.id % 5 ? 1U : 0U)) return false;
    return entry.files.empty() || entry.files[0].name == piece_file(entry.id);
  }
  bool owns(std::string_view name) const override { return is_below(name, count_); }
  std::optional<NameTest> files_of(const Data& description) const override {
    const auto count = whole_number(description.find("pieces"));
    if (!count) return std::nullopt;
    return [count](std::string_view name) { return is_below(name, static_cast<int64_t>(*count)); };
  }

 private:
  static bool is_below(std::string_view name, int64_t count) {
    for (int64_t id = 0; id < count; ++id)
      if (name == piece_file(id)) return true;
    return false;
  }

  int64_t count_;
  std::string design_;
};

inline Piece piece(int64_t id) {
  Piece piece{id, {}, {{"size", number(id * id)}, {"words", DataList{"one \"quoted\"\n", 0.1}}}};
  if (id % 5) piece.files.emplace_back(piece_file(id), "text of piece " + std::to_string(id) + std::string(1, '\0'));
  return piece;
}

inline void put_pieces(Store& store, int64_t begin, int64_t end) {
  for (int64_t id = begin; id < end; ++id) store.put(piece(id));
}

using FolderContents = std::map<std::string, std::string>;

inline FolderContents contents_of(const std::string& folder) {
  FolderContents all;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    all[entry.path().filename().string()] = formats::read_file(entry.path().string());
  return all;
}

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace ombre::stores
