#include "step/lobatto.hpp"

#include "basis/legendre.hpp"
#include "copy_state.hpp"
#include "linear/arrays.hpp"
#include "linear/product.hpp"
#include "linear/rounded.hpp"
#include "method/hbvm_name.hpp"
#include "method/method_spec.hpp"

namespace hbvm::core {
namespace {

/// The roots of (1 - x^2) P_N', x = 2c - 1, by Newton's method. The derivative is -N (N + 1) P_N, and the function
/// itself N (P_{N-1} - x P_N).
Vector<Mpfr> lobatto_nodes(int s) {
  const int N = s - 1;
  const Mpfr pi = 4 * atan(Mpfr(1));
  const Mpfr ratio = sqrt(Mpfr(2 * N + 1) / (2 * N - 1));  // P_{N-1} and P_N are normed
  // Convergence is quadratic: what follows so small a change is round-off.
  const Mpfr small = ldexp(Mpfr(1), -static_cast<int>(mpfr_working_bits()) * 2 / 3);
  Vector<Mpfr> c(s);
  c[0] = 0;
  c[N] = 1;
  Vector<Mpfr> node(1);
  for (int i = 1; 2 * i <= N; ++i) {
    Mpfr& x = node[0];
    x = (1 - cos(pi * i / N)) / 2;
    constexpr int most = 100;
    for (int n = 0; n < most; ++n) {
      const Matrix<Mpfr> P = legendre_values<Mpfr>(node, s);
      const Mpfr change = ((2 * x - 1) - ratio * P(0, N - 1) / P(0, N)) / (2 * (N + 1));
      x -= change;
      if (abs(change) < small) break;
    }
    if (2 * i == N) x = Mpfr(1) / 2;
    c[i] = x;
    c[N - i] = 1 - x;
  }
  return c;
}

}  // namespace

template <Scalar S>
Lobatto<S> make_lobatto(int s) {
  if (s < 2 || s > max_s)
    throw InputError("method lobatto:" + std::to_string(s) + ": S is from 2 to " + std::to_string(max_s));
  const auto digits = static_cast<unsigned>(digits10<S>());
  const unsigned guard = 20 + static_cast<unsigned>(s);
  Lobatto<Mpfr> exact;
  {
    const PrecisionScope guarded(digits + guard);
    const int N = s - 1;
    exact.c = lobatto_nodes(s);
    const Matrix<Mpfr> P = legendre_values<Mpfr>(exact.c, s), I = legendre_integrals<Mpfr>(exact.c, s);
    exact.b.resize(s);
    for (int i = 0; i < s; ++i) exact.b[i] = Mpfr(2 * N + 1) / (N * (N + 1) * P(i, N) * P(i, N));
    // The formula integrates P_i P_j exactly but for i = j = N. The integral of P_N is 0 at every node.
    Matrix<Mpfr> projection(N, s);
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < s; ++i) projection(j, i) = exact.b[i] * P(i, j);
    exact.A = I.leftCols(N).lazyProduct(projection);
    for (int j = 0; j < s; ++j) {
      exact.A(0, j) = 0;
      exact.A(N, j) = exact.b[j];
    }
    exact.A_hat.resize(s, s);
    for (int i = 0; i < s; ++i)
      for (int j = 0; j < s; ++j)
        exact.A_hat(i, j) = j == N ? Mpfr(0) : Mpfr(exact.b[j] * (1 - exact.A(j, i) / exact.b[i]));
    exact.A_A_hat = exact.A.lazyProduct(exact.A_hat);
  }
  const PrecisionScope working(digits);
  return {rounded<S>(exact.c), rounded<S>(exact.b), rounded<S>(exact.A), rounded<S>(exact.A_hat),
          rounded<S>(exact.A_A_hat)};
}

template <Scalar S>
LobattoStepper<S>::LobattoStepper(const Problem<S>& problem, std::shared_ptr<const Lobatto<S>> method)
    : problem_(problem),
      method_(std::move(method)),
      potential_(problem.potential, method_->s()),
      gradient_(problem, method_->s()),
      projection_(problem),
      P_(Matrix<S>::Zero(method_->s(), problem.m())),
      P_before_(P_),
      Q_(P_),
      V_(P_),
      F_(P_),
      lambda_(Matrix<S>::Zero(method_->s(), problem.nu())),
      pull_(lambda_),
      g_(lambda_),
      coupling_(method_->s(), method_->s()),
      rhs_((method_->s() - 1) * problem.nu()),
      stage_sums_(method_->b, problem.m()),
      extrapolation_(method_->s(), problem.m() + problem.nu()),
      sequence_(method_->s() * (problem.m() + problem.nu())),
      position_scale_(problem),
      positions_(problem.m()),
      // The lengths of the sums of one sweep, and 4 for what they are passed through.
      rule_(problem.m(), static_cast<long>(4 * (3 * method_->s() + problem.m() + method_->s() * problem.nu()))),
      before_(Vector<S>::Zero(problem.m()), Vector<S>::Zero(problem.m())),
      multiplier_(Vector<S>::Zero(problem.nu())) {
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& pair : gradient_.couplings()) entries.emplace_back(pair.a, pair.b);
  order_ = order_for_band(problem.nu(), entries);
  const Index blocks = method_->s() - 1;
  system_.resize(blocks * problem.nu(), blocks * (order_.half_bandwidth + 1) - 1);
  describe_parts();
}

template <Scalar S>
void LobattoStepper<S>::describe_parts() {
  const Index s = method_->s(), m = problem_.m(), nu = problem_.nu();
  parts_ = {{"stages"},           {"constraint gradients at stages"},
            {"matrix at stages"}, {"factors at stages"},
            {"multipliers"},      {"sums over stages"}};
  OperationCounts& stage = parts_[stages].per_call;
  stage = static_cast<std::uint64_t>(s) * problem_.mass.operations();
  stage.add_dots(2 * m * s, s);
  stage.add(Op::multiply, 2 * m * s);
  stage.add(Op::add, 2 * m * s);
  stage += gradient_.times_operations();
  parts_[gradients].per_call = gradient_.operations() + gradient_.weighing_operations();
  parts_[matrix].per_call = gradient_.own_coupling_operations();
  parts_[matrix].per_call.add(Op::multiply, static_cast<Index>(gradient_.couplings().size()) * (s - 1) * (s - 1));
  parts_[factors].per_call = system_.factor_operations();
  parts_[solution].per_call = system_.solve_operations();
  parts_[solution].per_call.add(Op::add, (s - 1) * nu);
  parts_[sums].per_call.add_dots(2 * m, s);
  parts_[sums].per_call.add(Op::multiply, 2 * m);
  parts_[sums].per_call.add(Op::add, 2 * m);
}

template <Scalar S>
SolverCounts LobattoStepper<S>::own_counts() const {
  SolverCounts now{potential_.counts(), parts_};
  now.parts.insert(now.parts.end(), projection_.part_counts().begin(), projection_.part_counts().end());
  return now;
}

template <Scalar S>
void LobattoStepper<S>::remember_own(Archive& archive) {
  archive(h_, extrapolation_);
}

template <Scalar S>
bool LobattoStepper<S>::correct_multipliers() {
  // The matrix at nodes near the solution serves all sweeps: it multiplies a residual that goes to 0. The first start
  // has no multipliers at all: one sweep finds them, a second the nodes they lead to, a third has its matrix there.
  constexpr long near = 3;
  const Index s = method_->s();
  if (rule_.sweeps() < near) {
    {
      const PartCall counted(parts_[matrix]);
      system_.set_zero();
      gradient_.for_each_own_coupling(s, coupling_.data(), [&](Index a, Index b, const auto& at) {
        for (Index j = 0; j + 1 < s; ++j)
          for (Index i = 1; i < s; ++i)
            set_product(system_.entry(place(a) + i - 1, place(b) + j), at(i, j), method_->A_A_hat(i, j));
      });
    }
    const PartCall counted(parts_[factors]);
    if (!system_.factor()) return false;
  }
  const PartCall counted(parts_[solution]);
  for (Index a = 0; a < g_.cols(); ++a)
    for (Index i = 1; i < s; ++i) {
      S& r = rhs_[place(a) + i - 1];
      set_quotient(r, g_(i, a), h_);
      set_quotient(r, r, h_);
    }
  system_.solve(rhs_);
  for (Index a = 0; a < g_.cols(); ++a)
    for (Index j = 0; j + 1 < s; ++j) set_sum(lambda_(j, a), lambda_(j, a), rhs_[place(a) + j]);
  return true;
}

template <Scalar S>
bool LobattoStepper<S>::sweep(const State<S>& state) {
  {
    const PartCall counted(parts_[stages]);
    problem_.mass.velocity(lanes(std::as_const(P_)), lanes(V_));
    product(Q_, method_->A, V_);
    scale_and_shift(Q_, h_, state.q);
  }
  potential_.force(lanes(std::as_const(Q_)), F_);
  if (problem_.nu() > 0) {
    {
      const PartCall counted(parts_[gradients]);
      gradient_.update(lanes(std::as_const(Q_)), g_);
    }
    if (!correct_multipliers()) return false;
    for (Index i = 0; i < lambda_.size(); ++i) set_negative(pull_.data()[i], lambda_.data()[i]);
    gradient_.add_times(pull_, lanes(F_));
  }
  P_.swap(P_before_);
  product(P_, method_->A_hat, F_);
  scale_and_shift(P_, h_, state.p);
  return true;
}

template <Scalar S>
long LobattoStepper<S>::iterate(const State<S>& state) {
  return iterate_stages(rule_, state.p, positions_, h_, P_, P_before_, F_, [&] {
    if (!sweep(state))
      throw StageFailure(FailureCause::near_singular_constraints,
                         "the linear system for the multipliers of the stages is singular", "0", rule_.sweeps() + 1);
  });
}

template <Scalar S>
long LobattoStepper<S>::solve(const State<S>& state) {
  position_scale_.evaluate(state.q, h_, positions_);
  const long sweeps = find_stages(extrapolation_, sequence_, state.p, P_, lambda_, [&] { return iterate(state); });
  extrapolation_.add(sequence_.data());
  return sweeps;
}

template <Scalar S>
void LobattoStepper<S>::update(State<S>& state, long sweeps) {
  {
    const PartCall counted(parts_[sums]);
    problem_.mass.velocity(lanes(std::as_const(P_)), lanes(V_));
    stage_sums_.add_to(state, h_, V_, F_, sweeps);
  }
  if (problem_.nu() == 0) return;
  projection_.set_position(state.q);
  const Matrix<S>& mu = projection_.make_tangential(state.p);
  set_product(t_, h_, method_->b[method_->s() - 1]);
  for (Index a = 0; a < multiplier_.size(); ++a) set_quotient(multiplier_[a], mu.data()[a], t_);
}

template <Scalar S>
StepResult<S> LobattoStepper<S>::step(State<S>& state, const S& h) {
  if (h != h_) {
    set(h_, h);
    extrapolation_.clear();
  }
  const long sweeps = solve(state);
  copy_state(before_, state);
  try {
    update(state, sweeps);
  } catch (const StageFailure&) {
    copy_state(state, before_);
    throw;
  }
  return {sweeps, &multiplier_};
}

namespace {

class LobattoMethod final : public MethodByTemplate<LobattoMethod> {
 public:
  explicit LobattoMethod(int s) : s_(s) { static_cast<void>(make_lobatto<double>(s)); }

  std::string text() const override { return "lobatto:" + std::to_string(s_); }
  std::string title() const override { return "Lobatto IIIA-IIIB(" + std::to_string(s_) + ")"; }
  int order() const override { return 2 * s_ - 2; }
  int stages() const override { return s_; }
  int terms() const override { return 2 * s_; }
  Kept kept() const override {
    return {.energy = false, .momenta = true, .constraints = true, .hidden = true, .reversal = true};
  }
  Constants parameters() const override { return letter_s(s_); }
  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    require_conservative(problem, text());
    return [&problem, method = std::make_shared<const Lobatto<S>>(make_lobatto<S>(s_))] {
      return std::make_unique<LobattoStepper<S>>(problem, method);
    };
  }

 private:
  int s_;
};

}  // namespace

MethodPtr lobatto_method(std::string_view arguments) {
  const std::optional<int> s = whole_number(arguments);
  if (!s) throw InputError("method lobatto:" + std::string(arguments) + ": use lobatto:S with a whole number S >= 2");
  return std::make_shared<const LobattoMethod>(*s);
}

#define HBVM_DEFINE(S)                      \
  template Lobatto<S> make_lobatto<S>(int); \
  template class LobattoStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
