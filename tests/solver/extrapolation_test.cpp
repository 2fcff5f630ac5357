#include "solver/extrapolation.hpp"

#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ExtrapolationTest : public InDigits<50> {
 protected:
  /// n^degree and, as a second entry, the falling (30 - n)^degree.
  static Vector<S> power(long n, Index degree) {
    Vector<S> x(2);
    x << S(1), S(1);
    for (Index i = 0; i < degree; ++i) {
      x[0] *= S(n);
      x[1] *= S(30 - n);
    }
    return x;
  }
  static Vector<S> prediction(const Extrapolation<S>& sequence, Index size) {
    Vector<S> x(size);
    sequence.predict(x.data());
    return x;
  }
};
TYPED_TEST_SUITE(ExtrapolationTest, AllScalars, ScalarNames);

/// The numbers are whole and below 2^53, so that all is exact. Two elements more than the degree show that the
/// differences beyond it vanish.
TYPED_TEST(ExtrapolationTest, ContinuesPolynomialsExactly) {
  for (Index degree = 0; degree <= Extrapolation<TypeParam>::max_order; ++degree) {
    Extrapolation<TypeParam> sequence(2, 1);
    for (long n = 1; n <= 20; ++n) {
      if (n > degree + 2) {
        EXPECT_EQ(this->prediction(sequence, 2), this->power(n, degree)) << "degree " << degree << ", n = " << n;
        EXPECT_EQ(sequence.order(0), degree) << "n = " << n;
      }
      const Vector<TypeParam> x = this->power(n, degree);
      sequence.add(x.data());
    }
  }
}

/// Of 1, 2, 4, 8, … every difference is half of the one before, so that all are used but the last, which is the error.
TYPED_TEST(ExtrapolationTest, TakesTheOrderThatPredictedTheLastElementBest) {
  using S = TypeParam;
  Extrapolation<S> sequence(1, 1);
  const auto add = [&](long x) {
    const S value(x);
    sequence.add(&value);
  };
  add(1);
  EXPECT_EQ(sequence.order(0), 0);
  EXPECT_EQ(this->prediction(sequence, 1)[0], 1);
  add(2);
  EXPECT_EQ(sequence.order(0), 0) << "a difference alone has predicted nothing yet";
  add(4);
  EXPECT_EQ(sequence.order(0), 1);
  EXPECT_EQ(this->prediction(sequence, 1)[0], 6);
  add(8);
  EXPECT_EQ(sequence.order(0), 2);
  EXPECT_EQ(this->prediction(sequence, 1)[0], 14);
  // After a jump the constant is best: the differences are -1000, -2000, -3000, ….
  sequence.clear();
  for (const long x : {0, 0, 0, 0, 1'000, 0}) add(x);
  EXPECT_EQ(sequence.order(0), 0);
  EXPECT_EQ(this->prediction(sequence, 1)[0], 0);
}

TYPED_TEST(ExtrapolationTest, ForgetsWhatIsCleared) {
  using S = TypeParam;
  Extrapolation<S> sequence(2, 1);
  EXPECT_TRUE(sequence.empty());
  for (long n = 0; n < 12; ++n) sequence.add(this->power(n, 3).data());
  EXPECT_FALSE(sequence.empty());
  sequence.clear();
  EXPECT_TRUE(sequence.empty());
  for (const long n : {5, 6}) sequence.add(this->power(n, 1).data());
  EXPECT_EQ(sequence.order(0), 0);
  EXPECT_EQ(this->prediction(sequence, 2), this->power(6, 1));
  sequence.add(this->power(7, 1).data());
  EXPECT_EQ(this->prediction(sequence, 2), this->power(8, 1));
}

/// The greatest entry counts: the first goes on as n^2, the second jumps.
TYPED_TEST(ExtrapolationTest, JudgesTheWholeVector) {
  using S = TypeParam;
  Extrapolation<S> sequence(2, 1);
  for (const long n : {1, 2, 3, 4, 5}) {
    Vector<S> x(2);
    x << S(n * n), S(n == 4 ? -1'000 : 0);
    sequence.add(x.data());
  }
  EXPECT_EQ(sequence.order(0), 0);
}

/// What is kept of a sequence goes on as the sequence does, to the last bit, with any number of rows.
TYPED_TEST(ExtrapolationTest, GoesOnFromAnArchive) {
  using S = TypeParam;
  for (const Index rows : {1, 3, 7})
    for (const long elements : {1, 2, 6, 15}) {
      Extrapolation<S> sequence(rows, 2), again(rows, 2);
      const auto add = [&](long n) {
        Vector<S> x(2 * rows);
        for (Index i = 0; i < x.size(); ++i) x[i] = 1 / S(3 * n + i + 2);
        sequence.add(x.data());
        return x;
      };
      for (long n = 0; n < elements; ++n) add(n);
      Archive written;
      sequence.remember(written);
      Archive read(written.text());
      again.remember(read);
      read.expect_end();
      for (long n = elements; n < elements + 3; ++n) {
        EXPECT_EQ(this->prediction(again, 2 * rows), this->prediction(sequence, 2 * rows)) << rows << " rows, " << n;
        again.add(add(n).data());
      }
    }
}

}  // namespace
}  // namespace hbvm::core
