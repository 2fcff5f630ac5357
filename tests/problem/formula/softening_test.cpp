#include "problem/formula/softening.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

/// exp x + tanh(exp x), whose exponential overwrites nothing that is read again.
Program<Mpfr> exponentials() {
  return {{},
          {{Op::exp, {Bank::input, 0}, {}, 0},
           {Op::tanh, {Bank::temporary, 0}, {}, 1},
           {Op::add, {Bank::temporary, 0}, {Bank::temporary, 1}, 0}},
          {{Bank::temporary, 0}},
          2};
}

TEST(Softening, MultipliesTheExponents) {
  const PrecisionScope digits(50);
  const Program<Mpfr> half = with_exponents_times(Mpfr(1) / 2, exponentials());
  ASSERT_EQ(half.outputs(), 3u);
  const Mpfr x = 3;
  const std::vector<const Mpfr*> inputs{&x};
  Matrix<Mpfr> registers = half.make_registers(1);
  half.run(registers, inputs);
  const Mpfr e = exp(Mpfr(x / 2));
  EXPECT_EQ(half.output(0, 0, registers, inputs), Mpfr(e + tanh(Mpfr(e / 2))));
  EXPECT_EQ(half.output(1, 0, registers, inputs), Mpfr(x / 2));
  EXPECT_EQ(half.output(2, 0, registers, inputs), Mpfr(e / 2));
}

TEST(Softening, LeavesOtherFunctionsAlone) {
  const PrecisionScope digits(50);
  const Program<Mpfr> sine({}, {{Op::sin, {Bank::input, 0}, {}, 0}}, {{Bank::temporary, 0}}, 1);
  const Program<Mpfr> same = with_exponents_times(Mpfr(1) / 2, sine);
  EXPECT_EQ(same.outputs(), 1u);
  EXPECT_EQ(same.instructions().size(), 1u);
}

}  // namespace
}  // namespace hbvm::core
