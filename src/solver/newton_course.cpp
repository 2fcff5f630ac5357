#include "solver/newton_course.hpp"

#include <cmath>

#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// Where increments fall by less than this a sweep, a new Jacobian may pay.
constexpr int slow = 10;

}  // namespace

template <Scalar S>
NewtonCourse<S>::NewtonCourse(const S& tolerance, double sweeps_an_evaluation, bool updated)
    : tolerance_(tolerance),
      root_epsilon_([] {
        using std::sqrt;
        return S(sqrt(epsilon<S>()));
      }()),
      coarse_(power_of_two<S>(-10)),
      sweeps_an_evaluation_(sweeps_an_evaluation),
      updated_(updated) {}

template <Scalar S>
void NewtonCourse<S>::start(bool evaluates) {
  evaluates_ = evaluates;
  exact_ = false;
  halvings_ = waiting_ = rises_ = 0;
  small_ = 0;
  set_zero(last_);
}

template <Scalar S>
bool NewtonCourse<S>::went_too_far() const {
  // An expensive Jacobian of another step may be updated to one with which they fall.
  const bool patient = !exact_ && updated_;
  return !begins() && !(change_ < (patient ? S(2 * last_) : last_)) && !(change_ <= coarse_);
}

template <Scalar S>
int NewtonCourse<S>::halve() {
  constexpr int most = 12;
  evaluates_ = false;
  return ++halvings_ > most ? 0 : halvings_;
}

template <Scalar S>
void NewtonCourse<S>::take_back() {
  set_zero(last_);
  evaluates_ = true;
}

template <Scalar S>
bool NewtonCourse<S>::is_rounding() const {
  return change_ <= 16 * epsilon<S>();
}

template <Scalar S>
bool NewtonCourse<S>::waits() const {
  return last_ > 0 && !(2 * change_ < last_) && evaluates_;
}

template <Scalar S>
bool NewtonCourse<S>::is_on_floor() const {
  constexpr int long_enough = 3;
  return waits() && waiting_ + 1 >= long_enough && change_ <= root_epsilon_;
}

template <Scalar S>
void NewtonCourse<S>::go_on(long sweep) {
  waiting_ = waits() ? waiting_ + 1 : 0;
  exact_ = evaluates_;
  halvings_ = 0;
  small_ = change_ > tolerance_ ? 0 : small_ + 1;
  if (last_ == 0 || evaluates_) {
    set(first_, change_);
    falls_ = 0;
  } else {
    ++falls_;
  }
  rises_ = change_ < last_ ? 0 : rises_ + 1;
  // Rounding does not fall, and no new Jacobian mends it, unless there is more of it than there should be.
  evaluates_ = last_ > 0 && slow * change_ > last_ && (change_ > tolerance_ || (updated_ ? small_ : sweep) > 10) &&
               evaluation_pays();
  set(last_, change_);
}

template <Scalar S>
bool NewtonCourse<S>::evaluation_pays() const {
  if (!updated_) return true;
  // No patience where they do not fall at all: it may be rounding, which shows by the Jacobian of the iterate itself.
  if (change_ <= coarse_ && (exact_ ? !(2 * change_ < last_) : rises_ > 1)) return true;
  // The first falls do not decide: updates come to bear on the next.
  constexpr int undecided = 4;
  if (falls_ < undecided && change_ < 2 * last_) return false;
  constexpr int sweeps_with_it = 2;
  const double bits = std::log2(approximately(S(change_ / tolerance_)));
  const double bits_a_sweep = falls_ > 0 ? std::log2(approximately(S(first_ / change_))) / falls_
                                         : std::log2(approximately(S(last_ / change_)));
  return !(bits <= (sweeps_an_evaluation_ + sweeps_with_it) * bits_a_sweep);
}

#define HBVM_DEFINE(S) template class NewtonCourse<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
