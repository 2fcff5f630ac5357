#include <algorithm>
#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>

#include "interruption.hpp"
#include "linear/arrays.hpp"
#include "method/method_spec.hpp"
#include "odeint_number.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/text.hpp"
#include "step/odeint_methods.hpp"
#include "step/reduced_stepper.hpp"

namespace hbvm::core {
namespace {

namespace ode = boost::numeric::odeint;

/// 10^-digits.
template <Scalar S>
S tenth_to(int digits) {
  S power = 1;
  for (int i = 0; i < digits; ++i) power *= 10;
  return 1 / power;
}

/// Time runs from 0 to 1 in a step. The variables x are the changes of q and p over scales that are powers of 2. So
/// powers of 2 in the units of length, mass and time do not matter.
template <Scalar S>
class BulirschStoer final : public ReducedStepper<S> {
 public:
  BulirschStoer(const Problem<S>& problem, int digits)
      : ReducedStepper<S>(problem),
        stepper_(tenth_to<S>(digits), S(0), S(1), S(1)),
        scale_(Vector<S>::Ones(2 * problem.m())),
        x_(static_cast<std::size_t>(2 * problem.m())),
        slope_(x_),
        next_(x_) {}

 protected:
  long advance(const S& h) override {
    if (h != h_) {
      set(h_, h);
      part_ = 1;
    }
    take_scales(h);
    for (Number& x : x_) x = Number();
    write_slope(slope_, this->start_velocity(), this->start_force());
    stepper_.reset();
    const auto system = [this](const Numbers& x, Numbers& slope, const Number&) { evaluate_at(x, slope); };
    const S least = epsilon<S>();
    Number t = 0;
    long tries = 0;
    for (bool last = false;;) {
      const S rest = 1 - t.value;
      last = !(part_ < rest);
      Number dt = last ? rest : part_;
      ++tries;
      const bool made = stepper_.try_step(system, x_, slope_, t, next_, dt) == ode::success;
      // odeint's norms hide what is not a number.
      const bool finite = is_finite(dt.value) &&
                          std::all_of(next_.begin(), next_.end(), [](const Number& x) { return is_finite(x.value); });
      if (!finite)
        throw StageFailure(FailureCause::stage_equations_diverge, "an extrapolation is not finite", "inf", tries);
      // A last part is as short as it has to be, and says less of the next ones.
      if (!made || !last || dt.value > part_) part_ = std::min(dt.value, S(1));
      if (made) x_.swap(next_);
      if (made && last) break;
      if (!(part_ > least))
        throw StageFailure(FailureCause::precision_exhausted,
                           "the tolerance is not reached by parts of " + to_scientific(part_, 3) + " of the step",
                           to_scientific(part_, 3), tries);
      end_if_asked("a step is made in parts");
      if (made) evaluate_at(x_, slope_);
    }
    set_changes(x_);
    return tries;
  }

  void remember_parts(Archive& archive) override { archive(h_, part_); }

 private:
  using Number = OdeintNumber<S>;
  using Numbers = std::vector<Number>;
  using Extrapolation =
      ode::bulirsch_stoer<Numbers, Number, Numbers, Number, ode::range_algebra, ode::default_operations>;

  Index m() const { return this->problem().m(); }

  /// The greatest of |x| and h |x'| in each body's coordinates, up to a factor of 2. A body without any has the
  /// greatest of all.
  void take_scales(const S& h) {
    take_scales(this->start_q(), this->start_velocity(), h, 0);
    take_scales(this->start_p(), this->start_force(), h, m());
  }
  void take_scales(const Vector<S>& x, const Vector<S>& slope, const S& h, Index offset) {
    long greatest = exponent_of_zero;
    for (const bool fill : {false, true})
      for (const auto& block : this->problem().mass.blocks()) {
        S size = 0;
        for (Index j = block.offset; j < block.offset + block.size; ++j) {
          raise_to(size, magnitude(x[j]));
          raise_to(size, magnitude(S(h * slope[j])));
        }
        const long own = size == 0 ? greatest : binary_exponent(size);
        if (!fill) {
          greatest = std::max(greatest, size == 0 ? greatest : own);
          continue;
        }
        for (Index j = block.offset; j < block.offset + block.size; ++j)
          scale_[offset + j] = own == exponent_of_zero ? S(1) : power_of_two<S>(own);
      }
  }

  void set_changes(const Numbers& x) {
    for (Index j = 0; j < m(); ++j) {
      set_product(this->dq_[j], x[static_cast<std::size_t>(j)].value, scale_[j]);
      set_product(this->dp_[j], x[static_cast<std::size_t>(m() + j)].value, scale_[m() + j]);
    }
  }
  void write_slope(Numbers& slope, const Vector<S>& velocity, const Vector<S>& force) {
    for (Index j = 0; j < m(); ++j) {
      slope[static_cast<std::size_t>(j)] = S(h_ * velocity[j] / scale_[j]);
      slope[static_cast<std::size_t>(m() + j)] = S(h_ * force[j] / scale_[m() + j]);
    }
  }
  void evaluate_at(const Numbers& x, Numbers& slope) {
    set_changes(x);
    const ReducedEquations<S>& there = this->evaluate();
    write_slope(slope, there.velocity(), there.force());
  }

  Extrapolation stepper_;
  Vector<S> scale_;
  Numbers x_, slope_, next_;
  S h_ = 0;     ///< of the last step
  S part_ = 1;  ///< of a step, to be tried next
};

class BulirschStoerMethod final : public MethodByTemplate<BulirschStoerMethod> {
 public:
  explicit BulirschStoerMethod(int digits) : digits_(digits) {}

  std::string text() const override { return "bulirsch_stoer:" + std::to_string(digits_); }
  std::string title() const override { return "Bulirsch-Stoer, " + std::to_string(digits_) + " digits"; }
  int order() const override { return 16; }
  int stages() const override { return 8; }
  int terms() const override { return 16; }
  Kept kept() const override { return {}; }
  std::optional<int> digits() const override { return digits_; }

  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    // Extrapolation magnifies what rounding leaves, by some hundred at its highest order.
    constexpr int lost = 2;
    if (digits_ > digits10<S>() - lost)
      throw InputError("method " + text() + ": with " + std::to_string(digits10<S>()) + " digits at most " +
                       std::to_string(digits10<S>() - lost) + " can be asked for; see --precision");
    return [&problem, digits = digits_] { return std::make_unique<BulirschStoer<S>>(problem, digits); };
  }

 private:
  int digits_;
};

}  // namespace

MethodPtr bulirsch_stoer_method(std::string_view arguments) {
  const std::optional<int> digits = whole_number(arguments);
  if (!digits || *digits < 1 || *digits > 1'000)
    throw InputError("method bulirsch_stoer:" + std::string(arguments) +
                     ": use bulirsch_stoer:DIGITS with a whole number of them, from 1 to 1000");
  return std::make_shared<const BulirschStoerMethod>(*digits);
}

}  // namespace hbvm::core
