// What the machine can do wrong: files, disks, memory, other programs. Wrong designs are Diagnostics.
#pragma once

#include <stdexcept>
#include <string>

namespace ombre {

// Thrown at the edge to the operating system; the message names the path and says what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Thrown when a run was asked to stop (Ctrl-C, a host that cancels). What is finished stays valid.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace ombre
