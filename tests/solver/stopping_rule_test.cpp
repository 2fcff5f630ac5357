#include "solver/stopping_rule.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <functional>

#include "interrupting.hpp"
#include "printing.hpp"
#include "scalar/binary_exponent.hpp"

namespace hbvm::core {
namespace {

constexpr long roundings = 100;

/// Coordinates whose changes, sweep by sweep, are given; the terms behind each have a size of their own.
template <Scalar S>
class Sequence {
 public:
  using Rule = StoppingRule<S>;
  using Verdict = typename Rule::Verdict;

  explicit Sequence(std::vector<S> sizes, int least_rate_bits = 10)
      : rule(static_cast<Index>(sizes.size()), roundings, least_rate_bits),
        sizes_(Eigen::Map<const Vector<S>>(sizes.data(), static_cast<Index>(sizes.size()))),
        terms_(sizes_.transpose()),
        positions_(Vector<S>::Zero(sizes_.size())) {}

  Vector<S>& positions() { return positions_; }

  /// \return the verdict of the last of so many sweeps at most, change(sweep, coordinate) over the size being the
  /// change
  Verdict run(long sweeps, const std::function<S(long, Index)>& change) {
    rule.start(sizes_, positions_);
    Verdict verdict = Verdict::go_on;
    for (long n = 1; n <= sweeps && verdict == Verdict::go_on; ++n) {
      for (Index j = 0; j < sizes_.size(); ++j) rule.show_change(j, S(change(n, j) * sizes_[j]));
      rule.show_terms(terms_);
      verdict = rule.judge();
    }
    return verdict;
  }

  Rule rule;

 private:
  Vector<S> sizes_;
  Matrix<S> terms_;
  Vector<S> positions_;
};

template <class S>
class StoppingRuleTest : public InDigits<50> {};
TYPED_TEST_SUITE(StoppingRuleTest, AllScalars, ScalarNames);

/// A step that nearly every step is like is finished first.
TYPED_TEST(StoppingRuleTest, IsEndedByASignalAfterManySweeps) {
  using S = TypeParam;
  Sequence<S> sequence({1});
  const auto falls_slowly = [](long n, Index) { return S(1) / S(n); };
  interruption = SIGTERM;
  EXPECT_EQ(sequence.run(100, falls_slowly), Sequence<S>::Verdict::go_on);
  EXPECT_THROW(sequence.run(101, falls_slowly), Interrupted);
  interruption = 0;
}

/// 2^-(bits n), and what is left after sweep n is 2^-bits of it: the first n with 2^-(bits (n + 1)) <= 2^-12 epsilon.
TYPED_TEST(StoppingRuleTest, EndsWhereTheNextChangeIsBelow2ToTheMinus12OfRoundOff) {
  using S = TypeParam;
  const long round_off = significand_bits<S>() - 1 + 12;
  for (const long bits : {2L, 5L, 8L}) {
    Sequence<S> sequence({S(1), power_of_two<S>(-60), power_of_two<S>(70)});
    EXPECT_EQ(sequence.run(10000, [&](long n, Index) { return power_of_two<S>(-bits * n); }),
              Sequence<S>::Verdict::converged);
    EXPECT_EQ(sequence.rule.sweeps(), (round_off + bits - 1) / bits - 1) << bits;
  }
}

/// A light coordinate is no less worth than a heavy one.
TYPED_TEST(StoppingRuleTest, WaitsForTheSmallestCoordinate) {
  using S = TypeParam;
  for (const int exponent : {0, -30, -200}) {
    Sequence<S> sequence({S(1), power_of_two<S>(exponent)});
    const auto change = [](long n, Index j) { return j == 0 ? S(0) : power_of_two<S>(-n); };
    EXPECT_EQ(sequence.run(10000, change), Sequence<S>::Verdict::converged);
    EXPECT_EQ(sequence.rule.sweeps(), significand_bits<S>() - 1 + 12 - 1) << exponent;
  }
}

/// Rounding is taken for what it is once it has not fallen for two sweeps, up to C epsilon and no further.
TYPED_TEST(StoppingRuleTest, TakesWhatDoesNotFallForRoundingBelowItsBoundOnly) {
  using S = TypeParam;
  const auto noise = [](long of_bound) {
    return [of_bound](long n, Index) {
      return n == 1 ? power_of_two<S>(-4) : S(S(of_bound) / 8 * S(roundings) * epsilon<S>());
    };
  };
  Sequence<S> below({S(3)}), above({S(3)});
  EXPECT_EQ(below.run(1000, noise(7)), Sequence<S>::Verdict::converged);
  EXPECT_EQ(below.rule.sweeps(), 4);  // it fell to that in the second sweep, and not in the third and fourth
  EXPECT_EQ(above.run(1000, noise(9)), Sequence<S>::Verdict::stagnant);
  EXPECT_GT(above.rule.sweeps(), StoppingRule<S>::patience);
  EXPECT_STREQ(above.rule.failure(StoppingRule<S>::Verdict::stagnant).what(), "the increments stagnate");
  EXPECT_GT(above.rule.condition_wanted(), 1);
  EXPECT_LT(above.rule.condition_wanted(), 2);
}

/// Sweeps without a least change are counted from the last one on, and a rise is one more, whatever came before.
TYPED_TEST(StoppingRuleTest, CountsTheSweepsSinceALeastChange) {
  using S = TypeParam;
  using Rule = StoppingRule<S>;
  Sequence<S> stays({S(1), power_of_two<S>(-30)});
  EXPECT_EQ(stays.run(1000, [](long n, Index) { return power_of_two<S>(-std::min(n, 10L)); }), Rule::Verdict::stagnant);
  EXPECT_EQ(stays.rule.sweeps(), 10 + Rule::patience);
  Sequence<S> creeps({S(1), power_of_two<S>(-30)});
  const auto above = [](long n, Index) { return n <= 10 ? power_of_two<S>(-n) : S(S(2000 - n) / 2000 / 128); };
  EXPECT_EQ(creeps.run(1000, above), Rule::Verdict::stagnant);
  EXPECT_EQ(creeps.rule.sweeps(), 10 + Rule::patience);
  Sequence<S> rises({S(1), power_of_two<S>(-30)});
  const auto change = [](long n, Index) { return power_of_two<S>(n <= 10 ? -n : n == 11 ? -5 : -6); };
  EXPECT_EQ(rises.run(1000, change), Rule::Verdict::stagnant);
  EXPECT_EQ(rises.rule.sweeps(), 12 + Rule::patience - 1);
}

/// The bound is relative to what positions are rounded to, too, if that is more, and to the condition.
TYPED_TEST(StoppingRuleTest, RoundingOfPositionsAndConditionRaiseTheBound) {
  using S = TypeParam;
  const auto noise = [](long n, Index) {
    return n == 1 ? power_of_two<S>(-4) : S(S(1000) * S(roundings) * epsilon<S>());
  };
  Sequence<S> sequence({S(3)});
  sequence.positions()[0] = 3001;
  EXPECT_EQ(sequence.run(1000, noise), Sequence<S>::Verdict::converged);
  sequence.positions()[0] = 2999;
  EXPECT_EQ(sequence.run(1000, noise), Sequence<S>::Verdict::stagnant);
}

/// One fall is no rate: below the least one nothing is believed.
TYPED_TEST(StoppingRuleTest, ExpectsNoFallBeyondTheLeastRate) {
  using S = TypeParam;
  Sequence<S> sequence({S(1)});
  const int half = significand_bits<S>() / 2;
  // Two falls to half of the digits each would promise an end after the second sweep.
  const auto change = [&](long n, Index) { return power_of_two<S>(-half * (n - 1) - 14); };
  EXPECT_EQ(sequence.run(2, change), Sequence<S>::Verdict::go_on);
  Sequence<S> bold({S(1)}, half);
  EXPECT_EQ(bold.run(2, change), Sequence<S>::Verdict::converged);
}

/// The rate is the slowest of the last two sweeps: changes may fall unevenly.
TYPED_TEST(StoppingRuleTest, IsNotMisledByUnevenFalls) {
  using S = TypeParam;
  Sequence<S> even({S(1)}), uneven({S(1)});
  even.run(10000, [](long n, Index) { return power_of_two<S>(-4 * n); });
  uneven.run(10000, [](long n, Index) { return power_of_two<S>(-8 * (n / 2) - 1); });
  EXPECT_GE(uneven.rule.sweeps(), even.rule.sweeps() + 1);
}

/// A coordinate that goes to 0 changes by all it is, for ever.
TYPED_TEST(StoppingRuleTest, DoesNotWaitForWhatVanishes) {
  using S = TypeParam;
  StoppingRule<S> rule(2, roundings);
  Vector<S> p0(2), positions(2);
  p0 << S(1), S(0);
  positions << S(8), S(8);
  rule.start(p0, positions);
  auto verdict = StoppingRule<S>::Verdict::go_on;
  for (long n = 1; n < 1000 && verdict == StoppingRule<S>::Verdict::go_on; ++n) {
    Matrix<S> terms(1, 2);
    terms << S(1), power_of_two<S>(-20 - 6 * n);
    rule.show_change(0, power_of_two<S>(-6 * n));
    rule.show_change(1, S(63 * terms(0, 1)));
    rule.show_terms(terms);
    verdict = rule.judge();
  }
  EXPECT_EQ(verdict, StoppingRule<S>::Verdict::converged);
  EXPECT_LE(rule.sweeps(), (significand_bits<S>() + 12) / 6 + 3);
}

/// What is below the rounding of its positions altogether is as good as it gets once what is left is 2^-12 of that. Not
/// so where changes fall slowly: they may be of a body that hardly moves.
TYPED_TEST(StoppingRuleTest, AsksNoMoreOfWhatIsRoundingThanOfItsPositions) {
  using S = TypeParam;
  const long places = significand_bits<S>() - 1;
  // Of two coordinates, the other one 2^-12 ahead; in the third sweep the change is 2^10 epsilon.
  const auto sweeps = [&](long bits, long size_bits) {
    Sequence<S> sequence({S(1), power_of_two<S>(size_bits)}, 30);
    sequence.positions().setOnes();
    const auto change = [&](long n, Index j) {
      return power_of_two<S>(10 - places - bits * (n - 3) - (j == 0 ? 12 : size_bits));
    };
    EXPECT_EQ(sequence.run(999, change), Sequence<S>::Verdict::converged);
    return sequence.rule.sweeps();
  };
  const long below_rounding = 6 - places;  // 64 epsilon, where C is 100
  EXPECT_EQ(sweeps(24, 0), 3);             // 2^-14 epsilon is left
  EXPECT_EQ(sweeps(24, -4), 4);
  EXPECT_EQ(sweeps(24, below_rounding), 3);
  EXPECT_EQ(sweeps(20, below_rounding), 4);  // 2^-10 epsilon is left after three
  EXPECT_GT(sweeps(4, below_rounding), 8);   // after which 2^-14 epsilon is left
}

/// Rounding of a position is in changes that are no longer those of the iteration. They may go on to become a little
/// smaller, sweep by sweep, and never stand still.
TYPED_TEST(StoppingRuleTest, EndsWhereAFastFallStopsWithinRounding) {
  using S = TypeParam;
  const long places = significand_bits<S>() - 1;
  // Of a position 2^20 as large as its momentum. Three changes fall by 2^-bits to `end` epsilon, and go on from 2^16.
  const auto sweeps_beyond = [&](long bits, long end, int least_rate_bits = 30) {
    Sequence<S> sequence({S(1)}, least_rate_bits);
    sequence.positions()[0] = power_of_two<S>(20);
    S rounding = power_of_two<S>(16 - places);
    const auto change = [&](long n, Index) {
      return n <= 3 ? power_of_two<S>(end - places + bits * (3 - n)) : rounding = rounding * 7 / 8;
    };
    EXPECT_EQ(sequence.run(999, change), Sequence<S>::Verdict::converged);
    return sequence.rule.sweeps() - 3;
  };
  EXPECT_EQ(sweeps_beyond(14, 17), 1);  // 8 epsilon is due
  EXPECT_EQ(sweeps_beyond(11, 17), 2);  // 64 epsilon, and then 2^-5
  EXPECT_EQ(sweeps_beyond(11, 28), 3);  // from above rounding, which is 100 2^20 epsilon
  // The fixed point's may fall fast once, and slowly from then on.
  EXPECT_GT(sweeps_beyond(14, 17, 10), 40);
  // Where they fell slowly, or were within rounding from the first, they may be those of a body that hardly moves.
  EXPECT_GT(sweeps_beyond(9, 20), 40);
  EXPECT_GT(sweeps_beyond(4, 17), 40);
  Sequence<S> beside({S(1), S(1)}, 30);
  beside.positions()[1] = power_of_two<S>(20);
  S slow = power_of_two<S>(16 - places);
  EXPECT_EQ(beside.run(999, [&](long n, Index j) { return j == 0 ? power_of_two<S>(-20 * n) : slow = slow * 7 / 8; }),
            Sequence<S>::Verdict::converged);
  EXPECT_GT(beside.rule.sweeps(), 40);
}

/// What is due falls on: a change within rounding that is no greater than that is one of the iteration.
TYPED_TEST(StoppingRuleTest, AFastFallWithinRoundingIsFollowedToItsEnd) {
  using S = TypeParam;
  const long round_off = significand_bits<S>() - 1 + 12, bits = 11;
  Sequence<S> sequence({S(1)}, 30);
  sequence.positions()[0] = power_of_two<S>(20);
  EXPECT_EQ(sequence.run(999, [&](long n, Index) { return power_of_two<S>(-bits * n); }),
            Sequence<S>::Verdict::converged);
  EXPECT_EQ(sequence.rule.sweeps(), (round_off + bits - 1) / bits - 1);
}

/// A change that may be rounding says nothing of how far an iteration has come, however small its coordinate is.
TYPED_TEST(StoppingRuleTest, ChangesThatAreRoundingAreNotCoarse) {
  using S = TypeParam;
  const auto is_coarse = [](const S& size, const S& change) {
    Sequence<S> sequence({S(1), size});
    sequence.positions().setOnes();
    sequence.run(1, [&](long, Index j) { return j == 0 ? power_of_two<S>(-11) : S(change / size); });
    return sequence.rule.is_coarse();
  };
  const S round_off = S(roundings) * epsilon<S>(), below = round_off / 2;
  EXPECT_FALSE(is_coarse(below, S(below / 2)));
  EXPECT_FALSE(is_coarse(below, round_off));
  EXPECT_TRUE(is_coarse(below, S(2 * round_off)));
  EXPECT_FALSE(is_coarse(S(1), power_of_two<S>(-10)));
  EXPECT_TRUE(is_coarse(S(1), power_of_two<S>(-9)));
  EXPECT_TRUE(is_coarse(power_of_two<S>(-20), power_of_two<S>(-29)));
}

TYPED_TEST(StoppingRuleTest, EndsTypedWhereNothingConverges) {
  using S = TypeParam;
  using Verdict = typename StoppingRule<S>::Verdict;
  Sequence<S> sequence({S(1), S(1)});
  using std::sqrt;
  EXPECT_EQ(sequence.run(100000, [](long n, Index) { return S(S(1) / S(n)); }), Verdict::endless);
  EXPECT_EQ(sequence.run(100000, [](long n, Index j) { return j == 0 ? S(0) : power_of_two<S>(n % 500); }),
            Verdict::stagnant);
  EXPECT_STREQ(sequence.rule.failure(Verdict::stagnant).what(), "the increments grow");
  // Overflow is looked for before convergence: one coordinate that is still says nothing of another.
  const S infinity = S(1) / S(0);
  EXPECT_EQ(sequence.run(5, [&](long, Index j) { return j == 0 ? S(0) : infinity; }), Verdict::not_finite);
  EXPECT_EQ(sequence.run(5, [&](long, Index j) { return j == 1 ? S(0) : S(infinity - infinity); }),
            Verdict::not_finite);
  for (const S& lost : {infinity, S(infinity - infinity)})
    EXPECT_EQ(sequence.run(9, [&](long n, Index j) { return j == 1 && n > 3 ? lost : power_of_two<S>(-n); }),
              Verdict::not_finite);
}

/// Changes that begin small and rise with those of another coordinate are no divergence.
TYPED_TEST(StoppingRuleTest, ForgivesAFirstChangeOfNothing) {
  using S = TypeParam;
  Sequence<S> sequence({S(1), S(1)});
  const auto change = [](long n, Index j) { return j == 1 && n < 4 ? S(0) : power_of_two<S>(-n); };
  EXPECT_EQ(sequence.run(100000, change), Sequence<S>::Verdict::converged);
}

}  // namespace
}  // namespace hbvm::core
