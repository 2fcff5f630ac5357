#pragma once

#include "hbvm/figure.hpp"
#include "study/convergence_study.hpp"

namespace hbvm::core {

/// A panel for each part: a curve a method and precision, and a triangle for each order.
Figure convergence_figure(const ConvergenceWork& work, const std::vector<MeasuredConvergence>& measured,
                          const std::string& command);

}  // namespace hbvm::core
