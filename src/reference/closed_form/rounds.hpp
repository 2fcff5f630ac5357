#pragma once

namespace hbvm::core {

/// Counts the rounds of a loop that theory says the end of, so that no loop of a closed form goes on without one.
class Rounds {
 public:
  /// \param what is being computed, for the message \param most rounds that theory allows
  Rounds(const char* what, double most) : what_(what), most_(most) {}

  /// Begins a round.
  /// \throws IntegrationError if there were as many already, Interrupted if a signal asks for the end
  void next();

 private:
  const char* what_;
  double most_, made_ = 0;
};

}  // namespace hbvm::core
