#include <arb_hypgeom.h>
#include <fmt/format.h>

#include "basis/gauss_legendre.hpp"
#include "groups.hpp"
#include "raw_cost.hpp"

namespace hbvm::core::speed {
namespace {

double seconds_of_arb(long n, long bits) {
  arb_t node, weight;
  arb_init(node);
  arb_init(weight);
  const double seconds = seconds_of([&] {
    for (long i = 0; i < n; ++i)
      arb_hypgeom_legendre_p_ui_root(node, weight, static_cast<ulong>(n), static_cast<ulong>(i), bits);
  });
  arb_clear(node);
  arb_clear(weight);
  return seconds;
}

template <Scalar S>
Row row(int n, const std::string& precision, int digits) {
  const double own = seconds_of([&] { (void)gauss_legendre<S>(n); }), arb = seconds_of_arb(n, significand_bits<S>());
  return {fmt::format("{} nodes, {}", n, precision),
          "Arb, every node",
          own / arb,
          n <= 100 && digits <= 100 ? 1.0 : 2.0,
          false,
          fmt::format("{:.3g} and {:.3g} us", own * 1e6, arb * 1e6)};
}

}  // namespace

std::vector<Row> node_rows() {
  std::vector<Row> rows;
  for (const int n : {20, 100, 500}) {
    rows.push_back(row<double>(n, "double", 16));
    rows.push_back(row<Quad>(n, "quad", 34));
    for (const unsigned digits : {50U, 100U, 1000U}) {
      const PrecisionScope scope(digits);
      rows.push_back(row<Mpfr>(n, fmt::format("mpfr:{}", digits), static_cast<int>(digits)));
    }
  }
  return rows;
}

}  // namespace hbvm::core::speed
