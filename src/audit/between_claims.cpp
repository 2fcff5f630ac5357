#include "audit/claims.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {

std::vector<Claim> between_claims(Extent extent) {
  std::vector<Claim> all;
  const int most = extent == Extent::full ? 6 : 2;
  for (const char* const problem : {"modified_pendulum", "double_pendulum"})
    for (int s = 1; s <= most; ++s)
      for (const int k : {s, s + 1})
        for (const Quantity quantity : {Quantity::q_between, Quantity::p_between, Quantity::lambda_between}) {
          all.push_back(make_claim("between the steps", quantity, problem, Span::interval, Form::at_least, 2 * s));
          all.back().method = hbvm_of({k, s});
        }
  return all;
}

}  // namespace hbvm::core
