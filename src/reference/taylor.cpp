#include "reference/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "between/force_bounds.hpp"
#include "hbvm/error.hpp"
#include "linear/arrays.hpp"
#include "linear/product.hpp"
#include "reference/reference_motion.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

/// Polynomial motions are exact over any time; steps are no longer than 2^this.
constexpr double longest = 40;

/// sum + sign x, of a sign 1 or -1.
void add_signed(Mpfr& sum, const Mpfr& x, int sign) {
  if (sign > 0)
    set_sum(sum, sum, x);
  else
    set_difference(sum, sum, x);
}

}  // namespace

/// Jorba and Zou have half of the bits, in units of e, from the work of the convolutions alone. What is linear in the
/// order makes a fifth more the best (measured from 30 to 1000 digits).
Index TaylorMotion::order_for(int bits) {
  return std::max<Index>(8, static_cast<Index>(std::ceil(6 * bits * std::numbers::ln2 / 10)) + 1);
}

TaylorMotion::TaylorMotion(const Problem<Mpfr>& problem, const Vector<Mpfr>& q0, const Vector<Mpfr>& p0,
                           std::function<void()> while_working)
    : problem_(problem),
      while_working_(std::move(while_working)),
      order_(order_for(significand_bits<Mpfr>())),
      gradient_(problem, 1),
      F_(problem.m()),
      weighted_(problem.m()),
      rhs_(problem.nu()),
      powers_(order_ + 1),
      start_q_(q0),
      start_p_(p0),
      q_(q0),
      p_(p0),
      lambda_(problem.nu()) {
  const auto storage = [&](Index count) {
    return std::vector<Mpfr>(static_cast<std::size_t>(count * (order_ + 2)), Mpfr(0));
  };
  q_values_ = storage(problem.m());
  p_values_ = storage(problem.m());
  v_values_ = storage(problem.m());
  lambda_values_ = storage(problem.nu());
  collect_forms();
  form_values_ = storage(static_cast<Index>(forms_.size()));
  form_velocities_ = storage(static_cast<Index>(forms_.size()));
  for (const EffectTerm<Mpfr>& term : problem.potential.terms)
    for (Index n = 0; n < term.instances(); ++n) forces_.push_back(slope_of(term, n));
  for (const ForceTerm<Mpfr>& term : problem.forces)
    for (Index n = 0; n < term.instances(); ++n) {
      std::vector<const Mpfr*> coefficients;
      for (Index c = 0; c < term.force_coefficients.cols(); ++c) coefficients.push_back(&term.force_coefficients(n, c));
      pulls_.push_back(
          {term, n, ProgramSeries(term.force, 2 * term.arguments * problem.dimension, coefficients, order_)});
    }
  for (const DrivenPoint<Mpfr>& point : problem.driven)
    courses_.emplace_back(point.course, 1, std::vector<const Mpfr*>{}, order_ + 2);
  on_driven_.assign(static_cast<std::size_t>(driven()),
                    std::vector<Mpfr>(static_cast<std::size_t>(order_ + 1), Mpfr(0)));
  aligned_lambda_.assign(static_cast<std::size_t>(problem.nu()), AlignedSeries(order_ + 1));
  bounds_ = std::make_unique<ForceBounds>(problem);
  next_log2_length_ = std::numeric_limits<double>::infinity();
  find_unit();
  take_up();
  finish();
}

TaylorMotion::~TaylorMotion() = default;

void TaylorMotion::collect_forms() {
  for (Index a = 0; a < problem_.nu(); ++a) {
    const bool formula =
        std::holds_alternative<FormulaConstraint<Mpfr>>(problem_.constraints[static_cast<std::size_t>(a)].form);
    std::vector<Form> own = formula ? formula_forms(a) : affine_forms(a);
    std::move(own.begin(), own.end(), std::back_inserter(forms_));
  }
  for (Form& form : forms_) {
    form.hidden.emplace(order_ + 2, 1, form.factor == 0 ? 0 : 1);
    form.pulling.emplace(order_ + 2, 1, 0);
  }
}

std::vector<TaylorMotion::Form> TaylorMotion::formula_forms(Index a) {
  const Constraint<Mpfr>& constraint = problem_.constraints[static_cast<std::size_t>(a)];
  const EffectTerm<Mpfr>& term = std::get<FormulaConstraint<Mpfr>>(constraint.form).term;
  const Index d = problem_.dimension, inputs = term.arguments * d;
  std::vector<Form> own;
  for (const Index j : coordinates(constraint, d)) {
    Form form(a, j, order_ + 2);
    for (Index i = 0; i < inputs; ++i)
      for (const auto& block : term.displacement(0, i / d).blocks)
        if (block.offset + i % d == j)
          form.parts.push_back({constraint_slopes_.size(), static_cast<std::size_t>(i), block.weight});
    own.push_back(std::move(form));
  }
  constraint_slopes_.push_back(slope_of(term, 0));
  return own;
}

std::vector<TaylorMotion::Form> TaylorMotion::affine_forms(Index a) const {
  const Index d = problem_.dimension, m = problem_.m();
  const auto digits = static_cast<unsigned>(digits10<Mpfr>());
  const Constraint<Mpfr>& constraint = problem_.constraints[static_cast<std::size_t>(a)];
  std::map<Index, std::map<Index, Mpfr>> second = second_derivatives(constraint, d);
  std::vector<Form> own;
  for (const Index j : coordinates(constraint, d)) {
    Form form(a, j, order_ + 2);
    form.terms.assign(second[j].begin(), second[j].end());
    {
      // What q_j takes g to, less its square: exact with twice the digits and some.
      const PrecisionScope more(2 * digits + 20);
      const Vector<Mpfr> origin = Vector<Mpfr>::Zero(m);
      Vector<Mpfr> unit = origin;
      unit[j] = 1;
      Mpfr slope = value(constraint, d, unit).g - value(constraint, d, origin).g;
      for (const auto& [i, h] : form.terms)
        if (i == j) slope -= h / 2;
      set(form.constant, slope);
    }
    const auto like = [&](int sign) {
      return std::find_if(own.begin(), own.end(), [&](const Form& other) {
        return form.constant == sign * other.constant &&
               std::equal(
                   form.terms.begin(), form.terms.end(), other.terms.begin(), other.terms.end(),
                   [&](const auto& x, const auto& y) { return x.first == y.first && x.second == sign * y.second; });
      });
    };
    if (const auto same = like(1); same != own.end())
      same->columns.emplace_back(j, 1);
    else if (const auto opposite = like(-1); opposite != own.end())
      opposite->columns.emplace_back(j, -1);
    else
      own.push_back(std::move(form));
  }
  for (Form& form : own) {
    std::ranges::sort(form.columns);
    const Mpfr factor = form.terms.empty() ? Mpfr(0) : Mpfr(form.terms.front().second * form.columns.front().second);
    if (std::equal(form.terms.begin(), form.terms.end(), form.columns.begin(), form.columns.end(),
                   [&](const auto& x, const auto& y) { return x.first == y.first && x.second == factor * y.second; }))
      form.factor = factor;
  }
  return own;
}

TaylorMotion::Slope TaylorMotion::slope_of(const EffectTerm<Mpfr>& term, Index instance) const {
  std::vector<const Mpfr*> coefficients;
  for (Index c = 0; c < term.gradient_coefficients.cols(); ++c)
    coefficients.push_back(&term.gradient_coefficients(instance, c));
  return {term, instance, ProgramSeries(term.gradient, term.arguments * problem_.dimension, coefficients, order_)};
}

void TaylorMotion::advance(Slope& slope, Index n) {
  const Index d = problem_.dimension, inputs = slope.term.arguments * d;
  for (Index i = 0; i < inputs; ++i) {
    const Displacement<Mpfr>& from = slope.term.displacement(slope.instance, i / d);
    Mpfr& x = slope.series.input(i, n);
    if (n == 0 && from.shift.size() > 0)
      set(x, from.shift[i % d]);
    else
      set_zero(x);
    for (const auto& block : from.blocks)
      add_weighted(&x, block.weight, q_series(block.offset + i % d) + n, Index{1}, t_);
  }
  slope.series.advance(n);
}

void TaylorMotion::advance(Pull& pull, Index n) {
  const Index d = problem_.dimension, inputs = pull.term.arguments * d;
  for (Index i = 0; i < inputs; ++i) {
    const Displacement<Mpfr>& from = pull.term.displacement(pull.instance, i / d);
    Mpfr &x = pull.series.input(i, n), &v = pull.series.input(inputs + i, n);
    set_zero(v);
    if (n == 0 && from.shift.size() > 0)
      set(x, from.shift[i % d]);
    else
      set_zero(x);
    for (const auto& block : from.blocks) {
      add_weighted(&x, block.weight, q_series(block.offset + i % d) + n, Index{1}, t_);
      add_weighted(&v, block.weight, v_series(block.offset + i % d) + n, Index{1}, t_);
    }
    set_quotient(v, v, unit_);
  }
  try {
    pull.series.advance(n);
  } catch (const IntegrationError& error) {
    throw IntegrationError(pull.term.name + ": " + error.what());
  }
}

void TaylorMotion::set_courses(Index n) {
  for (; courses_known_ < n;) {
    ++courses_known_;
    for (ProgramSeries& series : courses_) {
      Mpfr& t = series.input(0, courses_known_);
      if (courses_known_ == 0)
        set(t, q_series(problem_.clock())[0]);
      else if (courses_known_ == 1)
        set(t, unit_);
      else
        set_zero(t);
      series.advance(courses_known_);
    }
  }
}

void TaylorMotion::set_accounts(Index n) {
  const Index bodies = problem_.clock(), d = problem_.dimension;
  const auto next = static_cast<unsigned long>(n + 1);
  for (Index j = 0; j < driven(); ++j) {
    std::vector<Mpfr>& force = on_driven_[static_cast<std::size_t>(j)];
    set(force[static_cast<std::size_t>(n)], F_[bodies + j]);
    Mpfr& p = p_series(bodies + j)[n + 1];
    set_zero(p);
    for (Index i = 0; i <= n; ++i) add_product(p, force[static_cast<std::size_t>(i)], v_series(bodies + j)[n - i], t_);
  }
  for (Pull& pull : pulls_) {
    if (!pull.term.account) continue;
    const Index inputs = pull.term.arguments * d;
    Mpfr power = 0;
    for (Index i = 0; i < pull.term.acting * d; ++i)
      for (Index l = 0; l <= n; ++l)
        add_product(power, pull.series.output(static_cast<std::size_t>(i), l), pull.series.input(inputs + i, n - l),
                    t_);
    set_product(power, power, unit_);
    Mpfr& p = p_series(*pull.term.account)[n + 1];
    set_difference(p, p, power);
  }
  for (Index j = bodies; j < problem_.m(); ++j)
    mpfr_div_ui(raw(p_series(j)[n + 1]), raw(p_series(j)[n + 1]), next, MPFR_RNDN);
}

void TaylorMotion::set_velocity(Index n) {
  if (driven() > 0) set_courses(n + 1);
  for (Index j = 0; j < driven(); ++j)
    mpfr_mul_ui(raw(v_series(problem_.clock() + j)[n]), raw(course(j, n + 1)), static_cast<unsigned long>(n + 1),
                MPFR_RNDN);
  for (const auto& block : problem_.mass.blocks())
    for (Index j = 0; j < block.size; ++j) {
      Mpfr& v = v_series(block.offset + j)[n];
      if (block.full) {
        set_zero(v);
        for (Index i = 0; i < block.size; ++i) add_product(v, block.W(j, i), p_series(block.offset + i)[n], x_);
      } else {
        set_product(v, block.inverse_mass, p_series(block.offset + j)[n]);
      }
      set_product(v, v, unit_);
    }
  for (std::size_t l = 0; l < forms_.size(); ++l) {
    Mpfr& sum = form_velocity(l)[n];
    set_zero(sum);
    for (const auto& [j, sign] : forms_[l].columns) add_signed(sum, v_series(j)[n], sign);
    if (forms_[l].factor == 0 || n == 0) forms_[l].velocity.set(n, sum);
  }
}

void TaylorMotion::set_forms(Index n) {
  for (Slope& slope : constraint_slopes_) advance(slope, n);
  for (std::size_t l = 0; l < forms_.size(); ++l) {
    Mpfr& sum = form_series(l)[n];
    if (n == 0)
      set(sum, forms_[l].constant);
    else
      set_zero(sum);
    for (const auto& [j, h] : forms_[l].terms) add_product(sum, h, q_series(j)[n], x_);
    for (const auto& [slope, output, weight] : forms_[l].parts)
      add_weighted(&sum, weight, &constraint_slopes_[slope].series.output(output, n), Index{1}, x_);
    forms_[l].series.set(n, sum);
  }
}

void TaylorMotion::factor_gram() {
  if (problem_.nu() == 0) return;
  Vector<Mpfr> q(problem_.m());
  for (Index j = 0; j < q.size(); ++j) q[j] = q_series(j)[0];
  gradient_.update(lanes(q));
  if (!gram_.factor(gradient_, problem_.nu()))
    throw IntegrationError("the constraints' gradients are linearly dependent: (3) does not hold at t = " +
                           to_scientific(start_, 10));
}

void TaylorMotion::project() {
  const Index m = problem_.m(), nu = problem_.nu();
  if (nu == 0) return;
  Vector<Mpfr> q(m);
  for (Index j = 0; j < m; ++j) q[j] = q_series(j)[0];
  for (Index a = 0; a < nu; ++a)
    rhs_[a] = value(problem_.constraints[static_cast<std::size_t>(a)], problem_.dimension, q).g;
  gram_.solve(rhs_);
  Vector<Mpfr> shift = Vector<Mpfr>::Zero(m);
  for (std::size_t l = 0; l < forms_.size(); ++l)
    for (const auto& [j, sign] : forms_[l].columns) shift[j] += sign * form_series(l)[0] * rhs_[forms_[l].constraint];
  problem_.mass.velocity(lanes(std::as_const(shift)), lanes(weighted_));
  for (Index j = 0; j < m; ++j) set_difference(q_series(j)[0], q_series(j)[0], weighted_[j]);
  set_forms(0);
  // By the matrix from before, the multiplier would be wrong by what the shift was right by. Errors would grow from
  // step to step by the square of the angle that a body turns through.
  factor_gram();
  // Of the momenta, by G_0 there.
  for (Index a = 0; a < nu; ++a) set_zero(rhs_[a]);
  for (std::size_t l = 0; l < forms_.size(); ++l)
    add_product(rhs_[forms_[l].constraint], form_series(l)[0], form_velocity(l)[0], x_);
  gram_.solve(rhs_);
  for (Index a = 0; a < nu; ++a) set_quotient(rhs_[a], rhs_[a], unit_);
  for (std::size_t l = 0; l < forms_.size(); ++l)
    for (const auto& [j, sign] : forms_[l].columns) {
      if (j >= problem_.clock()) continue;
      set_product(t_, form_series(l)[0], rhs_[forms_[l].constraint]);
      add_signed(p_series(j)[0], t_, -sign);
    }
  set_velocity(0);
}

void TaylorMotion::set_force(Index n) {
  const Index d = problem_.dimension;
  for (Index j = 0; j < F_.size(); ++j) set_zero(F_[j]);
  const auto add = [&](auto& of, Index vectors) {
    advance(of, n);
    for (Index i = 0; i < vectors * d; ++i)
      for (const auto& block : of.term.displacement(of.instance, i / d).blocks)
        add_weighted(&F_[block.offset + i % d], block.weight, &of.series.output(static_cast<std::size_t>(i), n),
                     Index{1}, t_);
  };
  for (Slope& force : forces_) add(force, force.term.arguments);
  for (Pull& pull : pulls_) add(pull, pull.term.acting);
}

void TaylorMotion::set_hidden(Mpfr& r, std::size_t l, Index n) {
  Form& form = forms_[l];
  if (form.factor == 0) return form.hidden->set(r, form.series, form.velocity, n + 1);
  // With (k+1) G_{k+1} = factor v_k: sum_i (n+2-i) G_i G_{n+2-i}, of which mirrored terms make n + 2 together.
  if (form.hidden->by_blocks(n + 2)) {
    form.hidden->set(r, form.series, form.series, n + 2);
  } else {
    set_convolution(r, form.series, form.series, n + 2, 1, (n + 1) / 2);
    mpfr_mul_2ui(raw(r), raw(r), 1, MPFR_RNDN);
    if (n % 2 == 0) add_product(r, form_series(l)[n / 2 + 1], form_series(l)[n / 2 + 1], x_);
  }
  mpfr_mul_ui(raw(r), raw(r), static_cast<unsigned long>(n + 2), MPFR_RNDN);
  mpfr_div_2ui(raw(r), raw(r), 1, MPFR_RNDN);
  set_quotient(r, r, form.factor);
}

void TaylorMotion::set_multipliers(Index n) {
  const Index nu = problem_.nu();
  if (nu == 0) return;
  // What multipliers of lower degree take from F, and what the velocities of lower degree leave of (G^T v)_{n+1}.
  for (Index a = 0; a < nu; ++a) set_zero(rhs_[a]);
  for (std::size_t l = 0; l < forms_.size(); ++l) {
    Form& form = forms_[l];
    set_hidden(t_, l, n);
    set_sum(rhs_[form.constraint], rhs_[form.constraint], t_);
    if (n == 0) continue;
    form.pulling->set(t_, form.series, aligned_lambda_[static_cast<std::size_t>(form.constraint)], n);
    for (const auto& [j, sign] : form.columns) add_signed(F_[j], t_, -sign);
  }
  problem_.mass.velocity(lanes(std::as_const(F_)), lanes(weighted_));
  // The accelerations of driven points.
  if (driven() > 0) set_courses(n + 2);
  for (Index j = 0; j < driven(); ++j) {
    Mpfr& acceleration = weighted_[problem_.clock() + j];
    mpfr_mul_ui(raw(acceleration), raw(course(j, n + 2)), static_cast<unsigned long>((n + 1) * (n + 2)), MPFR_RNDN);
    set_product(acceleration, acceleration, per_square_);
  }
  for (Index a = 0; a < nu; ++a) {
    mpfr_mul_ui(raw(rhs_[a]), raw(rhs_[a]), static_cast<unsigned long>(n + 1), MPFR_RNDN);
    set_product(rhs_[a], rhs_[a], per_square_);
  }
  for (std::size_t l = 0; l < forms_.size(); ++l) {
    const Form& form = forms_[l];
    set_zero(t_);
    for (const auto& [j, sign] : form.columns) add_signed(t_, weighted_[j], sign);
    add_product(rhs_[form.constraint], form_series(l)[0], t_, x_);
  }
  gram_.solve(rhs_);
  for (Index a = 0; a < nu; ++a) {
    set(lambda_series(a)[n], rhs_[a]);
    aligned_lambda_[static_cast<std::size_t>(a)].set(n, rhs_[a]);
  }
  for (std::size_t l = 0; l < forms_.size(); ++l) {
    const Form& form = forms_[l];
    set_product(t_, form_series(l)[0], rhs_[form.constraint]);
    for (const auto& [j, sign] : form.columns) add_signed(F_[j], t_, -sign);
  }
}

void TaylorMotion::begin(const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
  for (Index j = 0; j < q.size(); ++j) {
    set(q_series(j)[0], q[j]);
    set(p_series(j)[0], p[j]);
  }
  courses_known_ = -1;
  if (driven() > 0) set_courses(0);
  for (Index j = 0; j < driven(); ++j) set(q_series(problem_.clock() + j)[0], course(j, 0));
  set_velocity(0);
  set_forms(0);
  factor_gram();
  project();
}

void TaylorMotion::expand(Index order) {
  for (Index n = 0; n < order; ++n) {
    const auto next = static_cast<unsigned long>(n + 1);
    if (while_working_) while_working_();
    for (Index j = 0; j < F_.size(); ++j) mpfr_div_ui(raw(q_series(j)[n + 1]), raw(v_series(j)[n]), next, MPFR_RNDN);
    set_forms(n + 1);
    set_force(n);
    set_multipliers(n);
    for (Index j = 0; j < F_.size(); ++j) {
      Mpfr& p = p_series(j)[n + 1];
      set_product(p, F_[j], unit_);
      mpfr_div_ui(raw(p), raw(p), next, MPFR_RNDN);
    }
    set_accounts(n);
    set_velocity(n + 1);
  }
}

TaylorMotion::Extent TaylorMotion::extent(Index order) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double bits = significand_bits<Mpfr>() + 2;
  Extent result{infinite, infinite, -infinite};
  const auto look = [&](Index first, Index count, auto series) {
    const auto greatest = [&](Index n) {
      double exponent = -infinite;
      for (Index j = first; j < first + count; ++j) exponent = std::max(exponent, log2_of((this->*series)(j)[n]));
      return exponent;
    };
    // What it is and what it moves by.
    const double size = std::max(greatest(0), greatest(1));
    if (std::isinf(size)) return;
    for (const Index n : {order - 1, order}) {
      const double tail = greatest(n);
      if (std::isnan(tail)) continue;
      result.step = std::min(result.step, (size - bits - tail) / static_cast<double>(n));
      result.radius = std::min(result.radius, (size - tail) / static_cast<double>(n));
    }
    // Of an entire motion terms may grow before they fall: what they are larger than their sum they cancel of its
    // digits.
    for (Index n = 2; n < order - 1; ++n) {
      const double term = greatest(n);
      result.step = std::min(result.step, (size + 1 - term) / static_cast<double>(n));
      result.growth = std::max(result.growth, term - size);
    }
  };
  for (const auto& block : problem_.mass.blocks())
    for (const auto series : {&TaylorMotion::q_series, &TaylorMotion::p_series}) look(block.offset, block.size, series);
  for (std::size_t n = 0; n < courses_.size(); ++n)
    look(problem_.clock() + static_cast<Index>(n) * problem_.dimension, problem_.dimension, &TaylorMotion::q_series);
  return result;
}

void TaylorMotion::set_unit(double log2) {
  log2_unit_ = std::min(log2, longest);
  set(unit_, power_of_two(log2_unit_));
  set_product(t_, unit_, unit_);
  mpfr_ui_div(raw(per_square_), 1, raw(t_), MPFR_RNDN);
}

void TaylorMotion::find_unit() {
  const Index few = std::min<Index>(order_, 16);
  constexpr int most_tries = 100;
  constexpr double most_change = 40, near = 2;
  set_unit(0);
  for (int tries = 0; tries < most_tries; ++tries) {
    begin(start_q_, start_p_);
    expand(few);
    const double radius = extent(few).radius, before = log2_unit_;
    // The step that the last terms of all the orders make round-off.
    const double fall = static_cast<double>(significand_bits<Mpfr>()) / static_cast<double>(order_);
    set_unit(log2_unit_ + (std::isinf(radius) ? most_change : radius - fall));
    if (std::abs(log2_unit_ - before) < near) break;
  }
  first_log2_unit_ = log2_unit_;
}

void TaylorMotion::take_up() {
  // More and the terms before the largest would lose digits beside it.
  constexpr double most_growth = AlignedSeries::guard_bits / double{2};
  // A little more than the last step: where the series would take more, the unit follows.
  constexpr double room = double{1} / 16, most_rise = 1;
  const double bits = significand_bits<Mpfr>();
  for (;;) {
    if (!(log2_unit_ > first_log2_unit_ - 2 * bits) || !(log2_unit_ > log2_of(start_) - bits))
      throw IntegrationError("the motion has a singularity at about t = " + to_scientific(start_, 10) +
                             ": its Taylor series converges nowhere there");
    begin(start_q_, start_p_);
    expand(order_);
    const Extent found = extent(order_);
    const double next = log2_unit_ + std::min(found.step + room, most_rise);
    if (found.growth > most_growth) {
      set_unit(std::min(next, log2_unit_ - 1));
      continue;
    }
    const double radius = std::min(found.radius + log2_unit_, longest);
    least_radius_ = steps_ == 0 ? radius : std::min(least_radius_, radius);
    set(length_, unit_);
    const double length = bounded_length(log2_unit_ + std::min(found.step, double{0})) - log2_unit_;
    if (length < 0) set_product(length_, length_, power_of_two(length));
    next_log2_unit_ = next;
    return;
  }
}

double TaylorMotion::bounded_length(double most) {
  // Terms beyond the order are to be below 2^-(bits - slack) of the momenta. That far in, nothing is seen of how the
  // series converges at its own step, which makes its last terms round-off.
  constexpr double slack = 20, rise = double{1} / 2;
  const double order = static_cast<double>(order_), bits = significand_bits<Mpfr>();
  const double log2_radii = (bits - slack + ForceBounds::allowed_bits) / order;
  bounds_->start(start_q_, start_p_);
  const auto slope = [this](std::size_t n) -> const Slope& {
    return n < forces_.size() ? forces_[n] : constraint_slopes_[n - forces_.size()];
  };
  double length = std::min(most, next_log2_length_);
  const auto circle = [&](const auto& coefficient) {
    return circle_of(coefficient, order_ - 1, length + log2_radii - log2_unit_);
  };
  for (int tries = 0;; ++tries) {
    const auto input_of = [&](const ProgramSeries& series, Index input) {
      return circle([&](Index n) -> const Mpfr& { return series.input(input, n); });
    };
    if (bounds_->hold(
            length, [&](std::size_t force, Index input) { return input_of(slope(force).series, input); },
            [&](std::size_t pull, Index input) { return input_of(pulls_[pull].series, input); },
            [&] { return input_of(courses_.front(), 0); }))
      break;
    constexpr int careful = 4;
    length -= tries < careful ? double{1} / 3 : 1;
    if (!(length > first_log2_unit_ - 2 * bits) || !(length > log2_of(start_) - bits))
      throw IntegrationError("the motion cannot be followed beyond t = " + to_scientific(start_, 10) + ": " +
                             bounds_->obstacle());
  }
  next_log2_length_ = length < most ? length + rise : std::numeric_limits<double>::infinity();
  return length;
}

void TaylorMotion::evaluate(const Mpfr& tau, Vector<Mpfr>& q, Vector<Mpfr>& p) {
  set(powers_[0], Mpfr(1));
  set_quotient(t_, tau, unit_);
  for (Index n = 1; n <= order_; ++n) set_product(powers_[n], powers_[n - 1], t_);
  for (Index j = 0; j < q.size(); ++j) {
    set_dot(q[j], q_series(j), 1, powers_.data(), 1, order_ + 1);
    set_dot(p[j], p_series(j), 1, powers_.data(), 1, order_ + 1);
    if (!is_finite(q[j]) || !is_finite(p[j]))
      throw IntegrationError("the motion is not finite after t = " + to_scientific(start_, 10));
  }
}

void TaylorMotion::finish() {
  // Degree 0 of a step from here; the step under way is taken up again afterwards.
  const std::vector<Mpfr> kept_q = q_values_, kept_p = p_values_;
  begin(q_, p_);
  for (Index j = 0; j < q_.size(); ++j) {
    q_[j] = q_series(j)[0];
    p_[j] = p_series(j)[0];
    mpfr_div_ui(raw(q_series(j)[1]), raw(v_series(j)[0]), 1, MPFR_RNDN);
  }
  set_forms(1);
  set_force(0);
  set_multipliers(0);
  for (Index a = 0; a < lambda_.size(); ++a) lambda_[a] = lambda_series(a)[0];
  // The coefficients of q and p are all that evaluate() needs.
  q_values_ = kept_q;
  p_values_ = kept_p;
}

void TaylorMotion::next_step() {
  evaluate(length_, start_q_, start_p_);
  start_ += length_;
  ++steps_;
  set_unit(next_log2_unit_);
  take_up();
}

void TaylorMotion::shorten(const Mpfr& most) {
  if (length_ > most) set(length_, most);
}

void TaylorMotion::advance_to(const Mpfr& t, const std::function<void(const Mpfr&)>& after_step) {
  while (t - start_ > length_) {
    next_step();
    if (after_step) after_step(start_);
  }
  evaluate(t - start_, q_, p_);
  finish();
}

}  // namespace hbvm::core
