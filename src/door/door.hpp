#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "hbvm/method.hpp"
#include "hbvm/scene.hpp"
#include "interruption.hpp"
#include "scalar/expression.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// While work that came through the front door is done: its token ends it, and every method has its name.
class Admitted {
 public:
  explicit Admitted(const std::stop_token& stop);

 private:
  StopRequest request_;
  StopScope scope_;
};

/// What a progress of parts becomes: it ends the work, too, if that is asked for.
std::function<void(double)> watched(const std::function<void(double)>& progress);

/// The exact number. \param what it is, for messages. \throws InputError
Expression expression_of(const Number& number, const std::string& what);

/// The tableau with a name and c. \throws InputError naming the entry that has no value, and for sizes that do not fit
Tableau completed(Tableau tableau);

}  // namespace hbvm::core
