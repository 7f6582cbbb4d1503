// Nodes and designs as Python holds them.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "load/loaded.h"
#include "load/node_factory.h"
#include "questions/sampler.h"

namespace ombre::python {

namespace py = pybind11;

using FactoryPtr = std::shared_ptr<compile::NodeFactory>;

struct NodeHandle {
  design::NodePtr node;
  FactoryPtr factory;  // has the materials that the node names
};

class DesignHandle {
 public:
  DesignHandle(compile::LoadedPtr loaded, FactoryPtr factory);

  const design::Design& design() const { return loaded_->design; }
  const compile::LoadedPtr& loaded() const { return loaded_; }
  const FactoryPtr& factory() const { return factory_; }
  // Returns the sampler of a question, which is built once.
  std::shared_ptr<const compile::Sampler> sampler(const std::string& question);
  // Raises the exception of a function of the design.
  void raise_failures() const;

 private:
  compile::LoadedPtr loaded_;
  FactoryPtr factory_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const compile::Sampler>> samplers_;
};

// The source cache of the process.
using CachePtr = std::shared_ptr<sources::SourceCache>;

void add_designs(py::module_& module, const CachePtr& cache);
void add_commands(py::module_& module, const CachePtr& cache);
void add_point_sets(py::module_& module);

}  // namespace ombre::python
