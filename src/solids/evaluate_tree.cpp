#include "solids/evaluate_tree.h"

#include <algorithm>
#include <atomic>
#include <map>

#include "base/system/tasks.h"
#include "solids/content.h"
#include "solids/operations.h"

namespace ombre::solids {
namespace {

// A distinct subtree, which may occur several times in the tree.
struct Step {
  const Tree* tree = nullptr;
  std::vector<size_t> inputs;  // numbers of earlier steps, one for each child
  std::vector<size_t> users;
  size_t missing = 0;  // number of distinct inputs not done yet
  size_t uses = 0;     // number of users not done yet
  std::shared_ptr<const Pieces> result;
  Diagnostics messages;
};

// The distinct subtrees, inputs before their users.
class StepList {
 public:
  explicit StepList(const TreePtr& root) {
    std::vector<Frame> open{{root.get(), {}, 0}};
    while (true) {
      Frame& top = open.back();
      if (const Tree* const child = next_child(top)) {
        open.push_back({child, {}, 0});
        continue;
      }
      const size_t number = add(top);
      open.pop_back();
      if (open.empty()) return;
      open.back().inputs.push_back(number);
    }
  }

  std::vector<Step>& steps() { return steps_; }

 private:
  struct Frame {
    const Tree* tree;
    std::vector<size_t> inputs;
    size_t at;
  };

  static const Tree* next_child(Frame& frame) {
    while (frame.at < frame.tree->children.size()) {
      const Tree* const child = frame.tree->children[frame.at++].get();
      if (child && !child->background) return child;
    }
    return nullptr;
  }

  size_t add(const Frame& frame) {
    std::string text = text_of(*frame.tree);
    for (const size_t input : frame.inputs) text += hashes_[input].hex();
    const Hash hash = hash_bytes(text);
    const auto [place, is_new] = known_.try_emplace(hash, steps_.size());
    if (!is_new) return place->second;
    hashes_.push_back(hash);
    Step& step = steps_.emplace_back();
    step.tree = frame.tree;
    step.inputs = frame.inputs;
    return place->second;
  }

  std::vector<Step> steps_;
  std::vector<Hash> hashes_;
  std::map<Hash, size_t> known_;
};

std::vector<size_t> distinct(std::vector<size_t> list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

// Runs the steps whose inputs are done, then those that became ready, and so on.
class Runner {
 public:
  Runner(std::vector<Step>& steps, const EvaluateOptions& options) : steps_(steps), options_(options) {
    for (size_t n = 0; n < steps.size(); ++n) {
      const std::vector<size_t> inputs = distinct(steps[n].inputs);
      steps[n].missing = inputs.size();
      for (const size_t input : inputs) {
        steps[input].users.push_back(n);
        ++steps[input].uses;
      }
      if (inputs.empty()) ready_.push_back(n);
    }
  }

  void run() {
    while (!ready_.empty()) {
      const std::vector<size_t> now = std::move(ready_);
      ready_.clear();
      run_parallel(now.size(), options_.threads, [&](size_t n) { compute(steps_[now[n]]); });
      for (const size_t n : now) finish(n);
    }
  }

 private:
  void compute(Step& step) {
    const OperationContext context{{options_.threads, options_.stop}, options_.keeps_empty, &step.messages};
    context.work.check();
    std::vector<const Pieces*> children;
    for (const size_t input : step.inputs) children.push_back(steps_[input].result.get());
    step.result = std::make_shared<const Pieces>(is_leaf(step.tree->operation) ? leaf_pieces(*step.tree, context)
                                                                               : apply(*step.tree, children, context));
    const size_t done = ++done_;
    if (options_.progress) options_.progress->update({done, steps_.size(), -1, -1});
  }

  // Releases results that no other step needs.
  void finish(size_t n) {
    for (const size_t user : steps_[n].users)
      if (--steps_[user].missing == 0) ready_.push_back(user);
    for (const size_t input : distinct(steps_[n].inputs))
      if (--steps_[input].uses == 0) steps_[input].result = nullptr;
  }

  std::vector<Step>& steps_;
  const EvaluateOptions& options_;
  std::vector<size_t> ready_;
  std::atomic<size_t> done_{0};
};

}  // namespace

Pieces evaluate(const TreePtr& tree, const EvaluateOptions& options, Diagnostics& messages) {
  if (!tree || tree->background) return {};
  StepList list(tree);
  Runner(list.steps(), options).run();
  for (const Step& step : list.steps()) messages.add_all(step.messages);
  Pieces result = *list.steps().back().result;
  std::erase_if(result, [](const Piece& piece) { return piece.dimension() == 0; });
  return result;
}

}  // namespace ombre::solids
