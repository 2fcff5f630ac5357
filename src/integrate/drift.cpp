#include "integrate/drift.hpp"

#include "scalar/text.hpp"

namespace hbvm::core {

template <Scalar S>
void Drift<S>::observe(const Snapshot<S>& snapshot) {
  const S H = point_.energy(snapshot.q, snapshot.p);
  if (snapshot.n == 0) H0_ = H;
  raise_to(e_H_, magnitude(S(H - H0_)));
  const S balance = H + point_.account(snapshot.p);
  if (snapshot.n == 0) B0_ = balance;
  raise_to(e_B_, magnitude(S(balance - B0_)));
  raise_to(e_g_, max_norm(point_.constraints(snapshot.q)));
  raise_to(e_hid_, max_norm(point_.hidden_constraints(snapshot.q, snapshot.p)));
  if (!redundant_.empty()) watch_redundant(snapshot);
  if (!is_finite(S(e_H_ + e_B_ + e_g_ + e_hid_)))
    throw NotFinite("step " + std::to_string(snapshot.n) + ", t = " + to_text(snapshot.t));
}

template <Scalar S>
void Drift<S>::watch_redundant(const Snapshot<S>& snapshot) {
  using std::sqrt;
  raise_to(e_hid_, max_norm(redundant_.hidden(snapshot.q, snapshot.p)));
  const Vector<S>& g = redundant_.values(snapshot.q);
  raise_to(e_g_, max_norm(g));
  for (Index r = 0; r < g.size(); ++r) {
    const S size = redundant_.sizes()[r], violation = magnitude(g[r]);
    if (violation > 0) raise_to(redundancy_, S(violation / size));
    if (violation <= sqrt(epsilon<S>()) * size) continue;
    const std::string name = redundant_.name(static_cast<std::size_t>(r));
    throw RedundancyLost("step " + std::to_string(snapshot.n) + ", t = " + to_text(snapshot.t) + ": " +
                             std::string(name_of(FailureCause::inconsistent_state)) + ": constraint " +
                             std::to_string(redundant_.places()[static_cast<std::size_t>(r)] + 1) + " (" + name +
                             ") follows from the others at the start only: it is violated by " +
                             to_scientific(g[r], 3) + ", with terms of " + to_scientific(size, 3) +
                             "; start where they are independent, or leave it out",
                         name, to_text(snapshot.t));
  }
}

#define HBVM_DEFINE(S) template class Drift<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
