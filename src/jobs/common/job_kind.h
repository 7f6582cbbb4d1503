// A kind of job as data: its name, its options, and what runs it. A command, a method in Python, a form in the studio
// and a page of the reference come from it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "jobs/common/session.h"
#include "options/option.h"

namespace ombre::jobs {

struct JobKind {
  std::string name;
  std::string help;    // a sentence
  std::string footer;  // what help says below the options: units, examples
  std::vector<options::Option> options;
  // Makes a job whose options have their usual values. The options' functions take its address.
  std::function<std::shared_ptr<void>()> make;
  // Plans, checks, runs and reports the job at this address. Returns an exit code. Throws WrongArgument, Error and
  // Cancelled.
  std::function<int(const void* job, Session& session)> run;
  // The endings of the files that it writes as -o says; "" stands for a folder. An ending belongs to one kind, which
  // front ends choose where only the file to write is named.
  std::vector<std::string> endings = {};
};

// The kind of jobs that are values of the type Choices.
template <class Choices>
JobKind job_kind(std::string name, std::string help, std::string footer, int (*run)(const Choices&, Session&)) {
  return {std::move(name),
          std::move(help),
          std::move(footer),
          Choices::options().options(),
          [] { return std::make_shared<Choices>(); },
          [run](const void* job, Session& session) { return run(*static_cast<const Choices*>(job), session); }};
}

}  // namespace ombre::jobs
