#pragma once

#include <stdexcept>
#include <string>

namespace hbvm {

/// Root of everything hbvm throws on purpose. The text is one line: what, where, and what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's input is wrong (a scene, an expression, a method, a step …). The program exits with 2.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The input is right but the computation could not go on (a stage system without a solution …).
/// The program exits with 3, and what was computed before is kept.
class IntegrationError : public Error {
 public:
  using Error::Error;
};

/// The work was asked to end, and did, between two steps or within one. What was shown before stays.
class Interrupted : public Error {
 public:
  Interrupted(int signal, const std::string& what) : Error(what), signal_(signal) {}
  /// That asked, as the program has it; 0 if no signal did.
  int signal() const { return signal_; }

 private:
  int signal_;
};

}  // namespace hbvm
