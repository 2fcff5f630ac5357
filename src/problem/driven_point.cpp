#include "problem/driven_point.hpp"

namespace hbvm::core {

template <Scalar S>
DrivenPoint<S> clock_point(std::string name, Index dimension) {
  constexpr std::uint32_t zero = 0, one = 1;
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<Operand> outputs(3 * d, Operand{Bank::constant, zero});
  outputs[0] = {Bank::input, 0};
  outputs[d] = {Bank::constant, one};
  return {std::move(name), Program<S>({S(0), S(1)}, {}, std::move(outputs), 0)};
}

template <Scalar S>
DrivenPoint<double> in_double(const DrivenPoint<S>& point) {
  return {point.name, in_double(point.course)};
}

#define HBVM_DEFINE(S)                                             \
  template DrivenPoint<S> clock_point<S>(std::string name, Index); \
  template DrivenPoint<double> in_double<S>(const DrivenPoint<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
