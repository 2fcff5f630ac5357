#include "scalar/working_digits.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace hbvm::core {
namespace {

TEST(WorkingDigits, AreAskedForInEveryThread) {
  EXPECT_THROW(require_working_digits<Mpfr>(), InputError);
  EXPECT_NO_THROW(require_working_digits<double>());
  EXPECT_NO_THROW(require_working_digits<Quad>());
  {
    const PrecisionScope digits(50);
    EXPECT_NO_THROW(require_working_digits<Mpfr>());
    bool refused = false;
    std::thread([&] {
      try {
        require_working_digits<Mpfr>();
      } catch (const InputError& error) {
        refused = std::string(error.what()).find("PrecisionScope") != std::string::npos;
      }
    }).join();
    EXPECT_TRUE(refused);
  }
  EXPECT_THROW(require_working_digits<Mpfr>(), InputError) << "the scope has ended";
}

}  // namespace
}  // namespace hbvm::core
