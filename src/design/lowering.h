// Lowering: computes fields of nodes at points and caches the results.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/system/not_copied.h"
#include "design/node.h"
#include "design/stage.h"
#include "design/sub_design_memory.h"

namespace ombre::design {

// A condition that a job reports if its flag is 1 at a voxel.
struct Check {
  SourceRange where;
  std::string message;
};

struct ManyParts;
struct PartsQuestion;

// State that all lowerings of one design share, such as checks and bodies.
class LoweringContext {
 public:
  // `scale` is the job's, if known. Tables of many parts are made on up to `threads` threads; 0 means all cores.
  LoweringContext(const MaterialTable& materials, const std::vector<NodePtr>& roots,
                  std::optional<JobScale> scale = std::nullopt, int threads = 1);
  // Sets the lattice and the host of stages. Without this call all stages are 0 everywhere.
  void use_stages(const std::optional<StageLattice>& lattice, std::shared_ptr<StageHost> host);
  // Sets a memory that keeps tables of many parts. Tables in the memory are made in the frame of their node, so that
  // they do not depend on nodes above. Without a memory they are made in the frame of the program, which rounds values
  // differently.
  void use_memory(SubDesignMemory* memory) { memory_ = memory; }
  bool has_memory() const { return memory_ != nullptr; }
  ~LoweringContext();

  const MaterialTable& materials() const { return materials_; }
  const std::vector<Check>& checks() const { return checks_; }
  const std::vector<AttributeDeclaration>& attributes() const { return attributes_; }
  // Messages that nodes reported during lowering, each once.
  const Diagnostics& diagnostics() const { return diagnostics_; }
  void report(const Diagnostic& diagnostic);
  uint32_t register_check(const Node& node, const std::string& message);
  // Returns the job's scale in the node's space, after the scaling by transforms above. If several paths lead to the
  // node, returns the finest scale.
  std::optional<JobScale> scale(const Node& node);
  program::SourceField staged(const Node& node, const StagePtr& stage);
  // Returns a table of the node's parts in the frame of the program that will contain it, or null if a table does not
  // pay.
  const ManyParts* many_parts(const Node& node, const PartList& list, PartQuery query, const Affine& node_from_program,
                              const Falloff* falloff);
  // Writes the code of all bodies into their programs. Must be the last call.
  void finish_bodies();

 private:
  friend class Lowering;
  struct Body;
  Body& body_of(const Node& node);
  // The relation between a node's space and the space of the root.
  struct View {
    double scale = 1;  // length in the node's space per length in the root's; the least one if there are several paths
    std::optional<Vec3> offset;  // translation from the root's space, if they differ only by whole voxels
  };
  View view(const Node& node);
  void find_views();
  void meet(View& known, const View& other) const;
  bool carries(const Node& node, std::string_view attribute);
  void declare(const AttributeDeclaration& declared);
  bool is_shared(const Node& node) const { return shared_.contains(&node); }
  std::shared_ptr<const ManyParts> remembered(const PartsQuestion& question);
  Hash hash_of_parts(const PartsQuestion& question) const;
  size_t reports();

  const MaterialTable& materials_;
  std::vector<NodePtr> roots_;
  std::optional<JobScale> scale_;
  std::optional<StageLattice> lattice_;
  std::shared_ptr<StageHost> stages_;
  int threads_;
  // Guards state that independent lowerings may use at the same time.
  std::mutex queries_mutex_;
  std::unordered_map<const Node*, View> views_;  // computed when first needed
  std::vector<Check> checks_;
  Diagnostics diagnostics_;
  std::map<std::pair<const Node*, std::string>, uint32_t> check_numbers_;
  std::vector<AttributeDeclaration> attributes_;
  std::unordered_set<const Node*> shared_;                       // nodes that are used more than once
  std::map<std::pair<const Node*, std::string>, bool> carries_;  // whether a node has an attribute
  std::unordered_map<const Node*, std::unique_ptr<Body>> bodies_;
  std::vector<Body*> body_order_;
  using PartsKey = std::tuple<const Node*, PartQuery, bool, std::array<double, 12>>;
  std::map<PartsKey, std::shared_ptr<const ManyParts>> many_parts_;
  SubDesignMemory* memory_ = nullptr;
};

// Returns the materials that a material parameter may give at some point, in ascending order.
std::vector<MaterialId> materials_of(const MaterialName& name, const MaterialTable& table);

// Lowers nodes into one builder. A node that is used more than once becomes a body, a sub-program that is called at
// each point where it is needed.
class Lowering : public OutputFields, NotCopied {
 public:
  Lowering(LoweringContext& context, program::Builder& builder) : context_(context), builder_(builder) {
    builder.set_user(this);
  }
  ~Lowering() override { builder_.set_user(nullptr); }

  Field distance(const Node& node, const Point& p);
  Field membership(const Node& node, const Point& p, Border border);  // a truth value
  Field inside(const Node& node, const Point& p) { return membership(node, p, Border::included); }
  Composition composition(const Node& node, const Point& p, Demand demand);
  Field attribute(const Node& node, std::string_view name, const Point& p, Demand demand);
  Field number(const NodeOutput& output, const Point& p) override;
  // Returns the value of one of the node's own outputs.
  OutputAnswer answer(const Node& node, size_t output, const Point& p);
  // Returns the numbers of the output with this name. A solid without it has the output of the first input that has it
  // and holds the point; without any the result is 0.
  Numbers4 output(const Node& node, std::string_view name, const Point& p);
  // Returns the composition of a solid without a material: the first one of the table.
  Composition default_composition(const Point& p) const;

  // Returns the parts of a node from a table, or nothing if there are too few. Each node has only one list and one
  // falloff.
  std::optional<PartFields> many_parts(const Node& node, const PartList& list, PartQuery query, const Point& p,
                                       const Falloff* falloff);
  // Makes this lowering independent of the context: shared nodes are not called as bodies, and checks are kept here. It
  // is used for separate sub-programs, of which several may be made at the same time.
  void write_bodies_out() { stands_alone_ = true; }
  struct LocalCheck {
    const Node* node;
    std::string message;
  };
  const std::vector<LocalCheck>& local_checks() const { return local_checks_; }

  bool has_attribute(const Node& node, std::string_view name);
  // Returns the declaration of an attribute, or of one of its numbers.
  const AttributeDeclaration* declaration(std::string_view name) const;
  const std::vector<AttributeDeclaration>& attributes() const { return context_.attributes_; }
  MaterialId material(const MaterialName& name) const;
  std::optional<JobScale> scale(const Node& node) { return context_.scale(node); }
  program::SourceField staged(const Node& node, const StagePtr& stage) { return context_.staged(node, stage); }
  void report(const Diagnostic& diagnostic) { context_.report(diagnostic); }
  uint32_t add_check(const Node& node, const std::string& message);
  program::Builder& builder() { return builder_; }

 private:
  enum class Query : uint8_t {
    distance,
    inside,
    interior,
    composition_inside,
    composition_everywhere,
    output,
  };
  struct Key {
    const Node* node;
    program::ValueId x, y, z;
    Query query;
    uint32_t output = 0;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    size_t operator()(const Key& key) const;
  };

  static Key key_of(const Node& node, const Point& p, Query query);
  template <class Make>
  Field once(const Node& node, const Point& p, Query query, const Make& make);
  Composition make_composition(const Node& node, const Point& p, Demand demand);
  Field make_attribute(const Node& node, std::string_view name, const Point& p, Demand demand);
  LoweringContext::Body* body_for(const Node& node);

  LoweringContext& context_;
  program::Builder& builder_;
  const Node* own_ = nullptr;  // the node whose body this is; it is lowered here instead of called
  bool stands_alone_ = false;
  std::vector<LocalCheck> local_checks_;
  std::unordered_map<Key, Field, KeyHash> fields_;
  std::unordered_map<Key, OutputAnswer, KeyHash> answers_;
  std::unordered_map<Key, Composition, KeyHash> compositions_;

  friend class LoweringContext;
};

}  // namespace ombre::design
