// A kind of job as data: its name, its options, and the function that runs it. Commands, methods in Python, forms in
// the studio and pages of the reference are made from it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "jobs/common/session.h"
#include "jobs/common/shared_job.h"
#include "options/option.h"

namespace ombre::jobs {

struct JobKind {
  std::string name;
  std::string help;                                  // one sentence
  std::string footer;                                // text of the help below the options: units, examples
  const std::vector<options::Option>& (*options)();  // made at the first call
  // Makes a job with default values of its options. The functions of the options take its address.
  std::function<std::shared_ptr<void>()> make;
  // Plans, checks, runs and reports the job at this address. Returns an exit code. Throws WrongArgument, Error and
  // Cancelled.
  std::function<int(const void* job, Session& session)> run;
  // The endings of the files that it writes as -o says; "" stands for a folder. An ending belongs to one kind, which
  // front ends choose where only the file to write is named.
  std::vector<std::string> endings = {};
  // Plans a job at this address that processes may share. Returns null, and adds diagnostics, if the design is wrong.
  // Null for kinds whose jobs are not shared.
  std::function<SharedJobPtr(const void* job, Session& session, Diagnostics& diagnostics)> share = nullptr;
};

// Makes the kind whose jobs are values of the type Choices.
template <class Choices>
JobKind job_kind(std::string name, std::string help, std::string footer, int (*run)(const Choices&, Session&)) {
  return {std::move(name),
          std::move(help),
          std::move(footer),
          []() -> const std::vector<options::Option>& { return Choices::options().options(); },
          [] { return std::make_shared<Choices>(); },
          [run](const void* job, Session& session) { return run(*static_cast<const Choices*>(job), session); }};
}

}  // namespace ombre::jobs
