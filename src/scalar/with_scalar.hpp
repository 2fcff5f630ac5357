#pragma once

#include <utility>

#include "scalar/precision.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// Calls `f.operator()<S>()` with the scalar that `precision` names, inside a PrecisionScope of its digits. This is the
/// only place where the choice made at run time becomes a type. What f returns must hold no scalar, so that nothing
/// outlives its working precision:
///
///     std::string pi = with_scalar(Precision::parse("mpfr:50"),
///                                  []<Scalar S>() { return to_text(literal<S>("pi")); });
template <class F>
auto with_scalar(const Precision& precision, F&& f) {
  static_assert(!Scalar<decltype(f.template operator()<double>())>, "return text or a Table, not a scalar");
  switch (precision.kind()) {
    case Precision::Kind::binary64:
      return std::forward<F>(f).template operator()<double>();
    case Precision::Kind::binary128:
#if HBVM_QUAD
      return std::forward<F>(f).template operator()<Quad>();
#endif
    case Precision::Kind::mpfr:
      break;
  }
  const PrecisionScope scope(precision.digits());
  return std::forward<F>(f).template operator()<Mpfr>();
}

}  // namespace hbvm::core
