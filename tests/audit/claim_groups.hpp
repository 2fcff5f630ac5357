#pragma once

#include <initializer_list>

#include "audit/claim_group.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {

/// What one HBVM on one problem is asked for, from one start.
inline ClaimGroup group_of(const std::string& problem, HbvmName method, std::initializer_list<Quantity> quantities,
                           Span span = Span::interval) {
  ClaimGroup group;
  for (const Quantity quantity : quantities) {
    group.claims.push_back(make_claim("test", quantity, problem, span, Form::exactly, 0));
    group.claims.back().method = hbvm_of(method);
  }
  return group;
}

/// Whether rungs bear out this rate, and no other whole one beside it.
inline bool is_rate(const std::vector<Rung>& rungs, int rate) {
  const auto verdict = [&](int predicted) {
    Claim claim;
    claim.form = Form::exactly;
    claim.predicted = predicted;
    return judge(claim, convergence_rate(rungs));
  };
  return verdict(rate) == Verdict::holds && verdict(rate - 1) == Verdict::fails && verdict(rate + 1) == Verdict::fails;
}

}  // namespace hbvm::core
