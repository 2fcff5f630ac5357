#pragma once

#include "scheme/scheme.hpp"
#include "scheme/scheme_text.hpp"

namespace hbvm::core {

// One function a family. \throws InputError with the file and what is wrong

/// Runge-Kutta methods: A, b; c, embedded weights b_hat, weights b_theta at any time of the step.
SchemePtr runge_kutta_scheme(const SchemeText& text);
/// Two Runge-Kutta methods for two groups of unknowns: A, b and A_hat, b_hat.
SchemePtr partitioned_scheme(const SchemeText& text);
/// Methods for q'' = f(q): A, b of positions, b_hat of velocities, c; with A_hat for q'' = f(q, q').
SchemePtr nystrom_scheme(const SchemeText& text);
/// exp(a_1 h X) exp(b_1 h Y) exp(a_2 h X) ... of two flows: drifts a and kicks b.
SchemePtr splitting_scheme(const SchemeText& text);
/// Steps gamma_i h of a symmetric method of order 2; or alpha_i h of any method and beta_i h of its adjoint in turn.
SchemePtr composition_scheme(const SchemeText& text);
/// Linearly implicit methods: alpha, gamma, b; b_hat.
SchemePtr rosenbrock_scheme(const SchemeText& text);
/// sum_j alpha_j y_(n+j) = h sum_j beta_j f_(n+j).
SchemePtr multistep_scheme(const SchemeText& text);

/// By the family that the text names, or that its arrays tell. \throws InputError also for arrays of no such family
SchemePtr make_scheme(const SchemeText& text);

}  // namespace hbvm::core
