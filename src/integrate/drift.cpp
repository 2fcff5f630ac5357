#include "hbvm/integrate/drift.hpp"

#include "hbvm/scalar/text.hpp"

namespace hbvm {

template <Scalar S>
void Drift<S>::observe(const Snapshot<S>& snapshot) {
  const S H = point_.energy(snapshot.q, snapshot.p);
  if (snapshot.n == 0) H0_ = H;
  raise_to(e_H_, magnitude(S(H - H0_)));
  raise_to(e_g_, max_norm(point_.constraints(snapshot.q)));
  raise_to(e_hid_, max_norm(point_.hidden_constraints(snapshot.q, snapshot.p)));
  if (!is_finite(S(e_H_ + e_g_ + e_hid_)))
    throw IntegrationError("step " + std::to_string(snapshot.n) + ", t = " + to_text(snapshot.t) +
                           ": the energy or a constraint is not finite; does an effect have a singularity there?");
}

#define HBVM_DEFINE(S) template class Drift<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
