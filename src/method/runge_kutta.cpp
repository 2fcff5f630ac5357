#include "method/runge_kutta.hpp"

#include "hbvm/error.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
S entry(const Number& number, const std::string& place) {
  try {
    return literal<S>(number.text());
  } catch (const ExpressionError& error) {
    throw InputError(place + " has no value: " + error.what());
  }
}

std::string at(std::size_t i) { return "[" + std::to_string(i + 1) + "]"; }

}  // namespace

template <Scalar S>
RungeKutta<S> make_runge_kutta(const Tableau& tableau) {
  const std::size_t s = tableau.b.size();
  if (s == 0) throw InputError("a Runge-Kutta method has at least one stage");
  const std::string size = std::to_string(s);
  bool square = tableau.A.size() == s;
  for (const auto& row : tableau.A) square = square && row.size() == s;
  if (!square) throw InputError("A must be " + size + " x " + size + ", as b has " + size + " entries");
  if (tableau.c.size() != s)
    throw InputError("c has " + std::to_string(tableau.c.size()) + " entries, but b has " + size);
  const auto n = static_cast<Index>(s);
  RungeKutta<S> r{Matrix<S>(n, n), Vector<S>(n), Vector<S>(n)};
  for (std::size_t i = 0; i < s; ++i) {
    const auto row = static_cast<Index>(i);
    for (std::size_t j = 0; j < s; ++j)
      r.A(row, static_cast<Index>(j)) = entry<S>(tableau.A[i][j], "A" + at(i) + at(j));
    r.b[row] = entry<S>(tableau.b[i], "b" + at(i));
    r.c[row] = entry<S>(tableau.c[i], "c" + at(i));
  }
  return r;
}

#define HBVM_DEFINE(S) template RungeKutta<S> make_runge_kutta<S>(const Tableau&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
