// Lowering: asks nodes for fields at points and remembers the answers.
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

#include "design/node.h"
#include "design/stage.h"
#include "design/sub_design_memory.h"

namespace ombre::design {

// What a job tells of when a check's mark is 1 at a voxel.
struct Check {
  SourceRange where;
  std::string message;
};

struct ManyParts;
struct PartsQuestion;

// State that all lowerings of one design share: checks and bodies.
class LoweringContext {
 public:
  // `scale` of the job, if it is known. Tables of many parts are made on up to `threads` threads; 0: all cores.
  LoweringContext(const MaterialTable& materials, const std::vector<NodePtr>& roots,
                  std::optional<JobScale> scale = std::nullopt, int threads = 1);
  // Where stages get their lattice and are made. Without this they are 0 everywhere.
  void use_stages(const std::optional<StageLattice>& lattice, std::shared_ptr<StageHost> host);
  // Tables of many parts are taken from there, and kept there. Each has the frame of its node, so that it does not
  // depend on what stands above; without a memory tables have the frame of the program, whose values are rounded
  // otherwise.
  void use_memory(SubDesignMemory* memory) { memory_ = memory; }
  bool has_memory() const { return memory_ != nullptr; }
  ~LoweringContext();

  const MaterialTable& materials() const { return materials_; }
  const std::vector<Check>& checks() const { return checks_; }
  const std::vector<AttributeDeclaration>& attributes() const { return attributes_; }
  // Remarks of nodes while they were lowered, each once.
  const Diagnostics& diagnostics() const { return diagnostics_; }
  void report(const Diagnostic& diagnostic);
  uint32_t register_check(const Node& node, const std::string& message);
  // As the node has them, where transforms above shrink or stretch it; where there are several ways to it, the least.
  std::optional<JobScale> scale(const Node& node);
  program::SourceField staged(const Node& node, const StagePtr& stage);
  // Parts of the node as a table, placed in the frame of the program that will hold it; null where
  // it does not pay.
  const ManyParts* many_parts(const Node& node, const PartList& list, PartQuery query, const Affine& node_from_program,
                              const Falloff* falloff);
  // Writes the code of the bodies into their programs; call it when nothing more will be lowered.
  void finish_bodies();

 private:
  friend class Lowering;
  struct Body;
  Body& body_of(const Node& node);
  // A node's space as the job sees it.
  struct View {
    double scale = 1;            // a length there for one of the root's; where there are several ways, the least
    std::optional<Vec3> offset;  // a point there less the same point of the root, if they differ by whole voxels only
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
  // Lowerings that stand alone may ask at once.
  std::mutex queries_mutex_;
  std::unordered_map<const Node*, View> views_;  // found when they are needed
  std::vector<Check> checks_;
  Diagnostics diagnostics_;
  std::map<std::pair<const Node*, std::string>, uint32_t> check_numbers_;
  std::vector<AttributeDeclaration> attributes_;
  std::unordered_set<const Node*> shared_;                       // used more than once
  std::map<std::pair<const Node*, std::string>, bool> carries_;  // does a node have an attribute?
  std::unordered_map<const Node*, std::unique_ptr<Body>> bodies_;
  std::vector<Body*> body_order_;
  using PartsKey = std::tuple<const Node*, PartQuery, bool, std::array<double, 12>>;
  std::map<PartsKey, std::shared_ptr<const ManyParts>> many_parts_;
  SubDesignMemory* memory_ = nullptr;
};

// Returns the materials that a material parameter may give at some point, in ascending order.
std::vector<MaterialId> materials_of(const MaterialName& name, const MaterialTable& table);

// Lowers nodes into one builder. A node that is used more than once becomes a body, a sub-program
// that is called at each point where it is asked for.
class Lowering : public OutputFields {
 public:
  Lowering(LoweringContext& context, program::Builder& builder) : context_(context), builder_(builder) {
    builder.set_user(this);
  }
  ~Lowering() override { builder_.set_user(nullptr); }
  Lowering(const Lowering&) = delete;
  Lowering& operator=(const Lowering&) = delete;

  Field distance(const Node& node, const Point& p);
  Field membership(const Node& node, const Point& p, Border border);  // truth value
  Field inside(const Node& node, const Point& p) { return membership(node, p, Border::included); }
  Composition composition(const Node& node, const Point& p, Demand demand);
  Field attribute(const Node& node, std::string_view name, const Point& p, Demand demand);
  Field number(const NodeOutput& output, const Point& p) override;
  Composition mixture(const Node& node, const Point& p);
  Field along(const Node& node, const Point& p);

  // Parts of a node as rows of a table; nothing if they are few. A node has one list and one falloff.
  std::optional<PartFields> many_parts(const Node& node, const PartList& list, PartQuery query, const Point& p,
                                       const Falloff* falloff);
  // From here on, nodes that are used more than once are not called as bodies, and checks are kept here
  // instead of in the context: for sub-programs that stand for themselves. Several may be made at once.
  void write_bodies_out() { stands_alone_ = true; }
  struct LocalCheck {
    const Node* node;
    std::string message;
  };
  const std::vector<LocalCheck>& local_checks() const { return local_checks_; }

  bool has_attribute(const Node& node, std::string_view name);
  // Of an attribute, or of one of its numbers.
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
    numbers,
    mixture,
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
  VectorField numbers(const Node& node, size_t output, const Point& p);
  Composition make_composition(const Node& node, const Point& p, Demand demand);
  Field make_attribute(const Node& node, std::string_view name, const Point& p, Demand demand);
  LoweringContext::Body* body_for(const Node& node);

  LoweringContext& context_;
  program::Builder& builder_;
  const Node* own_ = nullptr;  // the node whose body this is: it is lowered here, not called
  bool stands_alone_ = false;
  std::vector<LocalCheck> local_checks_;
  std::unordered_map<Key, Field, KeyHash> fields_;
  std::unordered_map<Key, VectorField, KeyHash> numbers_;
  std::unordered_map<Key, Composition, KeyHash> compositions_;  // and mixtures

  friend class LoweringContext;
};

}  // namespace ombre::design
