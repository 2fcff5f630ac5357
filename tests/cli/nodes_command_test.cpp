#include <gtest/gtest.h>

#include "basis/gauss_legendre.hpp"
#include "cli/json.hpp"
#include "cli/program.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

using nlohmann::ordered_json;

TEST(Nodes, AsJsonAreTheLibrarysWithAllDigits) {
  for (const char* precision : {"double", "quad", "mpfr:50", "mpfr:200"})
    for (const int n : {1, 5, 20}) {
      const ordered_json j = json_of({"nodes", std::to_string(n), "--precision", precision});
      EXPECT_EQ(keys_of(j), (std::vector<std::string>{"n", "precision", "c", "b"}));
      expect_members(j, {{"n", n}, {"precision", precision}});
      std::vector<std::string> c, b;
      with_scalar(Precision::parse(precision), [&]<Scalar S>() {
        const Quadrature<S> formula = gauss_legendre<S>(n);
        for (Index i = 0; i < n; ++i) {
          c.push_back(to_text(formula.c[i]));
          b.push_back(to_text(formula.b[i]));
          EXPECT_TRUE(i == 0 || formula.c[i] > formula.c[i - 1]);
        }
        return 0;
      });
      expect_members(j, {{"c", c}, {"b", b}});
    }
}

TEST(Nodes, OfTwoAreKnown) {
  const ordered_json j = json_of({"nodes", "2", "--precision", "mpfr:40"});
  EXPECT_TRUE(j["c"][0].get<std::string>().starts_with("0.211324865405187117745425609749"));  // (1 - 1/sqrt(3))/2
  EXPECT_TRUE(j["c"][1].get<std::string>().starts_with("0.788675134594812882254574390250"));
  EXPECT_EQ(j["b"], (std::vector<std::string>{"0.5", "0.5"}));
}

TEST(Nodes, WithoutJsonAreLinesOfTwoNumbers) {
  const std::vector<std::string> lines = lines_of(ended_with(0, {"nodes", "5"}).out);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_TRUE(lines[0].starts_with("#"));
  double sum = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    double c = 0, b = 0;
    std::istringstream(lines[i]) >> c >> b;
    EXPECT_TRUE(c > 0 && c < 1 && b > 0) << lines[i];
    sum += b;
  }
  EXPECT_NEAR(sum, 1, 1e-15);
}

}  // namespace
}  // namespace hbvm::core
