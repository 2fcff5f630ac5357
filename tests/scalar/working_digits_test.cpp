#include "scalar/working_digits.hpp"

#include <thread>

#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(WorkingDigits, AreAskedForInEveryThread) {
  EXPECT_THROW(require_working_digits<Mpfr>(), InputError);
  EXPECT_NO_THROW(require_working_digits<double>());
  EXPECT_NO_THROW(require_working_digits<Quad>());
  {
    const PrecisionScope digits(50);
    EXPECT_NO_THROW(require_working_digits<Mpfr>());
    std::thread([] { expect_words(message_of([] { require_working_digits<Mpfr>(); }), {"PrecisionScope"}); }).join();
  }
  EXPECT_THROW(require_working_digits<Mpfr>(), InputError) << "the scope has ended";
}

}  // namespace
}  // namespace hbvm::core
