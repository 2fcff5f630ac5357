#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hbvm/error.hpp"
#include "scalar/expression.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// What a method keeps of every motion whatever the step, but for round-off.
struct Kept {
  bool energy = false;       ///< H, with as many nodes as U needs
  bool momenta = false;      ///< the linear and angular momenta that every effect and constraint keeps
  bool constraints = false;  ///< g
  bool hidden = false;       ///< grad g^T M^-1 p
  bool reversal = false;     ///< as many steps back lead to where it started
};

/// The orders over an interval of what a method is known to give in part only; 0 where none is claimed.
struct Orders {
  int p = 0;                 ///< momentum as it is propagated
  int lambda = 0;            ///< the multiplier of the step, as that of its end
  int hidden = 0;            ///< hidden constraints, where they are not kept
  int energy = 0;            ///< H, where it is not kept
  int angular_momentum = 0;  ///< where it is not kept
};

/// The letter s for a number of stages.
inline Constants letter_s(int stages) {
  Constants letters;
  letters.insert_or_assign("s", Expression::parse(std::to_string(stages)));
  return letters;
}

/// Makes steppers, each of which knows nothing of the others.
template <Scalar S>
using StepperMaker = std::function<std::unique_ptr<Stepper<S>>()>;

/// A method of integration, for any problem in any precision. Immutable; made from its name by parse_method().
class Method {
 public:
  virtual ~Method() = default;

  /// As parse_method() reads it: "hbvm:4,2".
  virtual std::string text() const = 0;
  /// In tables: "HBVM(4,2)".
  virtual std::string title() const { return text(); }
  /// Two methods with the same key make the same steps.
  virtual std::string key() const { return text(); }

  /// Of q and of the momentum that is tangential, over an interval; 0 if it is not known.
  virtual int order() const = 0;
  /// No more than this decides the order: s.
  virtual int stages() const = 0;
  /// How many numbers are summed for a coordinate in a step.
  virtual int terms() const = 0;
  virtual Kept kept() const = 0;
  virtual Orders orders() const { return {}; }
  /// Of a method that divides its steps: the digits it is asked for in each. Its order is then the highest it uses, and
  /// nothing falls at a rate of the steps it is given.
  virtual std::optional<int> digits() const { return {}; }
  /// The numbers of its name by their letters: k and s.
  virtual Constants parameters() const { return {}; }

  /// What makes its steppers, with the coefficients that they share. The problem must outlive them. The solver is for
  /// stage equations that leave a choice. \throws InputError if the method is not for this problem
#define HBVM_DECLARE(S) virtual StepperMaker<S> prepare(const Problem<S>& problem, SolverKind solver) const = 0;
  HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

  /// One of them.
  template <Scalar S>
  std::unique_ptr<Stepper<S>> make_stepper(const Problem<S>& problem, SolverKind solver) const {
    return prepare(problem, solver)();
  }
};

using MethodPtr = std::shared_ptr<const Method>;

/// Refuses a problem whose forces do not all come from a potential of q alone. \throws InputError
template <Scalar S>
void require_conservative(const Problem<S>& problem, const std::string& method) {
  if (problem.is_conservative()) return;
  throw InputError("method " + method +
                   " takes forces with a potential that does not depend on t, and points at rest; here " +
                   (problem.forces.empty() ? "'" + problem.driven.back().name + "' depends on t"
                                           : "there is " + problem.forces.front().name) +
                   "; use hbvm:K,S, projected_hbvm:K,S or a Runge-Kutta method");
}

/// A method that is prepared by one template of its own,
///
///     template <Scalar S> StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind solver) const;
template <class Own>
class MethodByTemplate : public Method {
 public:
#define HBVM_DECLARE(S)                                                                  \
  StepperMaker<S> prepare(const Problem<S>& problem, SolverKind solver) const override { \
    return own().prepare_in(problem, solver);                                            \
  }
  HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

 private:
  const Own& own() const { return static_cast<const Own&>(*this); }
};

}  // namespace hbvm::core
