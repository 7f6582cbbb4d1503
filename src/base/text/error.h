// Errors outside designs: files, disks, memory, other programs. Errors in designs are Diagnostics.
#pragma once

#include <stdexcept>
#include <string>

#include "base/text/code.h"
#include "base/text/phrase.h"

namespace ombre {

// Thrown when the operating system, a file or another program fails. The message names the path and says what to do.
// what() is worded for the command line.
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

// Thrown when a run was asked to stop, by Ctrl-C or a host program. Finished results stay valid.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace ombre
