#include "step/quadrature_defect.hpp"

#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
QuadratureDefect<S>::Nodes::Nodes(const Problem<S>& problem, int k, int s)
    : method(make_hbvm<S>(k, s)), equations(problem, method), psi(equations.make_unknowns().psi) {}

template <Scalar S>
QuadratureDefect<S>::QuadratureDefect(const Problem<S>& problem, int k, int s)
    : problem_(problem), few_(problem, k, s), more_(problem, k + s, s), unit_(S(16 * (k + s)) * epsilon<S>()) {
  using std::sqrt;
  least_ = 4 * sqrt(S(k + s)) * epsilon<S>();
}

template <Scalar S>
const S& QuadratureDefect<S>::measure(const StepStart<S>& start, const StageUnknowns<S>& x) {
  for (Nodes* nodes : {&few_, &more_}) {
    nodes->equations.start({start.q, start.p, start.h});
    nodes->equations.move(x.gamma);
    nodes->equations.forces(nodes->psi);
  }
  set_zero(relative_);
  for (const SpaceBlock& block : problem_.blocks) {
    set_zero(size_);
    set_zero(difference_);
    for (Index j = block.offset; j < block.offset + problem_.dimension; ++j)
      for (Index i = 0; i < x.psi.rows(); ++i) {
        set_difference(t_, few_.psi(i, j), more_.psi(i, j));
        raise_magnitude(difference_, t_);
        raise_magnitude(size_, more_.psi(i, j));
        raise_magnitude(size_, x.zeta(i, j));
      }
    if (difference_ == 0) continue;
    set_quotient(t_, difference_, size_);
    raise_magnitude(relative_, t_);
  }
  set_quotient(defect_, relative_, unit_);
  return defect_;
}

#define HBVM_DEFINE(S) template class QuadratureDefect<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
