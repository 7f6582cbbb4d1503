// The nodes and parts of a design file (JSON) as a graph.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::lang {

struct DesignItem {
  bool is_part = false;
  std::string name;                                            // the id of a node, or the name of a part
  std::string type;                                            // of a node
  const Data* object = nullptr;                                // its entry
  std::vector<std::pair<std::string, const Data*>> arguments;  // parameters of a node
  std::vector<size_t> inputs;                                  // the nodes that it takes; of a part its node
};

// A reference from a parameter to a node, {"from": "n3", "output": "value"}.
struct DesignWire {
  size_t item = 0, argument = 0;  // where it stands
  size_t from = 0;
  std::string output;
  const Data* id = nullptr;
  bool is_whole = false;  // it is all that the parameter has
};

class DesignGraph {
 public:
  static constexpr size_t most_items = 3000;

  // Returns nothing if the text is not JSON or lacks lists of nodes and parts; the reasons are added to the
  // diagnostics. Types and parameters are not checked.
  static std::optional<DesignGraph> read(const SourcePtr& source, Diagnostics& diagnostics);
  std::optional<DesignGraph> read_again(const SourcePtr& source, Diagnostics& diagnostics) const {
    return read(source, diagnostics);
  }

  const SourcePtr& source() const { return source_; }
  std::string_view text() const { return source_->text(); }
  const Data& root() const { return *root_; }
  const Data& nodes() const { return *root_->find("nodes"); }
  const Data& parts() const { return *root_->find("parts"); }

  // The parts, then the nodes, each in the order of the text.
  const std::vector<DesignItem>& items() const { return items_; }
  const std::vector<DesignWire>& wires() const { return wires_; }
  size_t part_count() const { return part_count_; }
  // True if the file has more nodes than are listed.
  bool is_cut() const { return is_cut_; }

  std::optional<size_t> node_called(std::string_view id) const;
  // True if an item needs another one, by way of others too.
  bool needs(size_t item, size_t other) const;

 private:
  void add_parts();
  void add_nodes();
  void connect(size_t item);

  SourcePtr source_;
  std::unique_ptr<const Data> root_;
  std::vector<DesignItem> items_;
  std::vector<DesignWire> wires_;
  size_t part_count_ = 0;
  bool is_cut_ = false;
};

}  // namespace ombre::lang
