#include "door/door.hpp"

#include <mutex>

#include "reference/taylor_method.hpp"

namespace hbvm::core {

Admitted::Admitted(const std::stop_token& stop)
    : request_{stop, stop_request ? stop_request->signal : nullptr}, scope_(&request_) {
  static std::once_flag once;
  std::call_once(once, add_taylor_method);
}

std::function<void(double)> watched(const std::function<void(double)>& progress) {
  return [progress, asker = stop_request](double part) {
    const StopScope scope(asker);
    end_if_asked("the work was not finished");
    if (progress) progress(part);
  };
}

Expression expression_of(const Number& number, const std::string& what) {
  try {
    return Expression::parse(number.text());
  } catch (const ExpressionError& error) {
    throw InputError(what + " " + error.what());
  }
}

}  // namespace hbvm::core
