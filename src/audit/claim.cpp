#include "audit/claim.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace hbvm::core {
namespace {

/// Where the statements of these labels stand in print, as studies/equations.md has it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> statements{{{"hidcons", "(15)"},
                                                                                    {"gheq0", "Theorem 2"},
                                                                                    {"evai", "Theorem 3"},
                                                                                    {"dlamj", "Theorem 4"},
                                                                                    {"simme", "Lemma 3"},
                                                                                    {"ord2s", "Theorem 5"},
                                                                                    {"norm", "Corollary 2"},
                                                                                    {"ordlam", "Theorem 6"},
                                                                                    {"costo", "Remark 3"},
                                                                                    {"evaik", "Theorem 8"},
                                                                                    {"ord2sk", "Theorem 9"},
                                                                                    {"normk", "Corollary 3"},
                                                                                    {"ordlamk", "Theorem 10"}}};

}  // namespace

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

std::string readable(const std::string& label) {
  const std::size_t end = label.find(',');
  const std::string statement = label.substr(0, end);
  for (const auto& [known, printed] : statements)
    if (statement == known)
      return std::string(printed) + " (" + statement + ")" + (end == std::string::npos ? "" : label.substr(end));
  return label;
}

}  // namespace hbvm::core
