// What the machine can do wrong: files, disks, memory, other programs. Wrong designs are Diagnostics.
#pragma once

#include <stdexcept>
#include <string>

#include "base/text/code.h"
#include "base/text/phrase.h"

namespace ombre {

// Thrown at the edge to the operating system; the message names the path and says what to do. what() is worded for the
// command line.
class Error : public std::runtime_error {
 public:
  explicit Error(const Phrase& message) : Error(Code::machine, message) {}
  Error(Code code, Phrase message, CodeValues values = {})
      : std::runtime_error(message.text()), code_(code), message_(std::move(message)), values_(std::move(values)) {}

  Code code() const { return code_; }
  const Phrase& message() const { return message_; }
  const CodeValues& values() const { return values_; }

 private:
  Code code_;
  Phrase message_;
  CodeValues values_;
};

// Thrown when a run was asked to stop (Ctrl-C, a host that cancels). What is finished stays valid.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace ombre
