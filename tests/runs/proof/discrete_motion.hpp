#pragma once

#include "integrate/time_grid.hpp"
#include "run/proof/proved_course.hpp"
#include "scalar/literal.hpp"
#include "step/hbvm_method.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

/// A motion by the ordinary stepper with 30 digits more than the scope, or with a method that is a little wrong.
class DiscreteMotion {
 public:
  DiscreteMotion(const Scene& scene, const HbvmName& name, const std::string& h,
                 std::optional<Perturbation> perturbation = {})
      : more_(static_cast<unsigned>(digits10<Mpfr>()) + 30),
        scene_(assemble<Mpfr>(scene)),
        method_(HbvmMethod(name, std::move(perturbation)).coefficients<Mpfr>(name.r)),
        h_(evaluate<Mpfr>(Expression::parse(h), scene.constants)),
        stepper_(scene_.problem, method_, SolverKind::automatic),
        state_(scene_.q0, scene_.p0) {}

  void step() { multiplier_ = *stepper_.step(state_, h_).multiplier; }
  const State<Mpfr>& state() const { return state_; }
  const Vector<Mpfr>& multiplier() const { return multiplier_; }
  const Problem<Mpfr>& problem() const { return scene_.problem; }

 private:
  PrecisionScope more_;
  Assembled<Mpfr> scene_;
  Hbvm<Mpfr> method_;
  Mpfr h_;
  HbvmStepper<Mpfr> stepper_;
  State<Mpfr> state_;
  Vector<Mpfr> multiplier_;
};

}  // namespace hbvm::core
