#include "hbvm/integrate/quadrature_defect.hpp"

#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
QuadratureDefect<S>::Nodes::Nodes(const Problem<S>& problem, int k, int s, const S& step)
    : method(make_hbvm<S>(k, s)), equations(problem, method, step), psi(equations.make_unknowns().psi) {}

template <Scalar S>
QuadratureDefect<S>::QuadratureDefect(const Problem<S>& problem, int k, int s, const S& step)
    : problem_(problem),
      few_(problem, k, s, step),
      more_(problem, k + s, s, step),
      unit_(S(16 * (k + s)) * epsilon<S>()) {
  using std::sqrt;
  least_ = 4 * sqrt(S(k + s)) * epsilon<S>();
}

template <Scalar S>
const S& QuadratureDefect<S>::measure(const Vector<S>& q, const Vector<S>& p, const StageUnknowns<S>& x) {
  for (Nodes* nodes : {&few_, &more_}) {
    nodes->equations.start(q, p);
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

}  // namespace hbvm
