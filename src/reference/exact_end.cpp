#include "reference/exact_end.hpp"

#include "hbvm/error.hpp"
#include "hbvm_motion.hpp"
#include "method/hbvm.hpp"
#include "reference/taylor.hpp"

namespace hbvm::core {

ExactPoint exact_end(const Problem<Mpfr>& problem, const Vector<Mpfr>& q, const Vector<Mpfr>& p, const Mpfr& t,
                     Route route, const std::function<void()>& while_working) {
  if (route == Route::taylor) {
    TaylorMotion motion(problem, q, p, while_working);
    motion.advance_to(t);
    return motion.output();
  }
  if (route == Route::closed_form) throw InputError("the end of a motion is found by taylor or hbvm");
  constexpr int few = 3;
  const double digits = digits10<Mpfr>() - few;
  const int s = stages_of_route(digits);
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(s, s);
  HbvmMotion walk(problem, method, q, p, digits, t);
  walk.advance_to(t, [&](const Mpfr&) { while_working(); });
  return walk.output();
}

}  // namespace hbvm::core
