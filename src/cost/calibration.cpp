#include "cost/calibration.hpp"

#include "clock.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

double typical_nanoseconds(const Precision& precision) {
  // Sums of products as the solver makes them: binary128 in software, mpfr with what surrounds each operation.
  switch (precision.kind()) {
    case Precision::Kind::binary64:
      return 1;
    case Precision::Kind::binary128:
      return 60;
    case Precision::Kind::mpfr:
      break;
  }
  const double digits = precision.digits();
  return 25 + digits / 4 + digits * digits / 4'000;
}

template <Scalar S>
Calibration<S>::Calibration(const Precision& precision)
    : scene_(assemble<S>(load_scene("tethered_satellites"))), method_(make_hbvm<S>(2, 2)) {
  constexpr double nanoseconds = 3'000'000, operations_of_a_sweep = 600, sweeps_in_double = 9, digits_of_a_sweep = 15;
  const double sweeps = std::same_as<S, double> ? sweeps_in_double : 2 + precision.digits() / digits_of_a_sweep;
  steps_ = 1 + static_cast<long>(nanoseconds / (typical_nanoseconds(precision) * operations_of_a_sweep * sweeps));
}

template <Scalar S>
double Calibration<S>::seconds() const {
  HbvmStepper<S> stepper(scene_.problem, method_, SolverKind::automatic);
  State<S> state(scene_.q0, scene_.p0);
  const S h = S(1) / 10;
  const double before = thread_seconds();
  for (long i = 0; i < steps_; ++i) stepper.step(state, h);
  return thread_seconds() - before;
}

#define HBVM_DEFINE(S) template class Calibration<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
