#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "linear/arrays.hpp"
#include "step/odeint_methods.hpp"
#include "step/reduced_stepper.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
class Rkf78 final : public ReducedStepper<S> {
 public:
  explicit Rkf78(const Problem<S>& problem)
      : ReducedStepper<S>(problem), x_(static_cast<std::size_t>(2 * problem.m())), slope_(x_) {}

 protected:
  long advance(const S& h) override {
    for (S& x : x_) x = 0;
    write(slope_, this->start_velocity(), this->start_force());
    const auto system = [this](const Numbers& x, Numbers& slope, const S&) {
      read(x);
      const ReducedEquations<S>& there = this->evaluate();
      write(slope, there.velocity(), there.force());
    };
    stepper_.do_step(system, x_, slope_, S(0), h);
    read(x_);
    return 1;
  }

 private:
  using Numbers = std::vector<S>;

  Index m() const { return this->problem().m(); }
  void read(const Numbers& x) {
    for (Index j = 0; j < m(); ++j) {
      set(this->dq_[j], x[static_cast<std::size_t>(j)]);
      set(this->dp_[j], x[static_cast<std::size_t>(m() + j)]);
    }
  }
  void write(Numbers& slope, const Vector<S>& velocity, const Vector<S>& force) {
    for (Index j = 0; j < m(); ++j) {
      set(slope[static_cast<std::size_t>(j)], velocity[j]);
      set(slope[static_cast<std::size_t>(m() + j)], force[j]);
    }
  }

  // Its coefficients are quotients of whole numbers, computed here and so in the working precision.
  boost::numeric::odeint::runge_kutta_fehlberg78<Numbers, S, Numbers, S, boost::numeric::odeint::range_algebra,
                                                 boost::numeric::odeint::default_operations>
      stepper_;
  Numbers x_, slope_;
};

class Rkf78Method final : public MethodByTemplate<Rkf78Method> {
 public:
  std::string text() const override { return "rkf78"; }
  std::string title() const override { return "RKF78"; }
  int order() const override { return 8; }
  int stages() const override { return 4; }  // a Gauss method of so many has its order
  int terms() const override { return 13; }
  Kept kept() const override { return {}; }
  Orders orders() const override { return {.p = 8, .lambda = 8, .hidden = 8, .energy = 8, .angular_momentum = 8}; }
  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    return [&problem] { return std::make_unique<Rkf78<S>>(problem); };
  }
};

}  // namespace

MethodPtr rkf78_method() { return std::make_shared<const Rkf78Method>(); }

}  // namespace hbvm::core
