#include "linear/null_space.hpp"

#include "printing.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

class NullSpace : public InDigits<50> {
 protected:
  RandomValues<Mpfr> random{31};

  static UncertainRow row(std::initializer_list<int> entries) { return {entries.begin(), entries.end()}; }

  /// So many rows of small whole numbers, all of them sums of `rank` ones.
  std::vector<UncertainRow> of_rank(std::size_t rank, std::size_t rows, std::size_t columns) {
    const auto whole = [&](std::size_t n, std::size_t m) {
      std::vector<UncertainRow> a(n, UncertainRow(m));
      for (UncertainRow& r : a)
        for (Uncertain& x : r) x = static_cast<int>(random.whole(-9, 9));
      return a;
    };
    const auto left = whole(rows, rank), right = whole(rank, columns);
    std::vector<UncertainRow> a(rows, UncertainRow(columns));
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t l = 0; l < rank; ++l) a[i][j].value += left[i][l].value * right[l][j].value;
    return a;
  }

  static Mpfr product(const UncertainRow& a, const UncertainRow& x) {
    Mpfr sum = 0;
    for (std::size_t j = 0; j < x.size(); ++j) sum += a[j].value * x[j].value;
    return sum;
  }
};

TEST_F(NullSpace, SolvesWithAsManyRowsAsTheRankLeaves) {
  for (const std::size_t columns : {3u, 6u})
    for (std::size_t rank = 0; rank <= columns; ++rank)
      for (const std::size_t first_of_second : {std::size_t{0}, columns / 2, columns}) {
        const auto a = of_rank(rank, columns + 2, columns);
        const auto x = null_space(a, columns, first_of_second);
        EXPECT_EQ(x.size(), columns - rank);
        for (const UncertainRow& solution : x)
          for (const UncertainRow& equation : a)
            EXPECT_LE(magnitude(product(equation, solution)), sqrt(epsilon<Mpfr>())) << "rank " << rank;
      }
}

TEST_F(NullSpace, IsInReducedEchelonForm) {
  const auto x = null_space(of_rank(3, 4, 6), 6, 3);
  ASSERT_EQ(x.size(), 3u);
  std::vector<std::size_t> leads;
  for (const UncertainRow& r : x) {
    std::size_t lead = 0;
    while (r[lead].value == 0) ++lead;
    EXPECT_EQ(r[lead].value, 1);
    EXPECT_TRUE(leads.empty() || leads.back() < lead);
    leads.push_back(lead);
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(x[i][leads[j]].value, i == j ? 1 : 0);
}

TEST_F(NullSpace, OfOneEquationByHand) {
  const auto x = null_space({row({1, 2, 4})}, 3, 3);  // 2 (x_2) = -x_0 / 2 ...
  ASSERT_EQ(x.size(), 2u);
  EXPECT_EQ(x[0][0].value, 1);
  EXPECT_EQ(x[0][1].value, 0);
  EXPECT_EQ(x[0][2].value, Mpfr(-1) / 4);
  EXPECT_EQ(x[1][1].value, 1);
  EXPECT_EQ(x[1][2].value, Mpfr(-1) / 2);
}

TEST_F(NullSpace, CountsAsZeroWhatMayBe) {
  const Mpfr small = power_of_two<Mpfr>(-80);
  const auto count = [&](const Mpfr& error) {
    return null_space({row({1, 1}), {Uncertain(1), Uncertain(1 + small, error)}}, 2, 2).size();
  };
  EXPECT_EQ(count(small * 2), 1u) << "the rows may be the same";
  EXPECT_EQ(count(small / 2), 0u);
  EXPECT_EQ(null_space({{Uncertain(small, small)}}, 1, 1).size(), 1u);
  EXPECT_EQ(null_space({{Uncertain(2 * small, small)}}, 1, 1).size(), 0u);
}

/// Rows and either half of the columns in other units: the same solutions in those.
TEST_F(NullSpace, DoesNotDependOnUnits) {
  const auto a = of_rank(4, 6, 6);
  auto b = a;
  const Mpfr unit = power_of_two<Mpfr>(300);
  for (std::size_t i = 0; i < b.size(); ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      if (i % 2 == 0) b[i][j].value /= unit;
      if (j >= 3) b[i][j].value *= unit * unit;
    }
  const auto x = null_space(a, 6, 3), y = null_space(b, 6, 3);
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool second_alone = x[i][0].value == 0 && x[i][1].value == 0 && x[i][2].value == 0;
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_EQ(x[i][j].value, j < 3 || second_alone ? y[i][j].value : Mpfr(y[i][j].value * unit * unit));
  }
}

}  // namespace
}  // namespace hbvm::core
