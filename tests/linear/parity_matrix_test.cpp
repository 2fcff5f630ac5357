#include "linear/parity_matrix.hpp"

#include "method/hbvm.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ParityMatrices : public InDigits<50> {};
TYPED_TEST_SUITE(ParityMatrices, AllScalars, ScalarNames);

template <Scalar S>
Matrix<S> some(Index rows, Index columns) {
  Matrix<S> b(rows, columns);
  for (Index i = 0; i < b.size(); ++i) b.data()[i] = S(1 + i * i % 7) / S(3 + i);
  return b;
}

/// The products as they stand, entry by entry. Each entry of b is at most 1, and of a as well but for a factor 2 sqrt.
template <Scalar S>
void expect_product(ParityMatrix<S>& parity, const Matrix<S>& a, const char* what) {
  const Matrix<S> b = some<S>(a.cols(), 3);
  Matrix<S> c;
  parity.times(c, b);
  ASSERT_EQ(c.rows(), a.rows());
  ASSERT_EQ(c.cols(), 3);
  for (Index j = 0; j < 3; ++j)
    for (Index i = 0; i < a.rows(); ++i) {
      S expected = 0, size = 0;
      for (Index l = 0; l < a.cols(); ++l) {
        expected += a(i, l) * b(l, j);
        size += magnitude(S(a(i, l) * b(l, j)));
      }
      EXPECT_LE(magnitude(S(c(i, j) - expected)), S(4 * (a.cols() + 2)) * epsilon<S>() * (size + 1))
          << what << " at " << i << ", " << j;
    }
}

/// k odd and even, equal to s and not: even and odd functions, with a middle node and without.
TYPED_TEST(ParityMatrices, MultiplyAsTheMatricesOfAMethodDo) {
  using S = TypeParam;
  using Parity = ParityMatrix<S>;
  for (const auto& [k, s] :
       {std::pair(1, 1), {2, 1}, {5, 1}, {2, 2}, {3, 2}, {3, 3}, {6, 4}, {7, 5}, {16, 12}, {25, 20}, {26, 26}}) {
    SCOPED_TRACE(std::to_string(k) + "," + std::to_string(s));
    const Hbvm<S> method = make_hbvm<S>(k, s);
    Parity P(method.P_s, Parity::Nodes::rows, Parity::First::even);
    const bool small = std::same_as<S, double> && k * s < 256;
    EXPECT_EQ(P.is_mirrored(), !small || s * s >= 256);
    expect_product(P, method.P_s, "P_s");
    Matrix<S> centred = method.I_hat;
    for (Index i = 0; i < centred.rows(); ++i) centred(i, 0) -= S(1) / 2;
    for (Index i = 0; 2 * i < centred.rows(); ++i) centred(centred.rows() - 1 - i, 0) = -centred(i, 0);
    Parity I(centred, Parity::Nodes::rows, Parity::First::odd);
    EXPECT_EQ(I.is_mirrored(), !small);
    expect_product(I, centred, "I_hat");
    Parity projection(method.projection_hat, Parity::Nodes::columns, Parity::First::even);
    EXPECT_EQ(projection.is_mirrored(), !small);
    expect_product(projection, method.projection_hat, "the projection");
  }
}

/// What mirrors is exactly mirrored in the products, whatever the rounding: a symmetric method stays one.
TYPED_TEST(ParityMatrices, MirrorExactly) {
  using S = TypeParam;
  using Parity = ParityMatrix<S>;
  const Index s = 17;
  const Hbvm<S> method = make_hbvm<S>(s, s);
  Parity P(method.P_s, Parity::Nodes::rows, Parity::First::even);
  EXPECT_TRUE(P.is_mirrored());
  Matrix<S> b = some<S>(s, 1), reversed = b, there, back;
  for (Index i = 1; i < s; i += 2) reversed(i, 0) = -b(i, 0);
  P.times(there, b);
  P.times(back, reversed);
  for (Index i = 0; i < s; ++i) EXPECT_EQ(there(i, 0), back(s - 1 - i, 0));
}

/// A wrong entry is not mirrored away.
TYPED_TEST(ParityMatrices, LeaveAMatrixThatDoesNotMirrorAsItIs) {
  using S = TypeParam;
  using Parity = ParityMatrix<S>;
  const Hbvm<S> method = make_hbvm<S>(18, 16);
  for (const bool last : {false, true}) {
    Matrix<S> wrong = method.P_s;
    S& entry = wrong(last ? 15 : 0, 2);
    entry += 32 * epsilon<S>() * entry;
    Parity P(wrong, Parity::Nodes::rows, Parity::First::even);
    EXPECT_FALSE(P.is_mirrored());
    expect_product(P, wrong, "a wrong matrix");
    EXPECT_EQ(P.operations(5)[Op::multiply], 5u * 256);
  }
  Parity signs(method.P_s, Parity::Nodes::rows, Parity::First::odd);
  EXPECT_FALSE(signs.is_mirrored());
}

TYPED_TEST(ParityMatrices, TakeHalfOfTheMultiplications) {
  using S = TypeParam;
  using Parity = ParityMatrix<S>;
  const Hbvm<S> method = make_hbvm<S>(17, 16);
  const Parity projection(method.projection_hat, Parity::Nodes::columns, Parity::First::even);
  // Eight even functions at nine nodes, eight odd ones at eight; eight sums and eight differences before.
  EXPECT_EQ(projection.operations(7)[Op::multiply], 7u * (8 * 9 + 8 * 8));
  EXPECT_EQ(projection.operations(7)[Op::add], 7u * (8 * 8 + 8 * 7 + 8));
  EXPECT_EQ(projection.operations(7)[Op::subtract], 7u * 8);
}

}  // namespace
}  // namespace hbvm::core
