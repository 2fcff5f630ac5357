#include "hbvm/analysis/audit/claim.hpp"

namespace hbvm {

Claim make_claim(const std::string& label, Quantity quantity, const std::string& problem, Span span, Form form,
                 double predicted) {
  Claim claim;
  claim.label = label;
  claim.quantity = quantity;
  claim.problem = problem;
  claim.span = span;
  claim.form = form;
  claim.predicted = predicted;
  return claim;
}

}  // namespace hbvm
