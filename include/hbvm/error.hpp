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

}  // namespace hbvm
